"""Exact products and inverses of integer matrices.

Integers below 2⁵³ are exact in floating point, and so is a product of matrices as long as no sum
can be larger: then the fastest products there are serve for integers too.  Larger ones are left to
FLINT.
"""

from __future__ import annotations

import flint
import numpy as np

from igl_periods.arrays import Ints

# Integers below this are exact in floating point.
_EXACT = 2.0**53


def int_array(M: flint.fmpz_mat) -> Ints:
    """The entries as an int64 array; OverflowError if one does not fit."""
    entries = [int(v) for v in M.entries()]
    return np.array(entries, dtype=np.int64).reshape(M.nrows(), M.ncols())


def unimodular_inverse(U: Ints) -> Ints:
    """The exact inverse of an integer matrix of determinant ±1."""
    if len(U) == 0:
        return U.copy()
    guess = np.rint(np.linalg.inv(U))
    if np.isfinite(guess).all() and np.abs(guess).max() < _EXACT:
        inverse = guess.astype(np.int64)
        if _is_identity_product(inverse, U):
            return inverse
    matrix = flint.fmpz_mat(U.tolist())
    # The integer inverse of python-flint may lack the sign of the determinant.
    exact = matrix.inv(True)
    identity = flint.fmpz_mat(np.eye(len(U), dtype=np.int64).tolist())
    return int_array(exact if exact * matrix == identity else -exact)


def _is_identity_product(A: Ints, B: Ints) -> bool:
    try:
        return np.array_equal(product(A, B), np.eye(len(A)))
    except OverflowError:
        return False


def product(A: Ints, B: Ints) -> Ints:
    """The exact product of integer matrices; OverflowError where it does not fit into 64 bits."""
    if not A.size or not B.size:
        return A @ B
    left, right = A.astype(np.float64), B.astype(np.float64)
    # No partial sum can be larger, in whatever order they are added.
    if A.shape[1] * np.abs(left).max() * np.abs(right).max() < _EXACT:
        return np.asarray(left @ right).astype(np.int64)
    return int_array(flint.fmpz_mat(A.tolist()) * flint.fmpz_mat(B.tolist()))
