r"""Gauss–Newton towards a period matrix, with Siegel's metric.

With Π = X + iLLᵀ the entries of :math:`L^{-1}\, \partial\Pi\, L^{-T}` are coordinates of tangents
in which Siegel's metric is Euclidean (:func:`~igl_periods.siegel.orthonormal_weights`).  The rows
of the derivative J are their gradients.  Steps are :math:`dx = J^+ r` with the r of the geodesic to
the target, J⁺ by singular values, of which only as many are used as surfaces have moduli.

A step is shortened until no edge changes by more than a fifth, every triangle keeps a part of its
slack, and the distance to the target falls.  Where Π is a submersion the iteration is Newton's, and
ends with quadratic convergence.  At hyperelliptic surfaces of genus 3 or more the derivative of Π
drops in rank: towards them distances fall by a constant factor, about 4 in each step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import DeltaComplex, slacks
from igl_periods.errors import ComplexError
from igl_periods.periods import PeriodMatrix
from igl_periods.run_log import logger, stage
from igl_periods.siegel import orthonormal_weights, siegel_distance, siegel_logarithm

from .charts import Chart
from .results import Step

_LARGEST_STRAIN = 0.2
# Part of the slack of each triangle that a step leaves.
_SLACK_KEPT = 0.25
_MOST_HALVINGS = 12
# Squares of singular values of J below this part of the largest are rounding.
_RANK = 1e-13
# Steps in a row that gain less than this part of the distance end the iteration.
_LEAST_GAIN, _IDLE_STEPS = 0.002, 8

Computation = Callable[[DeltaComplex], PeriodMatrix]


@dataclass(frozen=True, eq=False)
class GaussNewton:
    """The iteration towards a target.

    Attributes
    ----------
    chart : Chart
    compute : callable
        The period matrix of a surface, in the one marking.
    target : (g, g) complex
    """

    chart: Chart
    compute: Computation
    target: Complexes

    def run(
        self, x: Floats, tolerance: float, max_steps: int
    ) -> tuple[Floats, PeriodMatrix, tuple[Step, ...], str]:
        """Move x until the surface there has the period matrix that is wanted.

        Parameters
        ----------
        x : (N,) float
            Where to start.
        tolerance : float
            Siegel distance at which the target is reached.
        max_steps : int

        Returns
        -------
        x : (N,) float
        pm : PeriodMatrix
        steps : tuple of Step
        verdict : str
            Why it ended elsewhere; empty where the target is reached.
        """
        pm = self.compute(self.chart.surface(x))
        distance = siegel_distance(pm.matrix, self.target)
        steps: list[Step] = []
        idle, verdict = 0, ""
        while distance > tolerance and not verdict:
            if len(steps) == max_steps:
                verdict = f"stopped after {max_steps} steps at a distance of {distance:.3g}"
                break
            with stage(f"step {len(steps) + 1} towards the target, at distance {distance:.3g}"):
                found = self._step(x, pm, distance)
            if found is None:
                verdict = _no_way(distance, pm.genus)
                break
            dx, pm, after = found
            x = x + dx
            steps.append(Step(after, self.chart.strain(pm.complex, dx)))
            idle = idle + 1 if after > (1.0 - _LEAST_GAIN) * distance else 0
            distance = after
            if idle == _IDLE_STEPS:
                verdict = _no_way(distance, pm.genus)
        logger.info("distance %.3g after %d steps", distance, len(steps))
        return x, pm, tuple(steps), verdict

    def _step(
        self, x: Floats, pm: PeriodMatrix, distance: float
    ) -> tuple[Floats, PeriodMatrix, float] | None:
        """The displacement, the matrix and the distance after it; None where none comes nearer."""
        K = pm.complex
        J, r = self._linearised(pm)
        raised = self.chart.raised(K, J)
        dx = (_inverse(J @ raised.T, _moduli(pm.genus)) @ r) @ raised
        dx *= min(1.0, _LARGEST_STRAIN / max(self.chart.strain(K, dx), 1e-300))
        slack = slacks(K.lengths)
        for _ in range(_MOST_HALVINGS):
            try:
                there = self.chart.surface(x + dx)
                if (slacks(there.lengths) >= _SLACK_KEPT * slack).all():
                    after = self.compute(there)
                    new_distance = siegel_distance(after.matrix, self.target)
                    if new_distance < distance:
                        return dx, after, new_distance
            except ComplexError as error:
                logger.debug("a shorter step is needed: %s", error)
            dx = 0.5 * dx
        return None

    def _linearised(self, pm: PeriodMatrix) -> tuple[Floats, Floats]:
        """J and r in orthonormal tangent coordinates at Π; (g (g + 1), N) and (g (g + 1),)."""
        W = orthonormal_weights(pm.matrix)
        velocity = siegel_logarithm(pm.matrix, self.target)
        r = np.einsum("ckl,kl->c", W.conj(), velocity).real
        return self.chart.rows(pm.complex, pm.gradient(W)), r


def _inverse(A: Floats, rank: int) -> Floats:
    """The pseudoinverse of J N⁻¹ Jᵀ by its largest eigenvalues, ``rank`` at most."""
    squares, U = np.linalg.eigh(A)
    squares, U = squares[::-1][:rank], U[:, ::-1][:, :rank]
    kept = squares > _RANK * squares[0]
    return np.asarray((U[:, kept] / squares[kept]) @ U[:, kept].T)


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
