r"""Gauss–Newton towards a period matrix, with Siegel's metric.

With Π = X + iLLᵀ the entries of :math:`L^{-1}\, \partial\Pi\, L^{-T}` are coordinates of tangents
in which Siegel's metric is Euclidean (:func:`~igl_periods.siegel.orthonormal_weights`).  The rows
of the derivative J are their gradients.  Steps are :math:`dx = J^+ r` with the r of the geodesic to
the target, J⁺ by singular values, of which only as many are used as surfaces have moduli.

Steps may strain no edge by more than a fifth, and leave a part of the slack of every triangle.
Where Newton's step is too long it is shortened, and as another attempt damped,
:math:`dx = N^{-1} J^T (J N^{-1} J^T + \mu)^{-1} r` with the least μ that will do
(Levenberg–Marquardt), which holds back what costs much strain and gains little; the attempt that
comes nearer is taken.  Where the distance does not fall, half the strain is allowed.

A surface that is to stay embedded makes way after every step, where it is asked to
(:mod:`igl_periods.deformations.relaxation`), and longer where no step was found.

Where Π is a submersion the iteration ends with quadratic convergence.  At hyperelliptic surfaces of
genus 3 or more the derivative of Π drops in rank: towards them distances fall by a constant factor,
about 4 in each step.

References
----------
Nocedal, Wright, "Numerical optimization" (2006), section 10.3.
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
from .relaxation import Relaxation
from .results import Step

_LARGEST_STRAIN = 0.2
# Part of the slack of each triangle that a step leaves.
_SLACK_KEPT = 0.25
_MOST_HALVINGS = 12
# To within this factor the least damping is found.
_DAMPING_RATIO = 1.3
# Squares of singular values of J below this part of the largest are rounding.
_RANK = 1e-13
# Steps in a row that gain less than this part of the distance end the iteration; the second part
# is for surfaces that repel themselves, whose steps take long.
_LEAST_GAIN, _LEAST_GAIN_REPELLING, _IDLE_STEPS = 0.002, 0.02, 8
# Steps of descent after each step, unless the target is so near; and how often no step may be
# found before that is the end.
_DESCENTS, _NEAR, _MOST_FAILURES = 3, 0.005, 8
# By how much a step may raise the energy of a surface that repels itself.
_LARGEST_RISE = 0.5

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
    relaxation : Relaxation or None
        What makes the surface give way after every step, on its fibre.
    """

    chart: Chart
    compute: Computation
    target: Complexes
    relaxation: Relaxation | None = None

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
        idle, failures, verdict = 0, 0, ""
        least_gain = _LEAST_GAIN if self.relaxation is None else _LEAST_GAIN_REPELLING
        while distance > tolerance and not verdict:
            if len(steps) == max_steps:
                verdict = f"stopped after {max_steps} steps at a distance of {distance:.3g}"
                break
            with stage(f"step {len(steps) + 1} towards the target, at distance {distance:.3g}"):
                found = self._step(x, pm, distance)
                if found is None:
                    failures += 1
                    if self.relaxation is None or failures > _MOST_FAILURES:
                        verdict = _no_way(distance, pm.genus)
                        break
                    x, pm = self.relaxation.descend(x, pm, 10 * failures, patient=True)
                    distance = siegel_distance(pm.matrix, self.target)
                    continue
                dx, there, after = found
                strain = self.chart.strain(pm.complex, dx)
                x, pm = x + dx, there
                if self.relaxation is not None and after > _NEAR:
                    x, pm = self.relaxation.descend(x, pm, _DESCENTS)
                    after = siegel_distance(pm.matrix, self.target)
            steps.append(Step(after, strain))
            idle = idle + 1 if after > (1.0 - least_gain) * distance else 0
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
        solution = _DampedSolution.of(J @ raised.T, r, moduli(pm.genus))
        slack = slacks(K.lengths)
        strain = _LARGEST_STRAIN if self.relaxation is None else 0.5 * _LARGEST_STRAIN
        ceiling = self._energy(K) + _LARGEST_RISE
        for _ in range(_MOST_HALVINGS):
            steps = self._steps(K, raised, solution, strain)
            tried = [self._tried(x, dx, slack, ceiling) for dx in steps]
            best = min(tried, key=lambda one: one[2])
            if best[1] is not None and best[2] < distance:
                return best[0], best[1], best[2]
            strain = 0.5 * min(strain, *(self.chart.strain(K, dx) for dx, _, _ in tried))
        return None

    def _steps(
        self, K: DeltaComplex, raised: Floats, solution: _DampedSolution, strain: float
    ) -> list[Floats]:
        """Newton's step; where it strains too much, shortened, and damped as little as may be."""
        newton = np.asarray(solution.at(0.0) @ raised)
        too_much = self.chart.strain(K, newton) / strain
        if too_much <= 1.0:
            return [newton]
        low, high = solution.dampings
        while high > _DAMPING_RATIO * low:
            middle = np.sqrt(low * high)
            more = self.chart.strain(K, solution.at(middle) @ raised) > strain
            low, high = (middle, high) if more else (low, middle)
        damped = np.asarray(solution.at(high) @ raised)
        return [newton / too_much, damped / max(1.0, self.chart.strain(K, damped) / strain)]

    def _energy(self, K: DeltaComplex) -> float:
        """What the surface is to be kept from, 0 where it does not repel itself."""
        return 0.0 if self.relaxation is None else self.relaxation.chart.energy(K)[0]

    def _tried(
        self, x: Floats, dx: Floats, slack: Floats, ceiling: float
    ) -> tuple[Floats, PeriodMatrix | None, float]:
        """A step, with the matrix and the distance after it; None and ∞ where it cannot be made."""
        try:
            there = self.chart.surface(x + dx)
            kept = bool((slacks(there.lengths) >= _SLACK_KEPT * slack).all())
            if kept and self._energy(there) <= ceiling:
                pm = self.compute(there)
                return dx, pm, siegel_distance(pm.matrix, self.target)
        except ComplexError as error:
            logger.debug("a shorter step is needed: %s", error)
        return dx, None, np.inf

    def _linearised(self, pm: PeriodMatrix) -> tuple[Floats, Floats]:
        """J and r in orthonormal tangent coordinates at Π; (g (g + 1), N) and (g (g + 1),)."""
        W = orthonormal_weights(pm.matrix)
        velocity = siegel_logarithm(pm.matrix, self.target)
        r = np.einsum("ckl,kl->c", W.conj(), velocity).real
        return self.chart.rows(pm.complex, pm.gradient(W)), r


@dataclass(frozen=True, eq=False)
class _DampedSolution:
    """(J N⁻¹ Jᵀ + μ)⁻¹ r on the largest eigenvalues, as many as there are moduli."""

    eigenvalues: Floats
    U: Floats
    r: Floats

    @classmethod
    def of(cls, A: Floats, r: Floats, rank: int) -> _DampedSolution:
        squares, U = np.linalg.eigh(A)
        squares, U = squares[::-1][:rank], U[:, ::-1][:, :rank]
        kept = squares > _RANK * squares[0]
        return cls(squares[kept], U[:, kept], U[:, kept].T @ r)

    @property
    def dampings(self) -> tuple[float, float]:
        """A μ that hardly damps anything, and one that damps nearly all."""
        return 1e-3 * float(self.eigenvalues[-1]), 1e3 * float(self.eigenvalues[0])

    def at(self, mu: float) -> Floats:
        """The coefficients of the rows of J N⁻¹."""
        return np.asarray(self.U @ (self.r / (self.eigenvalues + mu)))


def moduli(g: int) -> int:
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
