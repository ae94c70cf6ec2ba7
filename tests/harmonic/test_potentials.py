"""Harmonic potentials: co-closed forms of least energy."""

import numpy as np
import pytest
from support.random_surfaces import L_SHAPE, noisy_torus
from support.small_closed_surfaces import SURFACES

import igl_periods as ip
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.complexes.weights import cotan_weights
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.potentials import harmonic_potentials


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
