"""Harmonic forms: closed, co-closed, of least energy; D against dense linear algebra."""

import numpy as np
import pytest
from random_surfaces import BOLZA, L_SHAPE, noisy_torus, random_gluing, random_lengths

import igl_periods as ip
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.complexes.weights import cotan_weights
from igl_periods.harmonic.energies import dirichlet_matrix, weighted_energies
from igl_periods.harmonic.laplace_matrix import laplacian
from igl_periods.harmonic.potentials import harmonic_potentials


def dense_forms(K, weights, cochains):
    """c + df of least energy by a dense solution, rows."""
    tail, head = edge_ends(K)
    d = np.zeros((K.n_edges, K.n_vertices))
    np.add.at(d, (np.arange(K.n_edges), head), 1.0)
    np.add.at(d, (np.arange(K.n_edges), tail), -1.0)
    d = d[:, 1:]  # f is 0 at the first vertex
    f = -np.linalg.solve(d.T @ (weights[:, None] * d), d.T @ (weights[:, None] * cochains.T))
    return (cochains.T + d @ f).T


def random_surface(seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(int(2 * rng.integers(2, 20)), rng)
    parts = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()
    return max(parts, key=lambda part: part.n_faces)


SURFACES = [
    ip.DeltaComplex.from_squares(L_SHAPE, 1),
    ip.DeltaComplex.from_squares(BOLZA, 3),
    ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.2, 4)),
    *(random_surface(seed) for seed in range(8)),
]


@pytest.mark.parametrize("K", SURFACES)
def test_dirichlet_matrix_is_that_of_a_dense_solution(K):
    # Two routes: face gradients of the CHOLMOD solution, and edge sums of a dense one.
    basis, rho = ip.cohomology_basis(K), cotan_weights(K)
    potentials = harmonic_potentials(K, rho, basis)
    D = dirichlet_matrix(K, basis, potentials)
    forms = dense_forms(K, rho, basis.toarray().astype(float))
    expected = forms @ (rho[:, None] * forms.T)
    np.testing.assert_allclose(D, expected, rtol=0, atol=1e-11 * np.abs(expected).max(initial=0))
    by_edges = weighted_energies(K, rho, basis, potentials)
    np.testing.assert_allclose(D, by_edges, rtol=0, atol=1e-11 * np.abs(expected).max(initial=0))


@pytest.mark.parametrize("K", SURFACES)
def test_forms_are_co_closed(K):
    basis, rho = ip.cohomology_basis(K), cotan_weights(K)
    tail, head = edge_ends(K)
    f = harmonic_potentials(K, rho, basis)
    flow = rho * (basis.toarray() + (f[head] - f[tail]).T)
    for current in flow:
        divergence = np.bincount(head, current, K.n_vertices) - np.bincount(
            tail, current, K.n_vertices
        )
        assert np.abs(divergence).max() < 1e-11 * max(np.abs(current).max(), 1.0)


def test_any_potential_gives_an_upper_bound():
    # Dirichlet's principle in the Loewner order, for crude potentials as well.
    K = ip.DeltaComplex.from_mesh(*noisy_torus(9, 7, 0.15, 1))
    basis, rho = ip.cohomology_basis(K), cotan_weights(K)
    best = harmonic_potentials(K, rho, basis)
    D = dirichlet_matrix(K, basis, best)
    rng = np.random.default_rng(0)
    for size in (1e-8, 1e-3, 1.0):
        worse = dirichlet_matrix(K, basis, best + size * rng.normal(size=best.shape))
        assert np.linalg.eigvalsh(worse - D)[0] >= -1e-14 * np.trace(D)


def test_solver_errors_enter_at_second_order():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 4)
    basis, rho = ip.cohomology_basis(K), cotan_weights(K)
    best = harmonic_potentials(K, rho, basis)
    D = dirichlet_matrix(K, basis, best)
    error = np.random.default_rng(0).normal(size=best.shape)
    excess = [
        np.linalg.norm(dirichlet_matrix(K, basis, best + size * error) - D) for size in (1e-2, 1e-3)
    ]
    assert 99 < excess[0] / excess[1] < 101


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
