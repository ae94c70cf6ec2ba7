"""From a surface and forms on it to a period matrix that keeps the forms for derivatives.

The same steps as without (:class:`~igl_periods.periods.certificate.WithAllowance`); the moves that
lead from the given triangulation to the one that carries the forms are written down, as derivatives
by the given lengths go back through them.  The forms of all classes are in memory at once.
"""

from __future__ import annotations

from dataclasses import dataclass

from scipy.sparse import csr_matrix

from igl_periods.arrays import Ints
from igl_periods.complexes import MarkedComplex
from igl_periods.elements import HighOrderForms
from igl_periods.harmonic import CholeskyFactor, HarmonicProblem, harmonic_problem
from igl_periods.run_log import stage

from .certificate import certified_period_matrix
from .matrix import PeriodMatrix
from .solved_forms import MovedTriangulation, linear_with_energies, with_energies


@dataclass(frozen=True, eq=False)
class Keeping:
    """Energies in floating point, :class:`~igl_periods.periods.certificate.Method`.

    Attributes
    ----------
    given : MarkedComplex
        The surface as it was given.
    """

    given: MarkedComplex

    def triangulation(self, delaunay: bool) -> MovedTriangulation:
        """The surface as it was given, or its intrinsic Delaunay triangulation."""
        where = MovedTriangulation.of(self.given)
        if not delaunay:
            return where
        with stage("Delaunay flips"):
            return where.flipped()

    def divided(self, where: MarkedComplex, faces: Ints) -> MovedTriangulation:
        """Faces divided into three at their barycentres, then flipped."""
        return _moved(where).divided(faces)

    def problem(
        self, where: MarkedComplex
    ) -> tuple[csr_matrix, tuple[MovedTriangulation, HarmonicProblem]]:
        """The grounded Laplacian, and all else that :meth:`linear` needs of the triangulation."""
        laplacian, problem = harmonic_problem(where.complex, where.cochains)
        return laplacian, (_moved(where), problem)

    def linear(
        self,
        problem: tuple[MovedTriangulation, HarmonicProblem],
        factor: CholeskyFactor,
        memory: float | None,
    ) -> PeriodMatrix:
        """From the harmonic forms that are linear on triangles."""
        forms, raw, allowance = linear_with_energies(*problem, factor)
        return certified_period_matrix(self.given, raw, allowance, forms)

    def high_order(self, where: MarkedComplex, forms: HighOrderForms) -> PeriodMatrix:
        """From forms of high degree."""
        with stage("energies"):
            kept, raw, allowance = with_energies(_moved(where), forms)
        return certified_period_matrix(self.given, raw, allowance, kept)


def _moved(where: MarkedComplex) -> MovedTriangulation:
    """The triangulation, which this method made itself."""
    assert isinstance(where, MovedTriangulation)
    return where
