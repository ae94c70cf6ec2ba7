"""LLL-reduced bases, by the definition."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.lattice_reduction import assert_lll_reduced

from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.siegel.enumeration import short_vectors
from igl_periods.siegel.lll import is_lll_reduced, lll_basis, shortest_first
from igl_periods.siegel.reduction import siegel_reduce

# --- high genus --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("Y", "reduced"),
    [
        ([[1.0, 0.5], [0.5, 1.2]], True),
        ([[1.0, 0.52], [0.52, 1.5]], False),
        ([[1.0, 0.1], [0.1, 0.9]], False),
        ([[1.0]], True),
    ],
)
def test_definition_of_reduced_bases(Y, reduced):
    assert is_lll_reduced(np.array(Y), 1e-6) is reduced


# --- lattices ----------------------------------------------------------------------------------


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 7), st.integers(0, 2**32 - 1))
def test_lattice_bases(n, seed):
    rng = np.random.default_rng(seed)
    A = rng.integers(-30, 31, (n, n)) + 0.3 * rng.standard_normal((n, n)) + 0.01 * np.eye(n)
    Y = A @ A.T
    for basis in (lll_basis, shortest_first):
        U = basis(Y)
        assert abs(round(np.linalg.det(U))) == 1
        assert_lll_reduced(U @ Y @ U.T)
    shortest = (U @ Y @ U.T)[0, 0]
    assert short_vectors(U @ Y @ U.T, shortest * (1 - 1e-5))[0].any(axis=1).sum() == 0


@pytest.mark.parametrize("Y", [[[1, 3e9], [3e9, 1e61]], [[1, 1e15], [1e15, 1.000000001e30]]])
def test_lattices_far_from_round(Y):
    # Beyond any condition number that eigenvalues could tell from 0.
    U = lll_basis(np.array(Y))
    assert U.tolist() == [[1, 0], [-round(Y[0][1]), 1]]
    matrix, gamma = siegel_reduce(1j * np.array(Y))
    assert gamma[:2, :2].tolist() == U.tolist()
    assert matrix[0, 0] == 1j


@pytest.mark.parametrize(
    ("Y", "message"),
    [
        ([[1, 1 - 1e-15], [1 - 1e-15, 1]], "singular up to rounding"),
        ([[1, 1], [1, 1]], "singular up to rounding"),
        ([[1, 1e25], [1e25, 1e61]], "does not fit into 64-bit integers"),
        ([[1e-200, 0], [0, 1e200]], "does not fit into 64-bit integers"),
    ],
)
def test_lattices_that_are_none(Y, message):
    # In FLINT a form that is not positive definite would end the process.
    with pytest.raises(NotPositiveDefiniteError, match=message):
        lll_basis(np.array(Y))
