r"""Surfaces that give way without a change of their period matrix.

Within the fibre of Π through a surface, the steepest descent of the energy Φ that repels its parts
from each other (:mod:`igl_periods.deformations.repulsion`) is

.. math:: dx = -\tau\, (1 - J^+ J)\, N^{-1} \nabla\Phi ,

in the norm N of the chart.  What the step changes in Π, to second order, the next one takes back.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import DeltaComplex, slacks
from igl_periods.errors import ComplexError
from igl_periods.periods import PeriodMatrix
from igl_periods.siegel import orthonormal_weights, siegel_logarithm

from .charts import VertexChart

_LARGEST_STRAIN, _SLACK_KEPT = 0.2, 0.25
_MOST_HALVINGS = 8
# A step that lowers Φ by less ends the descent.
_LEAST_FALL = 0.03
_RANK = 1e-13


@dataclass(frozen=True, eq=False)
class Relaxation:
    """Descent of Φ at a fixed period matrix.

    Attributes
    ----------
    chart : VertexChart
        With a repulsion.
    compute : callable
        The period matrix of a surface, in the one marking.
    rank : int
        The number of moduli.
    """

    chart: VertexChart
    compute: Callable[[DeltaComplex], PeriodMatrix]
    rank: int

    def descend(
        self, x: Floats, pm: PeriodMatrix, most_steps: int, patient: bool = False
    ) -> tuple[Floats, PeriodMatrix]:
        """Some steps from x, where the matrix is ``pm``; fewer where Φ hardly falls any more.

        Parameters
        ----------
        patient : bool
            Go on also where it hardly falls.
        """
        goal = pm.matrix
        energy, gradient = self.chart.energy(pm.complex)
        for _ in range(most_steps):
            found = self._step(x, pm, goal, energy, gradient)
            if found is None:
                break
            x, pm, after, gradient = found
            energy, fall = after, energy - after
            if fall < _LEAST_FALL and not patient:
                break
        return x, pm

    def _step(
        self, x: Floats, pm: PeriodMatrix, goal: Complexes, energy: float, gradient: Floats
    ) -> tuple[Floats, PeriodMatrix, float, Floats] | None:
        drift, back = self._directions(pm, goal, gradient)
        slack = slacks(pm.complex.lengths)
        step = _LARGEST_STRAIN / max(self.chart.strain(pm.complex, drift), 1e-300)
        for _ in range(_MOST_HALVINGS):
            moved = x + step * drift + back
            try:
                there = self.chart.surface(moved)
                if (slacks(there.lengths) >= _SLACK_KEPT * slack).all():
                    after, next_gradient = self.chart.energy(there)
                    if after < energy:
                        return moved, self.compute(there), after, next_gradient
            except ComplexError:
                pass
            step *= 0.5
        return None

    def _directions(
        self, pm: PeriodMatrix, goal: Complexes, gradient: Floats
    ) -> tuple[Floats, Floats]:
        """The descent within the fibre, and the way back to it."""
        K, W = pm.complex, orthonormal_weights(pm.matrix)
        J = self.chart.rows(K, pm.gradient(W))
        raised = self.chart.raised(K, np.vstack([J, gradient]))
        rows, drift = raised[:-1], -raised[-1]
        squares, U = np.linalg.eigh(J @ rows.T)
        squares, U = squares[::-1][: self.rank], U[:, ::-1][:, : self.rank]
        kept = squares > _RANK * squares[0]
        lift = (U[:, kept] / squares[kept]) @ U[:, kept].T @ rows
        away = np.einsum("ckl,kl->c", W.conj(), siegel_logarithm(pm.matrix, goal)).real
        return drift - (J @ drift) @ lift, away @ lift
