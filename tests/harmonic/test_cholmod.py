"""Factors: solutions of systems that are multiplied out, in groups or not, and the refusal."""

import numpy as np
import pytest
from scipy.sparse import csc_array, csc_matrix, diags_array, tril

from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.harmonic import cholmod
from igl_periods.harmonic.cholmod import factor, solve


def definite(n, seed):
    """A sparse integer matrix with a dominant diagonal: products with integers are exact."""
    rng = np.random.default_rng(seed)
    A = rng.integers(-4, 5, (n, n)) * (rng.uniform(size=(n, n)) < 4 / n)
    A = csc_array((A + A.T).astype(float))
    return A + diags_array(abs(A).sum(axis=1) + 1.0)


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


def test_a_matrix_without_rows():
    L = factor(csc_matrix((0, 0)))
    assert solve(L, np.zeros((0, 3))).shape == (0, 3)


@pytest.mark.parametrize("least", [-1.0, -1e-3])
def test_matrices_that_are_not_positive_definite(least):
    A = csc_matrix(np.diag([2.0, least, 1.0]))
    with pytest.raises(NotPositiveDefiniteError, match="the matrix is not positive definite"):
        factor(A)
