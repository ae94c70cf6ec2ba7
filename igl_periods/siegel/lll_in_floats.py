r"""LLL reduction in floating point, with all exchanges of a sweep at once.

The LLL algorithm reduces coefficients, :math:`|\mu_{ij}| \le \eta`, and exchanges neighbours whose
heights violate the condition of Lovász, :math:`h_i \ge (\delta - \mu_{i,i-1}^2)\, h_{i-1}`.  The
condition at i involves the coefficient μ_{i,i−1} only, and exchanges at i = 1, 3, 5, … do not
concern each other, nor do those at 2, 4, 6, …: so all of one parity are done together.  Each
exchange divides the potential :math:`\prod_i h_i^{n-i}` by 1/δ at least, and it cannot fall for
ever; so the sweeps end.  All coefficients are reduced before and after.

The lower triangular factor R of Y = R Rᵀ holds both, :math:`\mu_{ij} = R_{ij} / R_{jj}` and
:math:`h_i = R_{ii}^2`.  Exchanging two rows of R leaves one entry above the diagonal, which a
rotation of two columns removes.  A sweep is O(n²); reducing all coefficients is O(n³) and seldom
needed.  The transformation is integer, hence exact; R is computed anew from it until nothing
changes, so the result is reduced by the definition, not by the course of the computation.

References
----------
Villard, "Parallel lattice basis reduction" (1992).
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.run_log import progress

# Coefficients up to this are left alone, and exchanges gain at least this factor: a little inside
# what is promised, so that rounding in the next factorisation does not undo it.
_LARGEST_COEFFICIENT = 0.505
_LARGEST_RATIO = 0.991
_MOST_PASSES = 20
# Sweeps of one pass per row; there are about one.
_MOST_SWEEPS = 50
# Exchanges of a sweep are made in so many parts: those further down concern fewer rows.
_PARTS = 4
_LARGE = 2.0**40


def all_swap_lll(Y: Floats) -> Ints | None:
    """An LLL-reduced basis of a form that is not far from round: integer U with U Y Uᵀ reduced.

    With δ = 0.99 and η = 0.51.  O(n³) operations in a few passes.

    Parameters
    ----------
    Y : (n, n) float
        Symmetric, positive definite.

    Returns
    -------
    (n, n) int or None
        None if double precision does not suffice.
    """
    U = np.eye(len(Y))
    for _ in range(_MOST_PASSES):
        try:
            R = np.asarray(np.linalg.cholesky(U @ Y @ U.T), dtype=np.float64)
        except np.linalg.LinAlgError:
            return None
        changed = _reduce_coefficients(R, U)
        if not _exchange(R, U) and not changed:
            return U.astype(np.int64)
        if np.abs(U).max() > _LARGE:
            return None
    return None


def _reduce_coefficients(R: Floats, U: Floats) -> bool:
    """Subtract multiples of earlier rows until all |μ_ij| ≤ η; in place.  Whether any was not."""
    changed = False
    for j in range(len(R) - 2, -1, -1):
        mu = R[j + 1 :, j] / R[j, j]
        (large,) = np.nonzero(np.abs(mu) > _LARGEST_COEFFICIENT)
        if large.size:
            changed = True
            multiple, rows = np.rint(mu[large])[:, None], large + j + 1
            R[rows, : j + 1] -= multiple * R[j, : j + 1]
            U[rows] -= multiple * U[j]
    return changed


def _exchange(R: Floats, U: Floats) -> bool:
    """Exchange neighbours until the condition of Lovász holds; in place.  Whether any were."""
    n, total, idle = len(R), 0, 0
    for sweep in range(_MOST_SWEEPS * n):
        if idle == 2:
            break
        i = np.arange(1 + sweep % 2, n, 2)
        _reduce_neighbours(R, U, i)
        before, mixed, after = R[i - 1, i - 1], R[i, i - 1], R[i, i]
        i = i[mixed * mixed + after * after < _LARGEST_RATIO * before * before]
        idle = 0 if i.size else idle + 1
        for part in np.array_split(i, _PARTS):
            _exchange_rows(R, U, part)
        if i.size:
            total += len(i)
            progress("exchanges in the lattice", total)
    return total > 0


def _reduce_neighbours(R: Floats, U: Floats, i: Ints) -> None:
    """Make |μ_{i,i−1}| ≤ η; in place."""
    mu = R[i, i - 1] / R[i - 1, i - 1]
    large = np.abs(mu) > _LARGEST_COEFFICIENT
    i, multiple = i[large], np.rint(mu[large])[:, None]
    R[i] -= multiple * R[i - 1]
    U[i] -= multiple * U[i - 1]


def _exchange_rows(R: Floats, U: Floats, i: Ints) -> None:
    """Exchange the rows i − 1 and i, no two of them the same, and make R lower triangular again."""
    if i.size == 0:
        return
    for M in (R, U):
        M[i - 1], M[i] = M[i], M[i - 1]
    height = np.hypot(R[i - 1, i - 1], R[i - 1, i])
    cos, sin = R[i - 1, i - 1] / height, R[i - 1, i] / height
    # Rows further up are 0 there.
    below = R[i[0] - 1 :]
    left, right = below[:, i - 1], below[:, i]
    # A reflection, so that R_ii, negative after a rotation, stays positive.
    below[:, i - 1], below[:, i] = cos * left + sin * right, sin * left - cos * right
    R[i - 1, i] = 0.0
