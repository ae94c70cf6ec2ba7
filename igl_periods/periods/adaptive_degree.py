r"""Raising the degree, and splitting faces, until the certified bound meets a tolerance.

The first attempt is piecewise linear, the next one has degree 2.  From there on the bound b falls
like :math:`r^{-p}` in the degree p, with a ratio r > 1 that is measured as soon as there are two
degrees to compare; so the degree that meets the tolerance can be predicted, and the degrees in
between are skipped.  Where the faces that hold most of the bound
(:mod:`igl_periods.harmonic.excess`; Dörfler's marking) are well shaped, r is 10 or so, and the
first step is taken at once; on thin triangles r is close to 1, and then it can be cheaper to divide
those faces: it costs few more unknowns and divides the bound by 2 at least.  Of the two ways to the
tolerance the one with the least predicted cost is taken, in multiples of the last attempt:

.. math::  (p' / p)^2 \quad\text{for the degree } p',
           \qquad  \sum_{i=1}^{n} q^i \quad\text{for n rounds of division,}

q the growth of the number of faces in a round.

References
----------
Babuška, Suri, "The p and h-p versions of the finite element method" (1994).
Dörfler, "A convergent adaptive algorithm for Poisson's equation" (1996).
"""

from __future__ import annotations

import time
import warnings
from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.complexes import MarkedComplex, angles
from igl_periods.elements import (
    HighOrderForms,
    count_unknowns,
    energy_excess,
    high_order_forms,
    separate_cones,
)
from igl_periods.errors import ComplexError
from igl_periods.harmonic import energy_factor, factored, most_of
from igl_periods.machine import available_memory
from igl_periods.run_log import logger
from igl_periods.symplectic import williamson_basis

from .certificate import Method
from .marking import marked_faces
from .matrix import PeriodMatrix
from .memory_estimates import high_order_memory, room_for_forms
from .rounding import LEAST_ALLOWANCE

HIGHEST_DEGREE = 20
# The ratio r of the bounds of successive degrees, before it is measured.
_USUAL_RATIO = 12.0
# On well-shaped faces, from degree 2 to 1e-10 on the average: 9 to 30 were seen, a bound that falls
# faster costs one degree too many.
_WELL_SHAPED_RATIO = 10.0
_WELL_SHAPED_ANGLE = np.radians(20.0)
# Steps of the degree at most, with a ratio to rely on and without one.
_BOLD, _CAUTIOUS = 6, 2
_LEAST_RATIO = 1.05
# Each round of division treats faces with this part of the excess, and divides the bound by 2.
_MARKED = 0.8
_ROUND_RATIO = 2.0
# Said of tolerances that no computation in double precision meets.
_BEYOND = (
    " Double precision stops at about 1e-13; igl_periods.enclose (igl-periods enclose) proves any "
    "number of digits."
)


class ToleranceWarning(UserWarning):
    """The tolerance was not met; the result is the best certified one."""


@dataclass(frozen=True, eq=False)
class Attempt:
    """A certified period matrix, and what it took.

    Attributes
    ----------
    triangulation : MarkedComplex
    degree : int
    unknowns : int
    seconds : float
    result : PeriodMatrix
    excess : (m,) float
        The shares of the faces in Σ (d_i − 1).  Empty where it is not needed: at degree 1, and
        where the tolerance is met.
    """

    triangulation: MarkedComplex
    degree: int
    unknowns: int
    seconds: float
    result: PeriodMatrix
    excess: Floats

    @property
    def bound(self) -> float:
        """The certified bound."""
        assert self.result.bound is not None
        return self.result.bound


@dataclass(frozen=True, eq=False)
class Plan:
    """What to try next, and the time it should take, in seconds."""

    triangulation: MarkedComplex
    degree: int
    seconds: float


@dataclass(frozen=True)
class Limits:
    """The most unknowns and bytes that an attempt may take; None without a limit."""

    unknowns: float | None
    memory: float | None


