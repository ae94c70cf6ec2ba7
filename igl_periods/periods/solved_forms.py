r"""The forms whose energies make a period matrix, kept so that their energies can be varied.

    lengths ─ flips ▶ lengths of the Delaunay triangulation ─ Rauch ▶ ∂D ─ symplectic mean ▶ ∂Π

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

from igl_periods import elements
from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import (
    DeltaComplex,
    Flips,
    MarkedComplex,
    delaunay_flips,
    flip_derivatives,
    pull_back,
    push_forward,
    transport,
)
from igl_periods.display import arrays_repr
from igl_periods.elements import HighOrderGradients, high_order_forms, separate_cones
from igl_periods.errors import ComplexError
from igl_periods.harmonic import (
    GradientBlocks,
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
    """Harmonic forms on a triangulation that flips have made from the given one.

    Attributes
    ----------
    lengths, edge : (m, 3) float, (m, 3) int
        Of the triangulation after the flips.
    rounds : list of Flips
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
    rounds: list[Flips]
    gradients: GradientBlocks
    parts: int
    basis: Ints

    __repr__ = arrays_repr

    def in_basis(self, U: Ints) -> SolvedForms:
        """The forms U ω instead of ω."""
        return replace(self, basis=product(U, self.basis))

    def energy_derivatives(self, given: DeltaComplex, by_length: Floats) -> Floats:
        """Derivatives of D as the lengths of ``given`` move; (c, n_edges) to (c, 2g, 2g)."""
        moved = push_forward(flip_derivatives(given, self.rounds), by_length)
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
        by_edge = np.zeros((len(S), given.n_edges))
        for edges, side in zip(by_edge, by_side):
            edges += np.bincount(self.edge.ravel(), side.ravel(), given.n_edges)
        return pull_back(flip_derivatives(given, self.rounds), by_edge)


def solve_forms(
    given: MarkedComplex, *, delaunay: bool = True, degree: int = 1
) -> tuple[SolvedForms, Floats, float]:
    """The harmonic forms of a surface, their energies in the raw classes, and their rounding."""
    K, cochains, rounds = given.complex, given.cochains, list[Flips]()
    if delaunay:
        with stage("Delaunay flips"):
            K, rounds = delaunay_flips(given.complex)
            cochains = transport(given.cochains, rounds)
    with stage("harmonic forms"):
        solved = _linear if degree == 1 else _high_order
        gradients, D, allowance, faces = solved(K, cochains, degree)
    basis = given.basis.astype(np.int64)
    forms = SolvedForms(K.lengths, K.edge, rounds, gradients, faces // K.n_faces, basis)
    return forms, D, allowance


def _linear(
    K: DeltaComplex, cochains: csr_array, _: int
) -> tuple[GradientBlocks, Floats, float, int]:
    laplacian, problem = harmonic_problem(K, cochains)
    everything = slice(0, cochains.shape[0])
    forms, extreme = problem.forms(everything, factored(laplacian))
    D = gram_matrix(forms)
    return LinearGradients(forms), D, allowance_for_loss(D, gram_matrix(extreme)), K.n_faces


def _high_order(
    K: DeltaComplex, cochains: csr_array, degree: int
) -> tuple[GradientBlocks, Floats, float, int]:
    forms = high_order_forms(*separate_cones(K, cochains), degree)
    D = elements.dirichlet_matrix(forms)
    allowance = elements.rounding_allowance(forms, D)
    return HighOrderGradients(forms), D, allowance, forms.complex.n_faces


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
