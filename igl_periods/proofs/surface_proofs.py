r"""Energies of the harmonic forms of a surface, proved: the steps, one after the other.

    K, cochains ─ flips, in balls ▶ K′, cochains′, lengths ─ solve, in floats ▶ potentials
         ─ energies, in balls ▶ E

**Which surface.**  The theorem is about the polyhedral surface whose triangles have the side
lengths that ``DeltaComplex.lengths`` stores, every one of them a floating-point number, taken
exactly: after glued sides were averaged, and after mollification, if there was any.  For a mesh
they are distances of its vertices, rounded.  Where the complex carries exact lengths, as √2 is one,
the theorem is about the surface with these as well.

**What is trusted.**  Three things that are integers, and exact: the gluing, the cochains with
their sums when edges are flipped, and the canonical basis of cohomology.  The values of the
forms are trusted to be nothing: a solver found them, and any values do.  Everything else is done
in balls: the lengths of flipped edges and that they can be flipped
(:mod:`~igl_periods.proofs.length_balls`), the shapes of triangles, the energies of the forms,
and the last step to the period matrix (:mod:`~igl_periods.proofs.siegel_radius`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_array, csr_matrix

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import MarkedComplex, delaunay_flips, insert_barycentres, transport
from igl_periods.elements import HighOrderForms, dirichlet_matrix
from igl_periods.harmonic import (
    CholeskyFactor,
    HarmonicProblem,
    LinearForms,
    gram_matrix,
    harmonic_problem,
    panels_of_columns,
)

from . import linear_energies, polynomial_energies
from .length_balls import after_barycentres, after_flips, after_midpoints, lengths_of_edges
from .linear_energies import EnclosedForms
from .midpoint_radius import Balls, check_arithmetic
from .proved_energies import CombinedJumps, ProvedEnergies, orthonormal_combination


@dataclass(frozen=True, eq=False)
class EnclosedTriangulation(MarkedComplex):
    """A triangulation of a surface, with the lengths of its edges in balls.

    Attributes
    ----------
    lengths : (n_edges,) balls
    """

    lengths: Balls

    @classmethod
    def of(cls, given: MarkedComplex) -> EnclosedTriangulation:
        """The triangulation as it is given, whose stored lengths are those of the surface.

        Raises
        ------
        ArithmeticError
            If floating-point arithmetic is not what proofs need.
        ComplexError
            If glued sides have different lengths.
        """
        check_arithmetic()
        lengths = lengths_of_edges(given.complex)
        return cls(given.complex, given.cochains, given.basis.astype(np.int64), lengths)

    def flipped(self) -> EnclosedTriangulation:
        """The intrinsic Delaunay triangulation, or one near it.

        Raises
        ------
        ComplexError
            If rounding hides whether an edge can be flipped.
        """
        K, rounds = delaunay_flips(self.complex)
        lengths = after_flips(self.lengths, rounds)
        return EnclosedTriangulation(K, transport(self.cochains, rounds), self.basis, lengths)

    def divided(self, faces: Ints) -> EnclosedTriangulation:
        """Faces divided into three at their barycentres, then flipped."""
        K, cochains = insert_barycentres(self.complex, self.cochains, faces)
        lengths = after_barycentres(self.complex, self.lengths, faces)
        return EnclosedTriangulation(K, cochains, self.basis, lengths).flipped()


@dataclass(frozen=True, eq=False)
class EnclosedProblem:
    """The harmonic forms of a triangulation that are linear on triangles, before they are known.

    Attributes
    ----------
    problem : HarmonicProblem
    sides : (m, 3) balls
        The lengths of the sides of the faces.
    cochains : (2g, n_edges) sparse int
    basis : (2g, 2g) int
    """

    problem: HarmonicProblem
    sides: Balls
    cochains: csr_array
    basis: Ints


def linear_problem(where: EnclosedTriangulation) -> tuple[csr_matrix, EnclosedProblem]:
    """The grounded Laplacian, and all else that is needed of a triangulation."""
    laplacian, problem = harmonic_problem(where.complex, where.cochains)
    sides = where.lengths[where.complex.edge]
    return laplacian, EnclosedProblem(problem, sides, where.cochains, where.basis)


def linear_proof(
    enclosed: EnclosedProblem, factor: CholeskyFactor, memory: float | None = None
) -> ProvedEnergies:
    """Energies of the harmonic forms that are linear on triangles.

    Parameters
    ----------
    enclosed : EnclosedProblem
    factor : CholeskyFactor
        Of the grounded Laplacian.
    memory : float, optional
        Bytes that the functions may take; with less than all need, they are computed in portions.

    Raises
    ------
    ComplexError
        If a triangle may be degenerate, or the energies are not positive definite.
    """
    problem = enclosed.problem
    n, k = problem.sources.shape
    panels = panels_of_columns(n, k, None if memory is None else 0.5 * memory)
    if len(panels) > 1:
        return _by_panels(enclosed, factor, panels)
    forms, _ = problem.forms(slice(0, k), factor)
    orthonormal, W = nearly_orthonormal(forms, enclosed.cochains, enclosed.sides)
    return _proved(linear_energies.enclosed_energies(orthonormal), W, enclosed.basis)


def nearly_orthonormal(
    forms: LinearForms, cochains: csr_array, sides: Balls
) -> tuple[EnclosedForms, Floats]:
    """Forms in the classes W c, orthonormal up to rounding, and the matrix W.

    Parameters
    ----------
    forms : LinearForms
        In the classes c of the cochains (k, n_edges).
    sides : (m, 3) balls
        Lengths of the sides of the faces.
    """
    W = orthonormal_combination(gram_matrix(forms), cochains)
    jumps = CombinedJumps(forms.jumps, W)
    corner_vertex = forms.faces.corner_vertex
    return EnclosedForms(sides, corner_vertex, jumps, forms.potentials @ W.T), W


def high_order_proof(where: EnclosedTriangulation, forms: HighOrderForms) -> ProvedEnergies:
    """Energies of forms of high degree.

    Parameters
    ----------
    where : EnclosedTriangulation
    forms : HighOrderForms
        In the classes of its cochains, on its complex or on the one divided at midpoints.

    Raises
    ------
    ComplexError
        If a triangle may be degenerate.
    """
    lengths = where.lengths
    if forms.complex is not where.complex:
        lengths = after_midpoints(where.complex, lengths)
    W = orthonormal_combination(dirichlet_matrix(forms), forms.cochains)
    combined = replace(
        forms, cochains=csr_array(csr_array(W) @ forms.cochains), traces=forms.traces @ W.T
    )
    energies = polynomial_energies.enclosed_energies(combined, lengths[forms.complex.edge])
    return _proved(energies, W, where.basis)


def _by_panels(
    enclosed: EnclosedProblem, factor: CholeskyFactor, panels: list[slice]
) -> ProvedEnergies:
    """The energies of the forms as they are, in portions, where all have no room at once."""
    k = enclosed.problem.sources.shape[1]
    mid, rad = np.zeros((k, k)), np.zeros((k, k))
    for i, rows in enumerate(panels):
        held = _portion(enclosed, rows, factor)
        for columns in panels[i:]:
            other = None if columns == rows else _portion(enclosed, columns, factor)
            part = linear_energies.enclosed_energies(held, other)
            for whole, values in ((mid, part.mid), (rad, part.rad)):
                whole[rows, columns], whole[columns, rows] = values, values.T
    return _proved(Balls(mid, rad), np.eye(k), enclosed.basis)


def _portion(enclosed: EnclosedProblem, columns: slice, factor: CholeskyFactor) -> EnclosedForms:
    forms, _ = enclosed.problem.forms(columns, factor)
    return EnclosedForms(enclosed.sides, forms.faces.corner_vertex, forms.jumps, forms.potentials)


def _proved(energies: Balls, W: Floats, basis: Ints) -> ProvedEnergies:
    return ProvedEnergies(energies.mid, energies.rad, W, basis)