def period_matrix_within(
    triangulation: MarkedComplex,
    method: Method,
    tolerance: float,
    max_unknowns: float | None = None,
    max_memory: float | None = None,
) -> PeriodMatrix:
    """Compute a period matrix whose certified bound is at most ``tolerance``.

    Each attempt is logged at level INFO to the logger ``igl_periods``: degree, faces, unknowns,
    bound, seconds.

    Parameters
    ----------
    triangulation : MarkedComplex
        A closed, oriented, connected surface, before cone points are separated; best Delaunay.
    method : Method
        From forms to period matrices, and to finer triangulations.
    tolerance : float
        The bound to reach.
    max_unknowns : number, optional
        No attempt has more unknowns in its sparse system than this.
    max_memory : float, optional
        No attempt takes more bytes than this, by default more than are available.

    Returns
    -------
    PeriodMatrix
        The attempt of the least bound.

    Warns
    -----
    ToleranceWarning
        If the tolerance is not met: it is below what rounding allows, or meeting it takes more
        unknowns, more memory or a higher degree than there may be.

    Raises
    ------
    ValueError
        If the tolerance is not positive.
    """
    if not tolerance > 0.0:
        raise ValueError(f"tolerance = {tolerance}: a bound is always positive.")
    limits = Limits(max_unknowns, max_memory)
    attempts = [_linear_attempt(triangulation, method, max_memory)]
    while (best := min(attempts, key=lambda attempt: attempt.bound)).bound > tolerance:
        plan = _next_plan(attempts, method, tolerance, limits)
        outcome = _carried_out(plan, method, tolerance) if isinstance(plan, Plan) else plan
        if isinstance(outcome, str):
            warnings.warn(
                f"the bound is {best.bound:.2g}, not {tolerance:.2g} as wanted: {outcome}."
                f"{_BEYOND if tolerance < LEAST_ALLOWANCE else ''}",
                ToleranceWarning,
                stacklevel=3,
            )
            break
        attempts.append(outcome)
    return best.result


def _linear_attempt(
    triangulation: MarkedComplex, method: Method, max_memory: float | None
) -> Attempt:
    start = time.perf_counter()
    K = triangulation.complex
    laplacian, problem = method.problem(triangulation)
    result = method.linear(problem, factored(laplacian), room_for_forms(K, max_memory))
    seconds = time.perf_counter() - start
    return _logged(Attempt(triangulation, 1, K.n_vertices, seconds, result, np.zeros(0)))


def _carried_out(plan: Plan, method: Method, tolerance: float) -> Attempt | str:
    """The attempt as planned, or how it failed."""
    start = time.perf_counter()
    logger.info("degree %2d next, in about %.2g s", plan.degree, plan.seconds)
    where = plan.triangulation
    try:
        forms = high_order_forms(where.complex, where.cochains, plan.degree)
        result = method.high_order(where, forms)
    except ComplexError as error:
        return f"degree {plan.degree} fails, {error}"
    assert result.bound is not None
    excess = _excess(forms, where, result) if result.bound > tolerance else np.zeros(0)
    seconds = time.perf_counter() - start
    return _logged(Attempt(where, plan.degree, len(forms.traces), seconds, result, excess))


def _excess(forms: HighOrderForms, where: MarkedComplex, result: PeriodMatrix) -> Floats:
    """The shares of the faces before cone points were separated."""
    pairs = williamson_basis(energy_factor(result.dirichlet)) @ where.basis
    shares = energy_excess(forms, pairs).sum(axis=0)
    return np.asarray(shares.reshape(where.complex.n_faces, -1).sum(axis=1))


def _logged(attempt: Attempt) -> Attempt:
    logger.info(
        "degree %2d  %8d faces  %9d unknowns  bound %.1e  %7.2f s",
        attempt.degree,
        attempt.triangulation.complex.n_faces,
        attempt.unknowns,
        attempt.bound,
        attempt.seconds,
    )
    return attempt


def _next_plan(
    attempts: list[Attempt], method: Method, tolerance: float, limits: Limits
) -> Plan | str:
    """The cheapest way to go on, or why there is none."""
    last = attempts[-1]
    # On needles the allowance is made of energy of the forms, and falls with their error: what it
    # will come down to is not above the least that was seen.
    rounding = min(attempt.result.rounding for attempt in attempts)
    stagnates = _stagnates(attempts)
    if last.bound < 2.0 * (last.result.rounding if stagnates else rounding):
        return f"rounding accounts for {last.result.rounding:.2g} of it"
    if stagnates:
        return "neither a higher degree nor smaller faces lower it further"
    target = max(tolerance, 1.2 * rounding)
    plans = _raised(attempts, target) if last.degree < HIGHEST_DEGREE else []
    if last.degree > 1:
        plans += _divided(last, method, target)
    reasons = []
    if not plans:
        return "the degree is as high as it gets, and faces that hold it are too thin to be divided"
    for _, plan in sorted(plans, key=lambda costed: costed[0]):
        reason = _unaffordable(plan, limits)
        if reason is None:
            return plan
        reasons.append(reason)
    return reasons[0]


