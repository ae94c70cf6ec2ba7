r"""From a surface to its period matrix in balls: the steps, one after the other.

    K ─ homology ▶ cochains ─ exact lengths, Delaunay moves ▶ triangulation ─ cut ▶ cells
      ─ degrees ▶ trial functions ─ least squares, refinement ▶ series
      ─ conforming forms, quadrature ▶ D in balls ─ Siegel point ▶ Π in balls

The last two steps prove, whatever came before.  If they prove less than was asked for, the goal of
the steps before is raised by what is missing, and they run again.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from numbers import Real

import flint
import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, ExactLengths, MarkedComplex
from igl_periods.errors import ComplexError, MemoryLimitError
from igl_periods.machine import available_memory
from igl_periods.periods import ToleranceWarning
from igl_periods.proofs import orthonormal_combination
from igl_periods.run_log import logger, stage
from igl_periods.topology import cochains_and_basis

from .cells import Cells, cells_of
from .conforming_forms import dirichlet_enclosure
from .degrees import first_sizes, next_goal, next_sizes, node_counts
from .delaunay_moves import improve_shapes, insert_centres, make_delaunay
from .enclosure import PeriodEnclosure
from .exact_lengths import checked_balls
from .float_energies import float_dirichlet_enclosure
from .float_traces import coefficients_in_floats
from .interface_nodes import InterfaceNodes
from .least_squares import least_squares
from .refinement import Refined, precision_of, refined
from .surface_choice import surface_and_lengths
from .trial_functions import trial_functions
from .triangulation import Triangulation
from .upper_energies import canonical_in_forms, linear_upper_energies, upper_energies

MOST_DIGITS = 1000
"""More digits than this are refused: they would take days."""

# Bits of the working precision that shapes need not have.
_GUARD_BITS = 48
_MOST_BITS = 100_000
# Digits beyond those that are wanted which series are made for, and with which a proof is tried.
_RESERVE, _LEAST_RESERVE = 0.3, -0.2
# Digits by which quadrature is to be more accurate than the result.
_QUADRATURE_DIGITS = 8
# So many digits, at most, are tried in double precision; radii of energies by which they would be
# wrong are negligible if they are this much smaller.
_DIGITS_IN_FLOATS, _NEGLIGIBLE = 13, 0.2
# A proof that is worse than expected is tried again, so often in all.
_MOST_PROOFS = 3
_STALLED = "more trial functions do not help"
_LOG_10 = float(np.log(10.0))
# Triangles with a circumradius above so many shortest sides are divided.
_RATIO, _RATIO_FOR_FEW_DIGITS = 1.6, 4.0
# Seconds grow with this power of the number of unknowns, for estimates; entries of the Cholesky
# factor over those of the normal equations.
_COST_EXPONENT, _FILL = 2.5, 5.0


def enclose(
    surface: DeltaComplex | ArrayLike,
    F: ArrayLike | None = None,
    *,
    digits: int = 30,
    max_seconds: float | None = None,
    max_memory: float | None = None,
) -> PeriodEnclosure:
    """Compute a period matrix in balls that provably contain the exact one.

    Parameters
    ----------
    surface : (n, d) array-like or DeltaComplex
        Positions V of a triangle mesh, or a complex.  Positions are exact as they are stored, also
        integers and fractions, and lengths are the square roots of sums of squares of their
        differences.  A complex that carries ``exact_lengths`` has those; otherwise the stored
        doubles are the lengths, exactly.
    F : (m, 3) array-like of int, optional
        Corners of the triangles, with V.
    digits : int
        Wanted decimal digits of all entries Π_ij, relative to √(Y_ii Y_jj).
    max_seconds : float, optional
        Begin nothing that would probably end later than this.
    max_memory : float, optional
        Bytes that the computation may take; by default what is available.

    Returns
    -------
    PeriodEnclosure
        Of genus 0: a 0 × 0 matrix.

    Raises
    ------
    MeshError
        If V and F are not a triangulated surface.
    ComplexError
        If the surface is not closed, oriented and connected, or a triangle is so flat that its
        lengths do not determine it.
    MemoryLimitError
        If even the first stage takes more memory than there is.
    ValueError
        If ``digits`` is not a whole number from 1 to 1000, or a limit is not positive.

    Warns
    -----
    ToleranceWarning
        If fewer digits were proved than wanted.  The result is the best one that was proved.

    Examples
    --------
    >>> from igl_periods import DeltaComplex
    >>> torus = DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))])
    >>> enclose(torus, digits=20).reduced().contains([[1j]])
    True
    """
    _check_options(digits, max_seconds, max_memory)
    limits = _Limits(max_seconds, max_memory)
    K, lengths = surface_and_lengths(surface, F)
    with stage("homology"):
        cochains, T = cochains_and_basis(K)
    if cochains.shape[0] == 0:
        return PeriodEnclosure(flint.arb_mat(0, 0), cochains, K, precision_of(digits))
    with stage("stars and faces"):
        triangulation, cells = _cut(K, lengths, cochains, digits)
    marking = csr_array(csr_array(T.astype(np.int64)) @ cochains)

    def prove(solution: Refined) -> PeriodEnclosure:
        with stage("energies in balls"), flint.ctx.workprec(precision_of(digits)):
            D = _energies(triangulation, solution, T.astype(np.int64), digits)
        return PeriodEnclosure(D, marking, K, precision_of(digits))

    def prove_less() -> PeriodEnclosure:
        with stage("forms that are linear on triangles"), flint.ctx.workprec(precision_of(digits)):
            D = linear_upper_energies(MarkedComplex(K, cochains, T), lengths)
        return PeriodEnclosure(D, marking, K, precision_of(digits))

    best, reason = _best_enclosure(cells, prove, digits, limits)
    if best is None:
        best = prove_less()
    if best.digits < digits:
        warnings.warn(
            f"{best.digits} digits are proved, {digits} were asked for: {reason}.",
            ToleranceWarning,
            stacklevel=2,
        )
    return best


def _cut(
    K: DeltaComplex, lengths: ExactLengths, cochains: csr_array, digits: int
) -> tuple[Triangulation, Cells]:
    """The cells of a good triangulation, known well enough."""
    # Where coefficients of series are large, as many bits again may cancel.
    wanted = 2 * precision_of(digits)
    bits = wanted
    while True:
        with flint.ctx.workprec(bits):
            triangulation = Triangulation.of(K, checked_balls(lengths, K, bits), cochains)
            make_delaunay(triangulation)
            insert_centres(triangulation)
            few = digits <= _DIGITS_IN_FLOATS
            improve_shapes(triangulation, _RATIO_FOR_FEW_DIGITS if few else _RATIO)
            cells = cells_of(triangulation)
        missing = wanted - _GUARD_BITS - cells.accuracy_in_bits()
        if missing <= 0:
            return triangulation, cells
        if 2 * bits > _MOST_BITS:
            raise ComplexError(
                f"with {bits} bits the shape of a cell is known to {cells.accuracy_in_bits()} bits "
                "only: exact_lengths gives balls that do not shrink, or a triangle is degenerate."
            )
        bits += max(missing, bits // 2)


def _best_enclosure(
    cells: Cells, prove: Callable[[Refined], PeriodEnclosure], digits: int, limits: _Limits
) -> tuple[PeriodEnclosure | None, str]:
    """Solve in stages and prove; again with a higher goal as long as digits are missing.

    The result is the best that was proved, None if that is nothing, and why it is not better.
    """
    # Energies add up the squares of the jumps on all segments, about a tenth of the largest ones.
    margin = 0.5 * float(np.log10(max(cells.n_interfaces / 10.0, 1.0)))
    final = 0.5 * (digits + _RESERVE) + margin
    goal = next_goal(0.0, final)
    size = first_sizes(cells, goal)
    best: PeriodEnclosure | None = None
    closest: Refined | None = None
    n_proofs = 0
    limits.check_memory(cells, size)
    while True:
        with stage(f"series for jumps of 1e-{goal:.1f}"):
            solution = limits.timed(partial(_solution, cells, size, goal), size)
        expected = solution.expected_digits
        logger.info(
            "jumps of 1e%.1f with %d functions, about %.1f digits",
            solution.residual,
            size.sum(),
            expected,
        )
        stalled = closest is not None and expected <= closest.expected_digits
        closest = solution if not stalled else closest
        assert closest is not None
        reason = _STALLED if stalled else ""
        if not stalled and expected < digits + _LEAST_RESERVE:
            goal, size = _larger(cells, solution, goal, final, 0.5 * expected + margin)
            reason = limits.exceeded_by(cells, size)
            if not reason:
                continue
        try:
            found = prove(closest)
            proved = _proved(found)
        except ComplexError as error:
            return best, f"nothing more can be proved ({error})"
        gained = best is None or found.bound < best.bound
        best = found if gained else best
        if proved >= digits:
            return best, ""
        n_proofs += 1
        if reason or not gained or n_proofs == _MOST_PROOFS:
            return best, reason or _STALLED
        logger.info("%.2f digits proved", proved)
        final += 0.5 * (digits - proved + _RESERVE)
        goal, size = _larger(cells, solution, goal, final, 0.5 * proved + margin)
        reason = limits.exceeded_by(cells, size)
        if reason:
            return best, reason


def _larger(
    cells: Cells, solution: Refined, goal: float, final: float, reached: float
) -> tuple[float, Ints]:
    """The next goal, and the numbers of functions that it probably takes."""
    # What was asked for in vain is not asked for again.
    following = max(next_goal(reached, final), min(goal, final) + 0.5 * max(goal - reached, 0.0))
    return following, next_sizes(cells, solution.sizes, solution.jumps, following)


def _solution(cells: Cells, size: Ints, goal: float) -> Refined:
    nodes = InterfaceNodes.of(cells, node_counts(cells, size))
    problem = least_squares(trial_functions(nodes, size))
    return refined(problem, goal)


def _energies(surface: Triangulation, solution: Refined, basis: Ints, digits: int) -> flint.arb_mat:
    """Upper bounds of energies: in double precision where few digits are wanted."""
    accuracy = digits + _QUADRATURE_DIGITS
    if digits <= _DIGITS_IN_FLOATS:
        try:
            E, W = _energies_in_floats(surface, solution, -_LOG_10 * accuracy)
        except ComplexError as error:
            logger.info("not in double precision: %s", error)
        else:
            radius = max(float(x.rad()) for x in E.entries())
            if radius * E.nrows() < _NEGLIGIBLE * 10.0**-digits:
                return upper_energies(E, canonical_in_forms(basis, W))
            logger.info("double precision leaves energies unknown by %.2g", radius)
    with flint.ctx.workprec(precision_of(digits) + solution.series.excess_bits):
        E = dirichlet_enclosure(surface, solution.series, -_LOG_10 * accuracy)
    return upper_energies(E, flint.arb_mat(basis.tolist()))


def _energies_in_floats(
    surface: Triangulation, solution: Refined, accuracy: float
) -> tuple[flint.arb_mat, Floats]:
    """Energies of nearly orthonormal forms, in classes W c, and W."""
    trial = solution.problem.trial
    cells = trial.nodes.cells
    W = orthonormal_combination(solution.approximate_energies(), csr_array(cells.jumps))
    newton = [a @ W.T for a in solution.newton]
    coefficients = coefficients_in_floats(trial, newton)
    return float_dirichlet_enclosure(surface, cells, coefficients, accuracy, W), W


def _proved(found: PeriodEnclosure) -> float:
    """Proved digits, with fractions; nothing is proved where they are negative."""
    if found.bound == 0:
        return float(found.digits)
    if not found.bound < 1:
        raise ComplexError("the energies are known too badly for a period matrix.")
    with flint.ctx.workprec(64):
        return -float(found.bound.log().mid()) / _LOG_10


@dataclass
class _Limits:
    """What the computation may take, and what it has taken."""

    max_seconds: float | None
    max_memory: float | None
    start: float = field(default_factory=time.perf_counter)
    last: tuple[float, float] = (0.0, 1.0)

    def timed(self, solve: Callable[[], Refined], size: Ints) -> Refined:
        """Solve, and remember how long that took for so many unknowns."""
        before = time.perf_counter()
        solution = solve()
        self.last = time.perf_counter() - before, float(size.sum())
        return solution

    def exceeded_by(self, cells: Cells, size: Ints) -> str:
        """Why a solution with these numbers of functions is not to be begun; empty if it may."""
        seconds, unknowns = self.last
        expected = seconds * (float(size.sum()) / unknowns) ** _COST_EXPONENT
        elapsed = time.perf_counter() - self.start
        # The proof takes about as long as the solution.
        if self.max_seconds is not None and elapsed + 2.0 * expected > self.max_seconds:
            return f"the next step would take about {2.0 * expected:.3g} s more"
        needed = stage_memory(cells, size)
        if needed > self._room():
            return f"the next step would take about {needed / 1e9:.3g} GB"
        logger.info("next: degrees up to %d, about %.2g s", size.max(), expected)
        return ""

    def check_memory(self, cells: Cells, size: Ints) -> None:
        """Raise MemoryLimitError if a solution has no room."""
        needed = stage_memory(cells, size)
        if needed > self._room():
            raise MemoryLimitError(
                f"series on {cells.n_cells:,} stars and faces take about {needed / 1e9:.3g} GB, "
                f"and there are {self._room() / 1e9:.3g} GB. Ask for fewer digits, simplify the "
                "mesh, or use a machine with more memory."
            )

    def _room(self) -> float:
        available = available_memory()
        return available if self.max_memory is None else min(available, self.max_memory)


def stage_memory(cells: Cells, size: Ints) -> float:
    """Bytes that the least-squares problem takes: tables, normal equations and their factor."""
    columns = 2.0 * size[cells.cell]
    nodes = node_counts(cells, size)
    tables = 24.0 * float((nodes[:, None] * columns).sum())
    normal = 16.0 * float((columns[:, 0] * columns[:, 1]).sum())
    return tables + (1.0 + _FILL) * normal + 16.0 * float((2.0 * size**2).sum())


def _check_options(digits: int, max_seconds: float | None, max_memory: float | None) -> None:
    if not (isinstance(digits, Real) and float(digits).is_integer() and 1 <= digits <= MOST_DIGITS):
        raise ValueError(f"digits = {digits}: a whole number from 1 to {MOST_DIGITS} is wanted.")
    for name, limit in (("max_seconds", max_seconds), ("max_memory", max_memory)):
        if limit is not None and not limit > 0:
            raise ValueError(f"{name} = {limit}: a limit is positive.")
