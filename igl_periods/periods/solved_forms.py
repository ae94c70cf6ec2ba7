r"""The forms whose energies make a period matrix, kept so that their energies can be varied.

    lengths ─ flips, divisions ▶ lengths of the triangulation ─ Rauch ▶ ∂D ─ symplectic mean ▶ ∂Π

Each arrow is linear, forward and backward, and nothing is solved: harmonic forms are stationary
points of their energies.  The first arrow is :mod:`igl_periods.complexes.flipped_lengths`, the
second :mod:`igl_periods.harmonic.length_derivatives`, the third
:mod:`igl_periods.symplectic.estimate_derivatives`.

A period matrix keeps its forms if it is asked to.  Otherwise they are computed again where a
derivative is wanted, by linear functions on the Delaunay triangulation, then on the one that was
given: if the energies are those of the matrix, these are its forms.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import (
    Barycentres,
    DeltaComplex,
    Flips,
    MarkedComplex,
    delaunay_flips,
    flip_derivatives,
    insert_barycentres,
    pull_back,
    push_forward,
    transport,
)
from igl_periods.display import arrays_repr
from igl_periods.elements import (
    HighOrderForms,
    HighOrderGradients,
    dirichlet_matrix,
    high_order_forms,
    rounding_allowance,
)
from igl_periods.errors import ComplexError
from igl_periods.harmonic import (
    CholeskyFactor,
    GradientBlocks,
    HarmonicProblem,
    LinearGradients,
    allowance_for_loss,
    distortions,
    energy_derivatives,
    factored,
    gram_matrix,
    harmonic_problem,
    length_gradient,
    moments,
)
from igl_periods.run_log import stage
from igl_periods.symplectic import product

# Recomputed energies agree with the given ones to rounding, or are others.
_SAME_ENERGIES = 1e-9


@dataclass(frozen=True, eq=False)
class SolvedForms:
    """Harmonic forms on a triangulation that flips and divisions have made from the given one.

    Attributes
    ----------
    lengths, edge : (m, 3) float, (m, 3) int
        Of the triangulation after the moves.
    moves : tuple of Flips or Barycentres
        From the triangulation as given.
    gradients : GradientBlocks
        The forms, in the classes of the raw cochains, on this triangulation or on its midpoint
        refinement.
    parts : int
        1 or 4, accordingly: how many faces of ``gradients`` make one of this triangulation.
    basis : (2g, 2g) int
        The canonical forms in terms of the raw ones.
    """

    lengths: Floats
    edge: Ints
    moves: tuple[Flips | Barycentres, ...]
    gradients: GradientBlocks
    parts: int
    basis: Ints

    __repr__ = arrays_repr

    def in_basis(self, U: Ints) -> SolvedForms:
        """The forms U ω instead of ω."""
        return replace(self, basis=product(U, self.basis))

    def energy_derivatives(self, given: DeltaComplex, by_length: Floats) -> Floats:
        """Derivatives of D as the lengths of ``given`` move; (c, n_edges) to (c, 2g, 2g)."""
        moved = push_forward(flip_derivatives(given, self.moves), by_length)
        mu = distortions(self.lengths, moved[:, self.edge] / self.lengths)
        raw = energy_derivatives(self.gradients, np.repeat(mu, self.parts, axis=1))
        T = self.basis.astype(np.float64)
        return np.asarray(T @ raw @ T.T)

    def length_gradients(self, given: DeltaComplex, S: Floats) -> Floats:
        """Gradients of Σ S_ij D_ij by the lengths of ``given``; (c, 2g, 2g) to (c, n_edges)."""
        T = self.basis.astype(np.float64)
        m = len(self.lengths)
        moment = moments(self.gradients, T.T @ S @ T, self.parts * m)
        by_side = length_gradient(self.lengths, moment.reshape(-1, m, self.parts).sum(axis=2))
        by_side /= self.lengths
        moves = flip_derivatives(given, self.moves)
        n_edges = moves[-1].n_edges if moves else given.n_edges
        by_edge = np.zeros((len(S), n_edges))
        for edges, side in zip(by_edge, by_side):
            edges += np.bincount(self.edge.ravel(), side.ravel(), n_edges)
        return pull_back(moves, by_edge, given.n_edges)


@dataclass(frozen=True, eq=False)
class MovedTriangulation(MarkedComplex):
    """A triangulation that flips and divisions have made of the given one.

    Attributes
    ----------
    moves : tuple of Flips or Barycentres
        In their order.
    """

    moves: tuple[Flips | Barycentres, ...] = ()

    @classmethod
    def of(cls, given: MarkedComplex) -> MovedTriangulation:
        """The triangulation as it is given."""
        return cls(given.complex, given.cochains, given.basis.astype(np.int64))

    def flipped(self) -> MovedTriangulation:
        """The intrinsic Delaunay triangulation."""
        K, rounds = delaunay_flips(self.complex)
        cochains = transport(self.cochains, rounds)
        return MovedTriangulation(K, cochains, self.basis, (*self.moves, *rounds))

    def divided(self, faces: Ints) -> MovedTriangulation:
        """Faces divided into three at their barycentres, then flipped."""
        K, cochains = insert_barycentres(self.complex, self.cochains, faces)
        moves = (*self.moves, Barycentres.of(self.complex, faces))
        return MovedTriangulation(K, cochains, self.basis, moves).flipped()

    def solved(self, gradients: GradientBlocks, n_faces: int) -> SolvedForms:
        """Forms on this triangulation, or on one of ``n_faces`` faces that divides its faces."""
        K = self.complex
        parts = n_faces // K.n_faces
        return SolvedForms(K.lengths, K.edge, self.moves, gradients, parts, self.basis)


def solve_forms(
    given: MarkedComplex, *, delaunay: bool = True, degree: int = 1
) -> tuple[SolvedForms, Floats, float]:
    """The harmonic forms of a surface, their energies in the raw classes, and their rounding."""
    where = MovedTriangulation.of(given)
    if delaunay:
        with stage("Delaunay flips"):
            where = where.flipped()
    with stage("harmonic forms"):
        if degree > 1:
            return with_energies(where, high_order_forms(where.complex, where.cochains, degree))
        laplacian, problem = harmonic_problem(where.complex, where.cochains)
        return linear_with_energies(where, problem, factored(laplacian))


def linear_with_energies(
    where: MovedTriangulation, problem: HarmonicProblem, factor: CholeskyFactor
) -> tuple[SolvedForms, Floats, float]:
    """The forms that are linear on triangles, their energies, and the rounding of these."""
    forms, extreme = problem.forms(slice(0, where.rank), factor)
    D = gram_matrix(forms)
    kept = where.solved(LinearGradients(forms), where.complex.n_faces)
    return kept, D, allowance_for_loss(D, gram_matrix(extreme))


def with_energies(
    where: MovedTriangulation, forms: HighOrderForms
) -> tuple[SolvedForms, Floats, float]:
    """Forms of high degree, their energies, and the rounding of these."""
    D = dirichlet_matrix(forms)
    kept = where.solved(HighOrderGradients(forms), forms.complex.n_faces)
    return kept, D, rounding_allowance(forms, D)


def recomputed_forms(K: DeltaComplex, cocycles: csr_array, D: Floats) -> SolvedForms:
    """The linear forms with the energies D, in a canonical basis of cohomology.

    Raises
    ------
    ComplexError
        If D are not the energies of linear forms, with flips or without.
    """
    given = MarkedComplex(K, cocycles, np.eye(len(D), dtype=np.int64))
    for delaunay in (True, False):
        forms, energies, _ = solve_forms(given, delaunay=delaunay)
        if np.abs(energies - D).max(initial=0.0) <= _SAME_ENERGIES * np.abs(D).max(initial=0.0):
            return forms
    raise ComplexError(
        "the energies of this period matrix are not those of linear forms with cotangent weights, "
        "so its forms are not known any more. From degree 2 on compute it with keep_forms=True; "
        "for extrinsic and abstract weights there is no derivative by lengths."
    )
