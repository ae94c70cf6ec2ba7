"""Energies: against dense linear algebra, and in portions that change nothing."""

import itertools
import tracemalloc

import numpy as np
import pytest
from support.jittered_lattice import lattice
from support.random_surfaces import BOLZA, noisy_torus, random_gluing, random_lengths
from support.small_closed_surfaces import SURFACES

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.complexes.weights import cotan_weights
from igl_periods.harmonic import energies as harmonic_energies
from igl_periods.harmonic.energies import (
    dirichlet_matrix,
    harmonic_problem,
    linear_energies,
    weighted_energies,
)
from igl_periods.harmonic.potentials import factored, harmonic_potentials
from igl_periods.harmonic.rounding import geometric_allowance
from igl_periods.surfaces import thickened_lattice
from igl_periods.topology.cohomology import cochains_and_basis


def dense_forms(K, weights, cochains):
    """c + df of least energy by a dense solution, rows."""
    tail, head = edge_ends(K)
    d = np.zeros((K.n_edges, K.n_vertices))
    np.add.at(d, (np.arange(K.n_edges), head), 1.0)
    np.add.at(d, (np.arange(K.n_edges), tail), -1.0)
    d = d[:, 1:]  # f is 0 at the first vertex
    f = -np.linalg.solve(d.T @ (weights[:, None] * d), d.T @ (weights[:, None] * cochains.T))
    return (cochains.T + d @ f).T


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


def test_panels_give_the_same_energies(monkeypatch):
    K = lattice((4, 4, 3))
    cochains, _ = cochains_and_basis(K)
    whole, allowance = linear_energies(K, cochains)
    scale = np.sqrt(np.diag(whole))
    columns = []
    solutions = harmonic_energies.solutions
    monkeypatch.setattr(
        harmonic_energies,
        "solutions",
        lambda factor, sources: columns.append(sources.shape[1]) or solutions(factor, sources),
    )
    for memory in (0.0, 16.0 * K.n_vertices * 50):
        columns.clear()
        parts, rounding = linear_energies(K, cochains, memory)
        assert np.array_equal(parts, parts.T)
        assert np.abs(parts - whole).max() <= 1e-13 * np.outer(scale, scale).max()
        assert (np.abs(parts - whole) <= 1e-13 * np.outer(scale, scale)).all()
        assert rounding == pytest.approx(allowance, rel=1e-9)
        width = 32 if memory == 0.0 else 50
        panels = -(-len(whole) // width)
        assert len(columns) == panels * (panels + 1) // 2
        assert max(columns) == width


def test_panels_hold_no_more_than_they_may():
    K = ip.DeltaComplex.from_mesh(*thickened_lattice((4, 4, 4), 4, jitter=0.1))
    cochains, _ = cochains_and_basis(K)
    laplacian, problem = harmonic_problem(K, cochains)
    factor = factored(laplacian)

    def peak(memory):
        tracemalloc.start()
        harmonic_energies.harmonic_energies(problem, factor, memory)
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most

    n, k = problem.sources.shape
    functions = 8 * n * k
    saved = peak(None) - peak(functions / 3)
    # All functions against two panels that together take a third.
    assert 0.55 * functions < saved < 0.75 * functions


@pytest.mark.parametrize(
    "K",
    [
        ip.DeltaComplex.from_squares(BOLZA, 3),
        ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.2, 4)),
        lattice((2, 2, 2)),
    ],
)
def test_energies_and_allowance_are_those_of_the_potentials(K):
    cochains, _ = cochains_and_basis(K)
    L, carried = intrinsic_delaunay(K, cochains)
    potentials = harmonic_potentials(L, cotan_weights(L), carried)
    expected = dirichlet_matrix(L, carried, potentials)
    D, allowance = linear_energies(L, carried)
    np.testing.assert_allclose(D, expected, rtol=1e-12, atol=1e-13)
    assert allowance == pytest.approx(
        geometric_allowance(
            L, D, lambda weights: dirichlet_matrix(L, carried, potentials, weights)
        ),
        rel=1e-9,
    )


def test_energies_on_a_surface_with_one_vertex():
    rng = np.random.default_rng(11)
    gluings = (random_gluing(6, rng) for _ in itertools.count())
    surfaces = (ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin) for twin in gluings)
    K = next(K for K in surfaces if K.n_vertices == 1)
    cochains, _ = cochains_and_basis(K)
    D, _ = linear_energies(K, cochains)
    expected = dirichlet_matrix(K, cochains, np.zeros((1, 2 * K.genus)))
    assert np.array_equal(D, expected)
