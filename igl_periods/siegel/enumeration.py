r"""All short vectors of a lattice (Fincke, Pohst 1985).

Integer x with :math:`x^T Y x \le r`: with the Cholesky factor of Y the last coordinate is bounded,
then the one before it, and so on.  Y should be LLL-reduced; even so the number of partial vectors
grows exponentially with the size, and the search is given up at a stated limit, with an error.

References
----------
Fincke, Pohst, "Improved methods for calculating vectors of short length in a lattice" (1985).
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import EnumerationLimitError

# Partial vectors handled at one level before an enumeration counts as too large.
ENUMERATION_LIMIT = 500_000


def short_vectors(
    Y: Floats, bound: float, limit: int = ENUMERATION_LIMIT, shift: Floats | None = None
) -> tuple[Ints, Floats]:
    """All integer vectors x with ``xᵀ Y x ≤ bound``, 0 and both signs included.

    The bound is widened by 1e-9 of itself, so that rounding loses no vector.

    Parameters
    ----------
    Y : (n, n) float
        Symmetric, positive definite; reduced, or the enumeration is slow.
    bound : float
    limit : int
        Most partial vectors at a level.
    shift : (n,) float, optional
        Short are then the vectors x + shift.

    Returns
    -------
    vectors : (N, n) int
    values : (N,) float
        ``xᵀ Y x`` of each, or that of x + shift; increasing.

    Raises
    ------
    EnumerationLimitError
        If more than ``limit`` partial vectors occur.
    """
    n = len(Y)
    moved = np.zeros(n) if shift is None else shift
    R = np.linalg.cholesky(Y[::-1, ::-1])[::-1, ::-1].T  # lower triangular, Y = Rᵀ R
    vectors: Ints = np.zeros((1, n), dtype=np.int64)
    room: Floats = np.full(1, bound * (1 + 1e-9))
    for i in range(n):
        centre = -((vectors[:, :i] + moved[:i]) @ R[i, :i]) / R[i, i] - moved[i]
        radius = np.sqrt(room) / R[i, i]
        low, high = np.ceil(centre - radius), np.floor(centre + radius)
        count = np.maximum(high - low + 1, 0).astype(np.int64)
        if count.sum() > limit:
            raise EnumerationLimitError(
                f"more than {limit} partial vectors at level {i + 1} of {n} in the enumeration of "
                f"vectors with square at most {bound:.6g}"
            )
        parent = np.repeat(np.arange(len(count)), count)
        step = np.arange(len(parent)) - np.repeat(np.cumsum(count) - count, count)
        vectors = vectors[parent]
        vectors[:, i] = low[parent].astype(np.int64) + step
        used = (R[i, i] * (vectors[:, i] - centre[parent])) ** 2
        room = np.maximum(room[parent] - used, 0.0)
    points = vectors + moved
    values = np.einsum("ni,ij,nj->n", points, Y, points, optimize=True)
    order = np.argsort(values, kind="stable")
    return vectors[order], values[order]
