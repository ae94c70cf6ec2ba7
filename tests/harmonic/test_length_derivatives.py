"""How energies change with the metric."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.random_surfaces import noisy_torus

from igl_periods.complexes import (
    DeltaComplex,
    cotan_weights,
    double_areas,
    edge_lengths,
    with_edge_lengths,
)
from igl_periods.harmonic import (
    LinearGradients,
    dirichlet_matrix,
    distortions,
    energy_derivatives,
    harmonic_potentials,
    length_gradient,
    moments,
    side_vectors,
)
from igl_periods.harmonic.linear_forms import Jumps, LinearForms, WeightedFaces
from igl_periods.topology import cohomology_basis

K = DeltaComplex.from_mesh(*noisy_torus(7, 6, 0.15, 2))
RNG = np.random.default_rng(0)


def forms(potentials):
    faces = WeightedFaces.of(K)
    return LinearGradients(LinearForms(faces, Jumps.of(K, cohomology_basis(K)), potentials))


def test_sides_close_and_have_their_lengths():
    E = side_vectors(K.lengths)
    assert np.abs(E.sum(axis=1)).max() < 1e-14
    assert np.allclose(np.abs(E), K.lengths, rtol=1e-12)
    assert np.allclose((E[:, 0].conj() * E[:, 1]).imag, double_areas(K.lengths), rtol=1e-10)


def test_distortions_are_those_of_the_quadratic_form():
    """ε(v, v) = ½ tr ε |v|² + Re(μ̄ v²) takes the values λ_s l_s² on the sides."""
    relative = RNG.normal(size=(1, K.n_faces, 3))
    mu = distortions(K.lengths, relative)[0]
    E = side_vectors(K.lengths)
    traces = relative[0] - (mu.conj()[:, None] * E**2).real / K.lengths**2
    assert np.abs(np.ptp(traces, axis=1)).max() < 1e-9 * np.abs(traces).max()


def test_fixed_forms_of_any_potentials():
    """∂∫ω_i ∧ *ω_j is right for all fixed forms, harmonic or not."""
    basis = cohomology_basis(K)
    potentials = RNG.normal(size=(K.n_vertices, basis.shape[0]))
    relative = RNG.normal(size=K.n_edges)
    mu = distortions(K.lengths, relative[K.edge][None])
    found = energy_derivatives(forms(potentials), mu)[0]
    h = 1e-6

    def energies(t):
        moved = with_edge_lengths(K, edge_lengths(K) * np.exp(t * relative))
        return dirichlet_matrix(moved, basis, potentials)

    difference = (energies(h) - energies(-h)) / (2 * h)
    assert np.abs(found - difference).max() < 1e-7 * np.abs(found).max()


def test_gradients_are_the_transpose():
    basis = cohomology_basis(K)
    gradients = forms(harmonic_potentials(K, cotan_weights(K), basis))
    S = RNG.normal(size=(3, 2, 2))
    S = S + S.transpose(0, 2, 1)
    relative = RNG.normal(size=(4, K.n_faces, 3))
    by_side = length_gradient(K.lengths, moments(gradients, S, K.n_faces))
    there = energy_derivatives(gradients, distortions(K.lengths, relative))
    back = np.einsum("cms,dms->cd", by_side, relative)
    assert np.allclose(back, np.einsum("cij,dij->cd", S, there), rtol=1e-10)


def test_scaling_of_every_triangle_by_itself():
    """The conformal structure of a triangle is not changed by scaling: Σ_s λ_s-derivatives = 0."""
    gradients = forms(RNG.normal(size=(K.n_vertices, 2)))
    by_side = length_gradient(K.lengths, moments(gradients, np.ones((1, 2, 2)), K.n_faces))[0]
    assert np.abs(by_side.sum(axis=1)).max() < 1e-12 * np.abs(by_side).max()


@pytest.mark.parametrize("count", [0, 1])
def test_no_forms(count):
    none = LinearGradients(
        LinearForms(
            WeightedFaces.of(K),
            Jumps.of(K, csr_array((0, K.n_edges), dtype=np.int64)),
            np.zeros((K.n_vertices, 0)),
        )
    )
    assert energy_derivatives(none, np.zeros((count, K.n_faces), complex)).size == 0
