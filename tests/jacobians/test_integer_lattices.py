"""Lattices of integer vectors and matrices."""

from itertools import pairwise

import flint
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from igl_periods.jacobians import MatrixLattice, frobenius_basis, saturated_lattice
from igl_periods.jacobians.integer_lattices import kernel, saturated


def test_a_saturated_lattice_has_no_divisible_vectors():
    rows = flint.fmpz_mat([[2, 4, 6, 0], [0, 3, 3, 9], [2, 7, 9, 9]])
    basis = saturated(rows)
    assert (basis.nrows(), basis.rank()) == (2, 2)
    # The elementary divisors of a basis of a saturated lattice are 1.
    assert [int(basis.snf()[k, k]) for k in range(2)] == [1, 1]
    both = flint.fmpz_mat(rows.tolist() + basis.tolist())
    assert both.rank() == 2


@settings(max_examples=40, deadline=None)
@given(st.lists(st.lists(st.integers(-9, 9), min_size=6, max_size=6), min_size=1, max_size=4))
def test_kernels_are_saturated_and_complementary(rows):
    M = flint.fmpz_mat(rows)
    K = kernel(M)
    assert K.nrows() == 6 - M.rank()
    if K.nrows():
        assert all(x == 0 for x in (M * K.transpose()).entries())
        divisors = K.snf()
        assert all(divisors[k, k] == 1 for k in range(K.nrows()))


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(-12, 12), min_size=15, max_size=15))
def test_frobenius_bases(numbers):
    S = np.zeros((6, 6), dtype=np.int64)
    S[np.triu_indices(6, 1)] = numbers
    S -= S.T
    if int(flint.fmpz_mat(S.tolist()).det()) == 0:
        with pytest.raises(ValueError, match="degenerate"):
            frobenius_basis(S)
        return
    U, divisors = frobenius_basis(S)
    D = np.diag(divisors)
    zero = np.zeros((3, 3), dtype=np.int64)
    assert np.array_equal(U.T @ S @ U, np.block([[zero, D], [-D, zero]]))
    assert abs(int(flint.fmpz_mat(U.tolist()).det())) == 1
    assert all(d > 0 for d in divisors)
    assert all(e % d == 0 for d, e in pairwise(divisors))


def test_coordinates():
    rng = np.random.default_rng(0)
    lattice = MatrixLattice(rng.integers(-5, 6, (4, 3, 3)))
    assert repr(lattice) == "MatrixLattice(rank 4, 3 × 3 matrices)"
    c = [3, -1, 0, 7]
    M = np.tensordot(c, lattice.basis, axes=1)
    assert lattice.coordinates(M) == c
    assert lattice.contains(M)
    assert lattice.coordinates(M + np.eye(3, dtype=np.int64)) is None
    doubled = MatrixLattice(2 * lattice.basis)
    assert [2 * x for x in doubled.coordinates(M)] == c
    assert not doubled.contains(M)
    assert saturated_lattice(doubled.basis).contains(M)


def test_sublattices_by_linear_conditions():
    basis = np.zeros((4, 2, 2), dtype=np.int64)
    basis[range(4), [0, 0, 1, 1], [0, 1, 0, 1]] = 1
    symmetric = MatrixLattice(basis).where([M - M.T for M in basis])
    assert symmetric.rank == 3
    assert all(np.array_equal(M, M.T) for M in symmetric.basis)
