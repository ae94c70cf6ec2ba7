r"""Gauss–Newton towards a period matrix, with Siegel's metric.

Let Π = X + iLLᵀ.  In the coordinates :math:`L^{-1}\, \partial\Pi\, L^{-T}` of tangents, written in
the orthonormal basis :math:`E_{jj}`, :math:`(E_{jk} + E_{kj}) / \sqrt 2` and i times these, Siegel's
metric is Euclidean; the rows of the derivative J are the gradients of these coordinates.  Steps are
:math:`dx = J^+ r` with the r of the geodesic to the target, J⁺ by singular values, of which only as
many are used as surfaces have moduli.

A step is shortened until no edge changes by more than a fifth, every triangle keeps a part of its
slack, and the distance to the target falls.  Where Π is a submersion the iteration is Newton's, and
ends with quadratic convergence.  At hyperelliptic surfaces of genus 3 or more the derivative of Π
drops in rank: towards them distances fall by a constant factor, about 4 in each step.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import DeltaComplex, slacks
from igl_periods.errors import ComplexError
from igl_periods.periods import Gradient, PeriodMatrix
from igl_periods.run_log import logger, stage
from igl_periods.siegel import siegel_distance, siegel_logarithm

from .charts import Chart
from .repulsion import repulsion
from .results import Step

_LARGEST_STRAIN = 0.2
# Strain by which sheets are moved apart at each step, until the target is so near.
_SLIDE, _SETTLED = 0.1, 0.02
# Part of the slack of each triangle that a step leaves.
_SLACK_KEPT = 0.25
_MOST_HALVINGS = 12
# Squares of singular values of J below this part of the largest are rounding.
_RANK = 1e-13
# Steps in a row that gain less than this part of the distance end the iteration.
_LEAST_GAIN, _IDLE_STEPS = 0.002, 8

Computation = Callable[[DeltaComplex], PeriodMatrix]


def gauss_newton(
    chart: Chart,
    x: Floats,
    compute: Computation,
    target: Complexes,
    tolerance: float,
    max_steps: int,
    apart: bool = False,
) -> tuple[Floats, PeriodMatrix, tuple[Step, ...], str]:
    """Move x until the surface there has the period matrix ``target``.

    Parameters
    ----------
    chart : Chart
    x : (N,) float
        Where to start.
    compute : callable
        The period matrix of a surface, in the one marking.
    target : (g, g) complex
    tolerance : float
        Siegel distance at which it is reached.
    max_steps : int

    Returns
    -------
    x : (N,) float
    pm : PeriodMatrix
    steps : tuple of Step
    verdict : str
        Why it ended elsewhere; empty where the target is reached.
    """
    pm = compute(chart.surface(x))
    distance = siegel_distance(pm.matrix, target)
    steps: list[Step] = []
    idle = 0
    while distance > tolerance:
        if len(steps) == max_steps:
            return x, pm, tuple(steps), f"stopped after {max_steps} steps at distance {distance:.3g}"
        with stage(f"step {len(steps) + 1} towards the target, at distance {distance:.3g}"):
            moved = _step(chart, x, compute, pm, target, distance, apart)
        if moved is None:
            return x, pm, tuple(steps), _no_way(distance, len(target))
        dx, pm, after = moved
        x = x + dx
        idle = idle + 1 if after > (1.0 - _LEAST_GAIN) * distance else 0
        distance = after
        steps.append(Step(distance, chart.strain(pm.complex, dx)))
        if idle == _IDLE_STEPS:
            return x, pm, tuple(steps), _no_way(distance, len(target))
    logger.info("the target is reached: distance %.3g after %d steps", distance, len(steps))
    return x, pm, tuple(steps), ""


def _step(
    chart: Chart,
    x: Floats,
    compute: Computation,
    pm: PeriodMatrix,
    target: Complexes,
    distance: float,
    apart: bool,
) -> tuple[Floats, PeriodMatrix, float] | None:
    """The displacement, the matrix and the distance after it; None where none comes nearer."""
    K = pm.complex
    J, r = _linearised(chart, pm, target)
    raised = chart.raised(K, J)
    inverse = _inverse(J @ raised.T, _moduli(pm.genus))
    dx = (inverse @ r) @ raised
    dx *= min(1.0, _LARGEST_STRAIN / max(chart.strain(K, dx), 1e-300))
    if apart and distance > _SETTLED:
        dx += _away(chart, K, J, raised, inverse)
    slack = slacks(K.lengths)
    for _ in range(_MOST_HALVINGS):
        try:
            there = chart.surface(x + dx)
            if (slacks(there.lengths) >= _SLACK_KEPT * slack).all():
                after = compute(there)
                new_distance = siegel_distance(after.matrix, target)
                if new_distance < distance:
                    return dx, after, new_distance
        except ComplexError as error:
            logger.debug("a shorter step is needed: %s", error)
        dx = 0.5 * dx
    return None


def _linearised(chart: Chart, pm: PeriodMatrix, target: Complexes) -> tuple[Floats, Floats]:
    """J and r in orthonormal coordinates of the tangent space at Π; (g (g + 1), N) and (g (g + 1),)."""
    inverse = np.linalg.inv(np.linalg.cholesky(pm.matrix.imag))
    units = _tangent_basis(pm.genus)
    gradient = pm.gradient(inverse.T @ units @ inverse)
    velocity = inverse @ siegel_logarithm(pm.matrix, target) @ inverse.T
    r = np.einsum("ckl,kl->c", units.conj(), velocity).real
    return chart.rows(pm.complex, gradient), r


def _tangent_basis(g: int) -> Complexes:
    """An orthonormal basis of the complex symmetric matrices, over the reals; (g (g + 1), g, g)."""
    j, k = np.triu_indices(g)
    units = np.zeros((j.size, g, g), dtype=np.complex128)
    units[np.arange(j.size), j, k] = units[np.arange(j.size), k, j] = np.where(
        j == k, 1.0, np.sqrt(0.5)
    )
    return np.concatenate([units, 1j * units])


def _inverse(A: Floats, rank: int) -> Floats:
    """The pseudoinverse of J N⁻¹ Jᵀ by its largest eigenvalues, ``rank`` at most."""
    squares, U = np.linalg.eigh(A)
    squares, U = squares[::-1][:rank], U[:, ::-1][:, :rank]
    kept = squares > _RANK * squares[0]
    return np.asarray((U[:, kept] / squares[kept]) @ U[:, kept].T)


def _away(chart: Chart, K: DeltaComplex, J: Floats, raised: Floats, inverse: Floats) -> Floats:
    """A displacement that moves sheets of the surface apart and leaves Π as it is."""
    _, gradient = repulsion(K)
    row = chart.rows(K, Gradient(np.zeros((1, K.n_edges)), gradient[None]))
    down = -chart.raised(K, row)[0]
    along = down - (inverse @ (J @ down)) @ raised
    return along * (_SLIDE / max(chart.strain(K, along), 1e-300))


def _moduli(g: int) -> int:
    """Real dimension of the space of surfaces of genus g."""
    return 2 if g == 1 else 6 * g - 6


def _no_way(distance: float, g: int) -> str:
    reason = (
        "from genus 4 on most points of the half-space are the period matrices of no surface, and "
        "this one seems not to be near one of this surface's"
        if g >= 4
        else "the triangles, or the displacements that are allowed, do not let it come nearer; "
        "a finer mesh, a larger basis, or another starting surface may"
    )
    return f"no step comes nearer than a distance of {distance:.3g}: {reason}"
