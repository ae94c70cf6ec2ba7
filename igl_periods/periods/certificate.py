"""From the energies of forms in raw classes to the certified matrix in the canonical basis.

Energies are computed for the thin, sparse cochains of the cotree; the integer change of basis T is
applied to the 2g × 2g matrix, T D Tᵀ, not to 2g dense forms.

There are two ways from forms to a matrix with a bound, and a :class:`Method` is one of them: in
floating point, with an allowance for rounding (:class:`WithAllowance`), or in balls
(:class:`igl_periods.periods.proof.Proved`).
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol

from scipy.sparse import csr_matrix

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import MarkedComplex, insert_barycentres, intrinsic_delaunay
from igl_periods.elements import HighOrderForms, dirichlet_matrix, rounding_allowance
from igl_periods.errors import ComplexError
from igl_periods.harmonic import (
    CholeskyFactor,
    HarmonicProblem,
    energies_from_residuals,
    harmonic_energies,
    harmonic_problem_of_many,
)
from igl_periods.run_log import stage

from .matrix import PeriodMatrix
from .rounding import LEAST_ALLOWANCE, combined, congruence
from .solved_forms import SolvedForms

# Where rounding may change energies by more, relative to them, nothing is known of the matrix.
_LARGEST_ROUNDING = 1.0
# The part of a bound that energies from residuals may owe to rounding.
_NEGLIGIBLE = 1e-2


class Method(Protocol):
    """From a surface and forms on it to a period matrix with a bound.

    Triangulations are handed from each step to the next, and are those of the method itself.
    """

    def triangulation(self, delaunay: bool) -> MarkedComplex:
        """The surface as it was given, or its intrinsic Delaunay triangulation."""

    def divided(self, where: MarkedComplex, faces: Ints) -> MarkedComplex:
        """Faces divided into three at their barycentres, then flipped."""

    def problem(self, where: MarkedComplex) -> tuple[csr_matrix, Any]:
        """The grounded Laplacian, and all else that :meth:`linear` needs of the triangulation."""

    def linear(self, problem: Any, factor: CholeskyFactor, memory: float | None) -> PeriodMatrix:
        """From the harmonic forms that are linear on triangles."""

    def high_order(self, where: MarkedComplex, forms: HighOrderForms) -> PeriodMatrix:
        """From forms of high degree."""


@dataclass(frozen=True, eq=False)
class WithAllowance:
    """Energies in floating point, with an allowance for what rounding can change in them.

    Attributes
    ----------
    given : MarkedComplex
        The surface as it was given.
    """

    given: MarkedComplex

    def triangulation(self, delaunay: bool) -> MarkedComplex:
        """The surface as it was given, or its intrinsic Delaunay triangulation."""
        if not delaunay:
            return self.given
        with stage("Delaunay flips"):
            return self.given.after(intrinsic_delaunay)

    def divided(self, where: MarkedComplex, faces: Ints) -> MarkedComplex:
        """Faces divided into three at their barycentres, then flipped."""
        return where.after(partial(insert_barycentres, faces=faces)).after(intrinsic_delaunay)

    def problem(self, where: MarkedComplex) -> tuple[csr_matrix, HarmonicProblem]:
        """The grounded Laplacian, and all else that :meth:`linear` needs of the triangulation."""
        return harmonic_problem_of_many(where.complex, where.cochains)

    def linear(
        self, problem: HarmonicProblem, factor: CholeskyFactor, memory: float | None
    ) -> PeriodMatrix:
        """From the harmonic forms that are linear on triangles.

        Of many forms by residuals first: what these leave open hardly ever counts beside the bound.
        """
        many = problem.residuals
        if many is not None and (memory is None or many.bytes_kept <= memory):
            with suppress(ComplexError):
                pm = certified_period_matrix(self.given, *energies_from_residuals(many, factor))
                if pm.rounding <= _NEGLIGIBLE * (pm.bound or 0.0):
                    return pm
        return certified_period_matrix(self.given, *harmonic_energies(problem, factor, memory))

    def high_order(self, where: MarkedComplex, forms: HighOrderForms) -> PeriodMatrix:
        """From forms of high degree."""
        with stage("energies"):
            D = dirichlet_matrix(forms)
            return certified_period_matrix(self.given, D, rounding_allowance(forms, D))


def certified_period_matrix(
    given: MarkedComplex, raw: Floats, allowance: float, forms: SolvedForms | None = None
) -> PeriodMatrix:
    """The period matrix in the canonical basis, from energies in the classes of the cochains.

    Parameters
    ----------
    given : MarkedComplex
        The surface as it was given, before any flip.
    raw : (2g, 2g) float
        Energies of explicit forms in the classes of ``given.cochains``.
    allowance : float
        What rounding can have changed in them, relative to them.
    forms : SolvedForms, optional
        The forms, to be kept.

    Raises
    ------
    ComplexError
        If that is so much that nothing is known of the matrix.
    """
    D, loss = congruence(given.basis, raw)
    rounding = combined(allowance, loss)
    if rounding > _LARGEST_ROUNDING:
        raise ComplexError(
            f"rounding may change the energies of the forms by a factor {1 + rounding:.3g}: the "
            "triangles are too extreme for double precision. Remesh them; with delaunay=False "
            "(--no-delaunay) let edges be flipped."
        )
    return PeriodMatrix(
        dirichlet=D,
        certified=True,
        cocycles=given.cocycles(),
        complex=given.complex,
        rounding=max(LEAST_ALLOWANCE, rounding),
        forms=forms,
    )
