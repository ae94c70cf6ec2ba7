r"""Where a triangle mesh in space passes through itself.

Two triangles without a common vertex meet iff a side of one passes through the other, or they
touch.  The segment from p to q passes through the triangle a b c iff p and q lie on different sides
of its plane, and the tetrahedra p q a b, p q b c and p q c a have the same orientation.  The test
is made in floating point, without care for contacts: it is for surfaces that move, where a contact
is crossed at the next step.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from igl_periods.arrays import Bools, Floats, Ints

_PAIRS_AT_ONCE = 500_000


def passes_through_itself(V: Floats, F: Ints) -> bool:
    """Whether a side of some face passes through another face that shares no vertex with it.

    Parameters
    ----------
    V, F : (n, 3) float, (m, 3) int
    """
    corners = V[F]
    return any(
        _sides_meet(corners[i], corners[j]) or _sides_meet(corners[j], corners[i])
        for i, j in near_pairs(V, F, 0.0)
    )


def near_pairs(V: Floats, F: Ints, reach: float) -> Iterator[tuple[Ints, Ints]]:
    """Pairs of faces without a common vertex whose boxes are within ``reach``, in portions."""
    from scipy.spatial import cKDTree  # slow to import

    corners = V[F]
    centres = corners.mean(axis=1)
    radius = float(np.linalg.norm(corners - centres[:, None], axis=2).max())
    pairs = cKDTree(centres).query_pairs(2.0 * radius + reach, output_type="ndarray")
    low, high = corners.min(axis=1) - 0.5 * reach, corners.max(axis=1) + 0.5 * reach
    for start in range(0, len(pairs), _PAIRS_AT_ONCE):
        i, j = pairs[start : start + _PAIRS_AT_ONCE].T
        near = ((low[i] <= high[j]) & (high[i] >= low[j])).all(axis=1)
        i, j = i[near], j[near]
        apart = (F[i][:, :, None] != F[j][:, None, :]).all(axis=(1, 2))
        yield i[apart], j[apart]


def _sides_meet(one: Floats, other: Floats) -> bool:
    """Whether a side of some triangle of the first (k, 3, 3) passes through its partner."""
    return any(bool(_passes(one[:, s], one[:, (s + 1) % 3], other).any()) for s in range(3))


def _passes(p: Floats, q: Floats, triangles: Floats) -> Bools:
    a, b, c = triangles.transpose(1, 0, 2)
    apart = _side(a, b, c, p) * _side(a, b, c, q) < 0
    turns = [_side(p, q, *ends) for ends in ((a, b), (b, c), (c, a))]
    return np.asarray(apart & (turns[0] == turns[1]) & (turns[1] == turns[2]))


def _side(p: Floats, q: Floats, r: Floats, s: Floats) -> Floats:
    """The orientation of tetrahedra, −1, 0 or 1."""
    return np.asarray(np.sign(np.einsum("ki,ki->k", np.cross(q - p, r - p), s - p)))
