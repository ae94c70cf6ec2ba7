"""From energies in balls to a period matrix in floating point, which can have derivatives.

The balls tell where the exact matrix is, and nothing of how it moves.  Its derivative is Rauch's
formula with the exact harmonic forms; forms of high degree in double precision stand for them
(:mod:`igl_periods.periods.derivative`), so that derivatives have an error of the order of the bound
of their degree, and are not proved.
"""

from __future__ import annotations

import flint
import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import DeltaComplex, MarkedComplex
from igl_periods.periods import (
    LEAST_ALLOWANCE,
    Gradient,
    PeriodMatrix,
    checked_options,
    combined,
    congruence,
    solve_forms,
)

# Of forms for derivatives.
_DEGREE = 8


class InFloatingPoint:
    """A period matrix in balls, as one in floating point."""

    dirichlet: flint.arb_mat
    cocycles: csr_array
    complex: DeltaComplex

    def to_period_matrix(self, *, degree: int | None = None) -> PeriodMatrix:
        """The same in floating point, with the allowance for rounding that this costs.

        Parameters
        ----------
        degree : int, optional
            Keep forms of this degree, so that the result has derivatives
            (:meth:`PeriodMatrix.derivative`, ``gradient`` and ``covariance``): those of the exact
            matrix by Rauch's formula.  Nothing is proved of them.  They are off by some multiples
            of the bound that ``period_matrix(complex, degree=degree)`` has, 1 to 60 of them as
            measured, so exponentially little in the degree, until rounding is reached.

        Raises
        ------
        ValueError
            If the degree is no whole number from 1 to 1000.
        """
        n = int(self.dirichlet.nrows())
        D = np.array([float(x.mid()) for x in self.dirichlet.entries()]).reshape(n, n)
        D, loss = congruence(np.eye(n, dtype=np.int8), D)
        forms = None
        if degree is not None:
            degree, _ = checked_options("intrinsic", degree, None)
            marked = MarkedComplex(self.complex, self.cocycles, np.eye(n, dtype=np.int64))
            forms, _, _ = solve_forms(marked, degree=degree)
        return PeriodMatrix(
            dirichlet=D,
            certified=True,
            cocycles=self.cocycles.copy(),
            complex=self.complex,
            rounding=combined(LEAST_ALLOWANCE, loss + _relative_radius(self.dirichlet, D)),
            forms=forms,
        )

    def derivative(
        self,
        *,
        lengths: ArrayLike | None = None,
        vertices: ArrayLike | None = None,
        degree: int = _DEGREE,
    ) -> Complexes:
        """How Π moves as lengths or vertices do, in floating point; (…, g, g) complex.

        For many derivatives make ``to_period_matrix(degree=8)`` once: each call computes the forms.

        Parameters
        ----------
        lengths, vertices : array-like
            As for :meth:`PeriodMatrix.derivative`.
        degree : int
            Of the forms; :meth:`to_period_matrix` says how far the derivative is off.

        Raises
        ------
        ValueError, ComplexError
            As :meth:`PeriodMatrix.derivative` and :meth:`to_period_matrix`.
        """
        pm = self.to_period_matrix(degree=degree)
        return pm.derivative(lengths=lengths, vertices=vertices)

    def gradient(self, W: ArrayLike, *, degree: int = _DEGREE) -> Gradient:
        """The gradient of Re Σ W̄ Π, in floating point; :meth:`derivative`, transposed.

        Raises
        ------
        ValueError, ComplexError
            As :meth:`PeriodMatrix.gradient` and :meth:`to_period_matrix`.
        """
        return self.to_period_matrix(degree=degree).gradient(W)


def _relative_radius(energies: flint.arb_mat, midpoint: Floats) -> float:
    """How much of the energies, relative to them, their radii may be."""
    if len(midpoint) == 0:
        return 0.0
    radius = max(float(x.rad()) for x in energies.entries())
    return float(len(midpoint) * radius / np.linalg.eigvalsh(midpoint)[0])
