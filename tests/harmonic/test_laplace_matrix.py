"""The Laplace matrix, and weights that are not an energy."""

import numpy as np
import pytest
from support.random_surfaces import BOLZA, noisy_torus
from support.small_closed_surfaces import SURFACES

import igl_periods as ip
from igl_periods.complexes.weights import cotan_weights
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.laplace_matrix import laplacian
from igl_periods.harmonic.potentials import harmonic_potentials


def test_laplacian_kills_constants_and_is_symmetric():
    for K in SURFACES:
        L = laplacian(K, cotan_weights(K)).toarray()
        assert np.array_equal(L, L.T)
        assert np.abs(L.sum(axis=1)).max() < 1e-12 * max(np.abs(L).max(), 1.0)


def test_face_weights_count_faces():
    K = ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0))
    basis = ip.cohomology_basis(K)
    f = harmonic_potentials(K, cotan_weights(K), basis)
    weights = np.random.default_rng(0).uniform(0, 1, K.n_faces) * (np.arange(K.n_faces) % 3 > 0)
    both = dirichlet_matrix(K, basis, f, weights) + dirichlet_matrix(K, basis, f, 1 - weights)
    np.testing.assert_allclose(both, dirichlet_matrix(K, basis, f), rtol=1e-13)


def test_weights_that_are_no_energy_are_refused():
    K = ip.DeltaComplex.from_squares(BOLZA, 2)
    rho = np.abs(cotan_weights(K))
    rho[:20] = -1.0
    between = -np.triu(laplacian(K, rho).toarray()[1:, 1:], 1)
    message = rf"{np.count_nonzero(between < 0)} weights between vertices are negative, the least "
    assert np.count_nonzero(between < 0) > 5
    with pytest.raises(ip.ComplexError, match=message + "is -1;"):
        harmonic_potentials(K, rho, ip.cohomology_basis(K))
