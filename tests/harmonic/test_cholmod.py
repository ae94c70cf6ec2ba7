"""Factors: solutions of systems that are multiplied out, in groups or not, and the refusal."""

import numpy as np
import pytest
from scipy.sparse import csc_array, csc_matrix, csr_matrix, diags_array, tril
from sksparse.cholmod import analyze

from igl_periods.complexes import DeltaComplex
from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.harmonic import cholmod
from igl_periods.harmonic.cholmod import factor, solve


def definite(n, seed):
    """A sparse integer matrix with a dominant diagonal: products with integers are exact."""
    rng = np.random.default_rng(seed)
    A = rng.integers(-4, 5, (n, n)) * (rng.uniform(size=(n, n)) < 4 / n)
    A = csc_array((A + A.T).astype(float))
    return A + diags_array(abs(A).sum(axis=1) + 1.0)


def quartered(F, n_vertices):
    """Every triangle of a simplicial complex into four; new vertices come last."""
    sides = np.sort(np.stack([F[:, [1, 2, 0]], F[:, [2, 0, 1]]], axis=-1).reshape(-1, 2), axis=1)
    edges, index = np.unique(sides, axis=0, return_inverse=True)
    mid = n_vertices + index.reshape(-1, 3)
    corners = [np.stack([F[:, s], mid[:, s - 1], mid[:, s - 2]], axis=1) for s in range(3)]
    return np.concatenate([*corners, mid]), n_vertices + len(edges)


def lower_graph_laplacian(F, n_vertices):
    """The lower triangle of one plus the Laplacian of a graph, its edges unweighted."""
    sides = np.sort(np.stack([F[:, [1, 2, 0]], F[:, [2, 0, 1]]], axis=-1).reshape(-1, 2), axis=1)
    low, high = np.unique(sides, axis=0).T
    degree = np.bincount(low, minlength=n_vertices) + np.bincount(high, minlength=n_vertices)
    edges = csr_matrix((-np.ones(low.size), (high, low)), shape=(n_vertices, n_vertices))
    return csr_matrix(edges + diags_array(degree + 1.0))


def lower_triangle(A):
    return csc_matrix(tril(A, format="csc"))


@pytest.mark.parametrize("n", [1, 2, 30, 400])
def test_solutions_are_what_was_multiplied_out(n):
    A = definite(n, n)
    # More columns than are solved for at once.
    x = np.random.default_rng(0).integers(-9, 9, (n, 2 * cholmod._SOLVES_AT_ONCE + 3)) + 0.0
    L = factor(lower_triangle(A))
    assert L.size == n
    np.testing.assert_allclose(solve(L, A @ x), x, rtol=0, atol=1e-11)


def test_sparse_loads_and_results_in_place_are_the_same_bit_for_bit():
    A = definite(60, 1)
    load = np.random.default_rng(2).integers(-1, 2, (60, 40)) + 0.0
    L = factor(lower_triangle(A))
    expected, out = solve(L, load), np.full((60, 40), np.nan)
    assert np.array_equal(solve(L, csc_array(load)), expected)
    assert solve(L, load, out) is out
    assert np.array_equal(out, expected)


def test_only_the_lower_triangle_is_read():
    A, x = definite(30, 3), np.arange(30.0)[:, None]
    upper_is_wrong = csc_matrix(tril(A) + 7 * (A - tril(A)))
    np.testing.assert_allclose(solve(factor(upper_is_wrong), A @ x), x, rtol=0, atol=1e-11)


def test_lower_triangles_by_rows_are_those_by_columns():
    A, load = definite(50, 4), np.arange(100.0).reshape(50, 2)
    by_rows, by_columns = csr_matrix(tril(A)), csc_matrix(tril(A))
    assert np.array_equal(solve(factor(by_rows), load), solve(factor(by_columns), load))


def test_old_vertices_first_make_a_smaller_factor_of_a_refined_mesh():
    K = DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=6)
    F, n_vertices = K.corner_vertex, K.n_vertices
    for _ in range(3):
        F, n_vertices = quartered(F, n_vertices)
    A = lower_graph_laplacian(F, n_vertices)
    as_it_is = analyze(csc_matrix(A), mode="supernodal", ordering_method="amd")
    as_it_is.cholesky_inplace(csc_matrix(A))
    assert factor(A)._factor.L().nnz < 0.95 * as_it_is.L().nnz


def test_a_matrix_without_rows():
    L = factor(csc_matrix((0, 0)))
    assert solve(L, np.zeros((0, 3))).shape == (0, 3)


@pytest.mark.parametrize("least", [-1.0, -1e-3])
def test_matrices_that_are_not_positive_definite(least):
    A = csc_matrix(np.diag([2.0, least, 1.0]))
    with pytest.raises(NotPositiveDefiniteError, match="the matrix is not positive definite"):
        factor(A)
