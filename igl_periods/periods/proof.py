"""From a surface and forms on it to a period matrix whose bound is proved.

The same steps as in floating point, with balls beside them
(:mod:`igl_periods.proofs.surface_proofs`): lengths follow the flips in balls, the energies of the
computed forms are balls, and the bound of the computed matrix is what follows from them.  A proof
costs a few sums over the faces; the solution of the equations, which is hard, needs none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from igl_periods.arrays import Ints
from igl_periods.complexes import MarkedComplex
from igl_periods.elements import HighOrderForms
from igl_periods.errors import ComplexError
from igl_periods.harmonic import CholeskyFactor
from igl_periods.proofs import (
    EnclosedProblem,
    EnclosedTriangulation,
    ProvedEnergies,
    high_order_proof,
    linear_problem,
    linear_proof,
)
from igl_periods.run_log import stage

from .matrix import PeriodMatrix


@dataclass(frozen=True, eq=False)
class Proved:
    """Energies in balls, :class:`igl_periods.periods.certificate.Method`.

    Attributes
    ----------
    given : MarkedComplex
        The surface as it was given.
    """

    given: MarkedComplex

    def triangulation(self, delaunay: bool) -> EnclosedTriangulation:
        """The surface as it was given, or its intrinsic Delaunay triangulation."""
        where = EnclosedTriangulation.of(self.given)
        if not delaunay:
            return where
        with stage("Delaunay flips"):
            return where.flipped()

    def divided(self, where: MarkedComplex, faces: Ints) -> EnclosedTriangulation:
        """Faces divided into three at their barycentres, then flipped."""
        return _enclosed(where).divided(faces)

    def problem(self, where: MarkedComplex) -> tuple[csr_matrix, EnclosedProblem]:
        """The grounded Laplacian, and all else that :meth:`linear` needs of the triangulation."""
        return linear_problem(_enclosed(where))

    def linear(
        self, problem: EnclosedProblem, factor: CholeskyFactor, memory: float | None
    ) -> PeriodMatrix:
        """From the harmonic forms that are linear on triangles."""
        return self._period_matrix(linear_proof(problem, factor, memory))

    def high_order(self, where: MarkedComplex, forms: HighOrderForms) -> PeriodMatrix:
        """From forms of high degree."""
        with stage("energies"):
            return self._period_matrix(high_order_proof(_enclosed(where), forms))

    def _period_matrix(self, energies: ProvedEnergies) -> PeriodMatrix:
        pm = PeriodMatrix(
            dirichlet=energies.dirichlet(),
            certified=True,
            cocycles=self.given.cocycles(),
            complex=self.given.complex,
            rounding=energies.spread,
            proof=energies,
        )
        if not np.isfinite(pm.bound or 0.0):
            raise ComplexError(
                "nothing can be proved about the period matrix: rounding leaves no digits of the "
                "energies of the forms. The triangles are too extreme for double precision. "
                "Remesh them; with delaunay=False (--no-delaunay) let edges be flipped."
            )
        return pm


def _enclosed(where: MarkedComplex) -> EnclosedTriangulation:
    """The triangulation, which this method made itself."""
    assert isinstance(where, EnclosedTriangulation)
    return where
