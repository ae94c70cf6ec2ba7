"""Boundary edges that lie in pairs at the same place: where a file has torn a surface apart.

Programs that write every face with vertices of its own compute a vertex several times, and its
coordinates may differ in the last bits, or be 0 here and 1e-17 there.  Two boundary edges are a
*seam* if their ends lie together, to a tolerance, and no third one lies there.  Only the ends of
seams are ever welded, so that sheets that touch stay apart; nothing is welded that would make two
corners of a triangle one.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import components_of, next_corner

from .welding import first_equal_row

# How far apart vertices are that repair welds, in parts of the diagonal.
WELD = 1e-9
# By how many units in the last place copies of a position in single precision may differ.
_LAST_PLACES = 4
# Neighbours that are looked at: a vertex that is written more often has equal copies.
_NEIGHBOURS = 16


def diagonal(V: Floats, F: Ints) -> float:
    """The diagonal of the box around the vertices of the triangles."""
    used = V[np.unique(F)]
    extent = used.max(axis=0) / 2 - used.min(axis=0) / 2
    largest = float(extent.max())
    return 2.0 * largest * float(np.linalg.norm(extent / largest)) if largest > 0.0 else 0.0


def tolerance_of(V: Floats, F: Ints, weld: float) -> float:
    """How far apart vertices are welded: ``weld`` in parts of the diagonal, or what rounding does.

    Positions in single precision are known to some units in the last place of the largest, however
    small ``weld`` is; but 0 is 0.
    """
    if weld == 0.0:
        return 0.0
    used = V[np.unique(F)]
    with np.errstate(over="ignore"):
        single = used.astype(np.float32)
    rounding = 0.0
    if (single == used).all():
        rounding = _LAST_PLACES * float(np.spacing(np.abs(single).max()))
    return max(weld * diagonal(V, F), rounding)


def seam_sides(V: Floats, F: Ints, free: Ints, tolerance: float) -> tuple[Ints, Ints, Ints]:
    """Pairs of free sides at the same place.

    Parameters
    ----------
    V, F : (n, d) float, (m, 3) int
    free : (k,) int
        Half-edges with nothing glued to them.
    tolerance : float
        How far apart ends may be.

    Returns
    -------
    one, other : (p,) int
        The half-edges of each pair.
    place : (n,) int
        The same number for vertices that lie together.
    """
    start, end = F.ravel()[next_corner(free)], F.ravel()[next_corner(free, 2)]
    place = _places(V, np.unique(np.concatenate([start, end])), tolerance)
    ends = np.sort(np.column_stack([place[start], place[end]]), axis=1)
    _, edge, count = np.unique(first_equal_row(ends), return_inverse=True, return_counts=True)
    paired = np.flatnonzero((count == 2)[edge] & (ends[:, 0] != ends[:, 1]))
    one, other = paired[np.argsort(edge[paired], kind="stable")].reshape(-1, 2).T
    return free[one], free[other], place


def stitched(V: Floats, F: Ints, free: Ints, tolerance: float) -> tuple[Ints, int, float]:
    """Weld the ends of seams.

    Returns
    -------
    F : (m, 3) int
    welded : int
        By how many the vertices have become fewer.
    distance : float
        How far apart vertices were that became one.
    """
    one, other, place = seam_sides(V, F, free, tolerance)
    corners = F.ravel()
    ends = [corners[next_corner(h, k)] for h in (one, other) for k in (1, 2)]
    same_way = place[ends[0]] == place[ends[2]]
    first, last = np.where(same_way, ends[2:], ends[3:1:-1])
    u, v = np.stack([ends[0], ends[1]]), np.stack([first, last])
    collapsed = (F == np.roll(F, 1, axis=1)).any(axis=1)
    while True:
        _, label = components_of(u.ravel(), v.ravel(), len(V))
        G = label[F]
        bad = (G == np.roll(G, 1, axis=1)) & ~collapsed[:, None]
        # At exactly the same place they are one point of the surface all the same.
        if tolerance == 0.0 or not bad.any():
            break
        keep = ~np.isin(label[u], G[bad]).any(axis=0)
        u, v = u[:, keep], v[:, keep]
    _, least, inverse = np.unique(label, return_index=True, return_inverse=True)
    kept = least[inverse]
    gap = V[kept] - V
    distance = float(np.linalg.norm(gap[kept != np.arange(len(V))], axis=1).max(initial=0.0))
    return kept[F], len(V) - least.size, distance


def _places(V: Floats, used: Ints, tolerance: float) -> Ints:
    """For each vertex a number, the same for those of ``used`` that lie together."""
    from scipy.spatial import cKDTree  # slow to import

    place = first_equal_row(V)
    if tolerance == 0.0 or used.size == 0:
        return place
    spots, which = np.unique(place[used], return_inverse=True)
    # Squares of the largest coordinates are not infinities so.
    scale = float(np.abs(V[spots]).max()) or 1.0
    near = min(_NEIGHBOURS, spots.size)
    distance, index = cKDTree(V[spots] / scale).query(V[spots] / scale, k=[*range(1, near + 1)])
    mine, rank = np.nonzero(distance <= tolerance / scale)
    _, label = components_of(mine, index[mine, rank], spots.size)
    first = np.unique(label, return_index=True)[1]
    place[used] = spots[first[label[which]]]
    return place
