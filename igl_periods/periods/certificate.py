"""From the energies of forms in raw classes to the certified matrix in the canonical basis.

Energies are computed for the thin, sparse cochains of the cotree; the integer change of basis T is
applied to the 2g × 2g matrix, T D Tᵀ, not to 2g dense forms.

There are two ways from forms to a matrix with a bound, and a :class:`Method` is one of them: in
floating point, with an allowance for rounding (:class:`WithAllowance`), or in balls
(:class:`igl_periods.enclosures.proof.Proved`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, insert_barycentres, intrinsic_delaunay
from igl_periods.elements import HighOrderForms, dirichlet_matrix, rounding_allowance
from igl_periods.errors import ComplexError
from igl_periods.harmonic import CholeskyFactor, harmonic_energies, harmonic_problem
from igl_periods.harmonic.energies import HarmonicProblem
from igl_periods.run_log import stage

from .matrix import PeriodMatrix
from .rounding import LEAST_ALLOWANCE, combined, congruence

# Where rounding may change energies by more, relative to them, nothing is known of the matrix.
_LARGEST_ROUNDING = 1.0


@dataclass(frozen=True, eq=False)
class Triangulation:
    """A triangulation of the surface with the marking on it, before cone points are separated.

    Attributes
    ----------
    complex : DeltaComplex
    cochains : (2g, n_edges) sparse int
        Closed.
    basis : (2g, 2g) int
        The matrix T for which T cochains is a canonical basis.
    """

    complex: DeltaComplex
    cochains: csr_array
    basis: Ints


class Method(Protocol):
    """From a surface and forms on it to a period matrix with a bound.

    Triangulations are handed from each step to the next, and are those of the method itself.
    """

    def triangulation(self, delaunay: bool) -> Triangulation:
        """The surface as it was given, or its intrinsic Delaunay triangulation."""

    def divided(self, where: Triangulation, faces: Ints) -> Triangulation:
        """Faces divided into three at their barycentres, then flipped."""

    def problem(self, where: Triangulation) -> tuple[csc_matrix, Any]:
        """The grounded Laplacian, and all else that :meth:`linear` needs of the triangulation."""

    def linear(self, problem: Any, factor: CholeskyFactor, memory: float | None) -> PeriodMatrix:
        """From the harmonic forms that are linear on triangles."""

    def high_order(self, where: Triangulation, forms: HighOrderForms) -> PeriodMatrix:
        """From forms of high degree."""


@dataclass(frozen=True, eq=False)
class WithAllowance:
    """Energies in floating point, with an allowance for what rounding can change in them.

    Attributes
    ----------
    complex : DeltaComplex
        The surface as it was given.
    cochains : (2g, n_edges) sparse int
        Closed, on its edges.
    basis : (2g, 2g) int
        The canonical basis is ``basis`` times ``cochains``.
    """

    complex: DeltaComplex
    cochains: csr_array
    basis: NDArray[np.int8]

    def triangulation(self, delaunay: bool) -> Triangulation:
        """The surface as it was given, or its intrinsic Delaunay triangulation."""
        K, cochains = self.complex, self.cochains
        if delaunay:
            with stage("Delaunay flips"):
                K, cochains = intrinsic_delaunay(K, cochains)
        return Triangulation(K, cochains, self.basis.astype(np.int64))

    def divided(self, where: Triangulation, faces: Ints) -> Triangulation:
        """Faces divided into three at their barycentres, then flipped."""
        finer = insert_barycentres(where.complex, where.cochains, faces)
        return Triangulation(*intrinsic_delaunay(*finer), where.basis)

    def problem(self, where: Triangulation) -> tuple[csc_matrix, HarmonicProblem]:
        """The grounded Laplacian, and all else that :meth:`linear` needs of the triangulation."""
        return harmonic_problem(where.complex, where.cochains)

    def linear(
        self, problem: HarmonicProblem, factor: CholeskyFactor, memory: float | None
    ) -> PeriodMatrix:
        """From the harmonic forms that are linear on triangles."""
        return self.certified(*harmonic_energies(problem, factor, memory))

    def high_order(self, where: Triangulation, forms: HighOrderForms) -> PeriodMatrix:
        """From forms of high degree."""
        with stage("energies"):
            D = dirichlet_matrix(forms)
            return self.certified(D, rounding_allowance(forms, D))

    def certified(self, raw: Floats, allowance: float) -> PeriodMatrix:
        """From the energies of forms in the classes of the cochains."""
        return certified_period_matrix(self.complex, self.cochains, self.basis, raw, allowance)


def certified_period_matrix(
    K: DeltaComplex, cochains: csr_array, T: NDArray[np.int8], raw: Floats, allowance: float
) -> PeriodMatrix:
    """The period matrix in the canonical basis T c, from energies in the classes c."""
    D, loss = congruence(T, raw)
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
        cocycles=combined_cochains(T, cochains),
        complex=K,
        rounding=max(LEAST_ALLOWANCE, rounding),
    )


def combined_cochains(T: NDArray[np.int8], cochains: csr_array) -> csr_array:
    """The cochains T c, with integers that have room."""
    return csr_array(csr_array(T.astype(np.int64)) @ cochains)
