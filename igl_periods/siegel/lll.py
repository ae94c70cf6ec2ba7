r"""Lattice reduction and short vectors of positive definite quadratic forms.

A real positive definite matrix Y is a quadratic form on Z^n, or a lattice with a basis.  An
integer matrix U of determinant ±1 changes the basis, Y → U Y Uᵀ.

A basis is *LLL-reduced* if, for its Gram–Schmidt coefficients μ and heights h,

.. math:: |\mu_{ij}| \le \eta, \qquad h_i \ge (\delta - \mu_{i,i-1}^2)\, h_{i-1},

here with δ = 0.99 and η = 0.51.  Its first vector is short, but the shortest vector is found by
enumeration only: completing squares,

.. math:: x^T Y x = \sum_i q_i \Big( x_i + \sum_{j>i} q_{ij} x_j \Big)^2 ,

bounds x_n, then x_{n−1} given x_n, and so on.  Everything is done here on all partial vectors of
a level at once.

References
----------
Lenstra, Lenstra, Lovász, "Factoring polynomials with rational coefficients" (1982).
Fincke, Pohst, "Improved methods for calculating vectors of short length in a lattice" (1985).
"""

from __future__ import annotations

import flint
import numpy as np
from scipy.linalg import solve_triangular

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.symplectic import int_array, unimodular_inverse

from .enumeration import short_vectors
from .lll_in_floats import all_swap_lll

# What LLL-reduced means.
_DELTA, _ETA = 0.99, 0.51
# Bits kept of the smallest eigenvalue when a form is rounded to integers.
_BITS = 40
# From this size on a form is reduced in floating point, if it is not too far from round.
_ALL_SWAP_SIZE = 40
# Of a form scaled to a unit diagonal, times its size: beyond it rounding decides about signs.
_LARGEST_CONDITION = 1e15


def lll_basis(Y: Floats) -> Ints:
    """An LLL-reduced basis: integer U, det U = ±1, such that ``U Y Uᵀ`` is LLL-reduced.

    Parameters
    ----------
    Y : (n, n) float
        Symmetric, positive definite.  It is rounded to integers relative to its smallest
        eigenvalue, so that the form may be as far from round as floating point allows.  Large
        forms are reduced in floating point where that suffices
        (:mod:`igl_periods.siegel.lll_in_floats`).

    Raises
    ------
    NotPositiveDefiniteError
        If Y is singular up to rounding, or U does not fit into 64-bit integers.
    """
    n = len(Y)
    if n < 2:
        return np.eye(n, dtype=np.int64)
    if n >= _ALL_SWAP_SIZE and (U := all_swap_lll(Y)) is not None:
        return U
    exponent = _BITS - int(np.floor(np.log2(_least_eigenvalue(Y))))
    try:
        with np.errstate(over="ignore"):
            scaled = np.ldexp(Y, exponent)
        rows = np.rint(0.5 * (scaled + scaled.T))
        form = flint.fmpz_mat([[int(v) for v in row] for row in rows])
        _, transformation = form.lll(True, _DELTA, _ETA, "gram")
        return int_array(transformation)
    except OverflowError as error:
        raise NotPositiveDefiniteError(
            "too far from round: its reduced basis does not fit into 64-bit integers"
        ) from error


def is_lll_reduced(Y: Floats, tolerance: float) -> bool:
    """Whether the basis of a positive definite form is LLL-reduced, up to a tolerance."""
    if len(Y) < 2:
        return True
    R = np.linalg.cholesky(Y)
    height, mu = np.diagonal(R) ** 2, R / np.diagonal(R)
    neighbour = np.diagonal(mu, -1)
    return bool(
        np.abs(np.tril(mu, -1)).max() <= _ETA + tolerance
        and np.all(height[1:] >= (_DELTA - tolerance - neighbour**2) * height[:-1])
    )


def _least_eigenvalue(Y: Floats) -> float:
    """The smallest eigenvalue, from below and within a factor n, however far the rows differ.

    FLINT ends the process where a form is not positive definite, so what rounding could make
    indefinite is refused: 1/κ ≤ nε, κ the trace of the inverse of Y scaled to a unit diagonal.
    """
    try:
        inverse = solve_triangular(np.linalg.cholesky(Y), np.eye(len(Y)), lower=True)
    except np.linalg.LinAlgError:
        inverse = np.full(Y.shape, np.inf)
    condition = float(np.sum((inverse * np.sqrt(np.diag(Y))) ** 2))
    if not len(Y) * condition < _LARGEST_CONDITION:
        raise NotPositiveDefiniteError(
            f"singular up to rounding (condition {condition:.3g} with rows scaled)"
        )
    return 1.0 / float(np.sum(inverse**2))


def shortest_first(Y: Floats) -> Ints:
    """An LLL-reduced basis whose first vector is a shortest one (to 1e-6); as :func:`lll_basis`.

    A shortest vector is primitive.  It is completed to a basis by a Hermite normal form, and the
    Lovász condition never exchanges it afterwards.
    """
    U = lll_basis(Y)
    if len(Y) < 2:
        return U
    reduced = U @ Y @ U.T
    vectors, values = short_vectors(reduced, float(reduced[0, 0]) * (1 - 1e-6))
    if len(values) < 2:
        return U
    U = _completed(vectors[1]) @ U
    return lll_basis(U @ Y @ U.T) @ U


def _completed(x: Ints) -> Ints:
    """A unimodular matrix with the primitive vector x as first row."""
    n = len(x)
    # In the Hermite normal form (e_1 | W) of (x | 1) the right part has W x = e_1.
    table = flint.fmpz_mat(np.column_stack([x, np.eye(n, dtype=np.int64)]).tolist()).hnf()
    W = int_array(table)[:, 1:]
    return unimodular_inverse(W).T