def _stagnates(attempts: list[Attempt]) -> bool:
    """Whether neither of the last two attempts lowered the best bound by a quarter."""
    bounds = [attempt.bound for attempt in attempts]
    return len(bounds) > 3 and min(bounds[-2:]) > 0.75 * min(bounds[:-2])


def _raised(attempts: list[Attempt], target: float) -> list[tuple[float, Plan]]:
    """The predicted cost of meeting the target by the degree alone, and the next step there.

    After a bold step the cautious one, for the case that there is no room for it.
    """
    last = attempts[-1]
    if last.degree == 1:
        return [(0.0, Plan(last.triangulation, 2, 8.0 * last.seconds))]
    measured = _measured_ratio(attempts)
    expected = _WELL_SHAPED_RATIO if measured is None and _well_shaped(last) else measured
    ratio = expected or _USUAL_RATIO
    needed = max(int(np.ceil(np.log(last.bound / target) / np.log(ratio))), 1)
    reached = last.degree + needed
    cost = (reached / last.degree) ** 2 if reached <= HIGHEST_DEGREE else np.inf
    steps = (_CAUTIOUS,) if expected is None else (_BOLD, _CAUTIOUS)
    degrees = [min(reached, last.degree + step, HIGHEST_DEGREE) for step in steps]
    return [
        (cost, Plan(last.triangulation, degree, last.seconds * (degree / last.degree) ** 2))
        for degree in dict.fromkeys(degrees)
    ]


def _well_shaped(attempt: Attempt) -> bool:
    """Whether most of the faces that hold the bound are far from thin."""
    faces = most_of(attempt.excess, _MARKED)
    least = angles(attempt.triangulation.complex.lengths[faces]).min(axis=1)
    return bool(np.quantile(least, 0.1) > _WELL_SHAPED_ANGLE)


def _measured_ratio(attempts: list[Attempt]) -> float | None:
    """The ratio of the bounds of successive degrees, by the last two to be compared."""
    for one, two in zip(attempts[-2::-1], attempts[:0:-1]):
        if 1 < one.degree < two.degree:
            change = _discretisation(one) / _discretisation(two)
            return float(max(change ** (1.0 / (two.degree - one.degree)), _LEAST_RATIO))
    return None


def _discretisation(attempt: Attempt) -> float:
    return max(attempt.bound - attempt.result.rounding, np.finfo(float).eps)


def _divided(last: Attempt, method: Method, target: float) -> list[tuple[float, Plan]]:
    """The predicted cost of meeting the target by division, and the first round of it.

    Nothing where the faces that hold the bound are too thin.
    """
    where = last.triangulation
    faces = marked_faces(where.complex, last.excess, _MARKED)
    if faces.size == 0:
        return []
    finer = method.divided(where, faces)
    growth = count_unknowns(finer.after(separate_cones).complex, last.degree) / last.unknowns
    rounds = np.ceil(np.log(last.bound / target) / np.log(_ROUND_RATIO))
    cost = float(np.sum(growth ** np.arange(1.0, rounds + 1.0)))
    return [(cost, Plan(finer, last.degree, growth * last.seconds))]


def _unaffordable(plan: Plan, limits: Limits) -> str | None:
    """Why a plan is too large, if it is."""
    separated = plan.triangulation.after(separate_cones)
    what = f"degree {plan.degree} on {plan.triangulation.complex.n_faces} faces takes"
    unknowns = count_unknowns(separated.complex, plan.degree)
    if limits.unknowns is not None and unknowns > limits.unknowns:
        return f"{what} {unknowns} unknowns, and {limits.unknowns:g} are the limit"
    needed = high_order_memory(separated.complex, plan.degree, separated.rank)
    memory = available_memory() if limits.memory is None else limits.memory
    if needed > memory:
        return f"{what} about {needed / 1e9:.2g} GB of memory, and there are {memory / 1e9:.2g}"
    return None
