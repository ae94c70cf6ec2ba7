"""Cholesky factors of sparse matrices, by CHOLMOD.

The only room of the library that knows CHOLMOD.  The fastest ordering for Laplacians of meshes, and
for systems of traces on their edges, is minimum degree.  A matrix is factored once; right-hand
sides are solved for in groups, which is faster than one by one and takes less memory than all at
once.

Minimum degree has ties, on regular meshes nearly everywhere, and the last unknown of least degree
is eliminated first.  Meshes that were refined have their old vertices first, and it is better that
these go first as well: so CHOLMOD gets all unknowns in the opposite order.  Where every face was
divided into four, the factor takes a tenth to a quarter less; elsewhere as much as before.

References
----------
Chen, Davis, Hager, Rajamanickam, "Algorithm 887: CHOLMOD" (2008).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csc_matrix, csr_matrix
from sksparse.cholmod import CholmodNotPositiveDefiniteError, Factor, analyze

from igl_periods.arrays import Floats
from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.machine import (
    one_thread,
    release_freed_memory,
    threads_for,
    without_lost_threads,
)
from igl_periods.run_log import progress

_SOLVES_AT_ONCE = 32

# From so many unknowns on, memory is put in order before it is filled.
_LARGE = 100_000


@dataclass(frozen=True, eq=False)
class CholeskyFactor:
    """L with A = L Lᵀ up to a permutation, unknowns reversed; None for a matrix without rows."""

    size: int
    _factor: Factor | None


def factor(lower: csc_matrix | csr_matrix) -> CholeskyFactor:
    """Factor a symmetric positive definite matrix, given by its lower triangle.

    By rows is better than by columns: those are converted.

    Raises
    ------
    NotPositiveDefiniteError
    """
    n = lower.shape[0]
    if n == 0:
        return CholeskyFactor(0, None)
    tidy = release_freed_memory if n > _LARGE else lambda: None
    reversed_lower = _reversed(csr_matrix(lower))
    tidy()
    # Supernodal is L Lᵀ, which fails on matrices that are not positive definite; the simplicial
    # L D Lᵀ would go on.
    with without_lost_threads(), threads_for(factor_operations(n)):
        symbolic = analyze(reversed_lower, mode="supernodal", ordering_method="amd")
        tidy()
        try:
            symbolic.cholesky_inplace(reversed_lower)
        except CholmodNotPositiveDefiniteError as error:
            raise NotPositiveDefiniteError("the matrix is not positive definite.") from error
    return CholeskyFactor(n, symbolic)


def factor_operations(n: int) -> float:
    """About how many operations it takes to factor a Laplacian of n unknowns on a surface.

    Dissection takes O(n^{3/2}); the factor is what was counted on surfaces of 10⁵ and more.
    """
    return float(30.0 * n**1.5)


def _reversed(lower: csr_matrix) -> csc_matrix:
    """The lower triangle of the matrix with its rows and columns in the opposite order.

    What has been by rows is by columns then, so that nothing but the order in memory changes.
    """
    n = lower.shape[0]
    start = lower.indptr[-1] - lower.indptr[::-1]
    return csc_matrix((lower.data[::-1], n - 1 - lower.indices[::-1], start), shape=(n, n))


def solve(factor: CholeskyFactor, load: Floats | csc_array, out: Floats | None = None) -> Floats:
    """The solution of A x = ``load`` for each of its columns; (n, k), into ``out`` if given."""
    solution = np.empty(load.shape) if out is None else out
    for columns, _, part in solved_panels(factor, load):
        solution[:, columns] = part
    return solution


def solved_panels(
    factor: CholeskyFactor, load: Floats | csc_array, first: int = 0
) -> Iterator[tuple[slice, Floats, Floats]]:
    """Some columns at a time: which, ``load`` there, and the solution of A x = ``load[first:]``.

    Yields
    ------
    columns : slice
    part : (n + first, j) float
        ``load[:, columns]``, dense.
    solution : (n, j) float
    """
    k = load.shape[1]
    for start in range(0, k, _SOLVES_AT_ONCE):
        progress("equations", start, k)
        columns = slice(start, min(start + _SOLVES_AT_ONCE, k))
        part = load[:, columns]
        dense = part if isinstance(part, np.ndarray) else part.toarray(order="F")
        yield columns, dense, _solution(factor, dense[first:])


def _solution(factor: CholeskyFactor, load: Floats) -> Floats:
    if factor._factor is None:
        return np.empty(load.shape)
    # Columns of the factor are solved for in groups of some dozens, too few to be divided.
    with without_lost_threads(), one_thread():
        return np.asarray(factor._factor(load[::-1]))[::-1]
