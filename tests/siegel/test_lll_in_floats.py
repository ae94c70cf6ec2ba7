"""LLL reduction in floating point, checked by the definition."""

import flint
import numpy as np
import pytest
from support.lattice_reduction import exactly_lll_reduced

from igl_periods.siegel.lll import is_lll_reduced, lll_basis
from igl_periods.siegel.lll_in_floats import all_swap_lll


@pytest.mark.parametrize("n", [40, 41, 60])
def test_large_lattices_are_reduced_by_the_definition(n):
    rng = np.random.default_rng(n)
    A = rng.standard_normal((n, n)) / np.sqrt(n)
    V = np.eye(n)
    for i, j in rng.integers(n, size=(3 * n, 2)):
        V[i] += rng.integers(-1, 2) * V[j] * (i != j)
    Y = V @ (A @ A.T + 0.1 * np.eye(n)) @ V.T
    U = all_swap_lll(Y)
    assert exactly_lll_reduced(U, Y)
    assert not exactly_lll_reduced(np.eye(n, dtype=int), Y)
    assert abs(int(flint.fmpz_mat(U.tolist()).det())) == 1
    assert np.array_equal(lll_basis(Y), U)
    assert is_lll_reduced(U @ Y @ U.T, 1e-9)
    assert not is_lll_reduced(Y, 1e-9)


def test_forms_too_far_from_round_are_reduced_in_integers():
    # A basis of the lattice of (x, 10^9 x_1 + …): it takes more digits than a double has.
    rng = np.random.default_rng(0)
    n = 40
    row = rng.integers(10**5, 10**6, n).astype(float)
    Y = np.eye(n) + np.outer(row, row)
    assert all_swap_lll(Y) is None
    U = lll_basis(Y)
    assert exactly_lll_reduced(U, Y)
