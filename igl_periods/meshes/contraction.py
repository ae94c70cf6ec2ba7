"""Edges without length, contracted to points.

Such an edge is a point of the flat surface already; its two triangles have no area.  Contraction
removes them and changes no distance.  It keeps the topology if the ends have no common neighbours
but the corners opposite the edge (the link condition); other edges are left.  A boundary loop
without length, as programs leave at poles, is closed by making it one vertex.

References
----------
Dey, Edelsbrunner, Guha, Nekhayev, "Topology preserving edge contraction" (1999).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.complexes import components_of, corner_vertices, next_corner

from .facts import collapsed, glued_in_pairs


def contracted(V: Floats, F: Ints) -> tuple[Ints, int]:
    """Contract the edges without length of a surface with or without boundary.

    Returns
    -------
    F : (m', 3) int
        The triangles that are left; the vertices keep their numbers.
    n : int
        By how many the vertices have become fewer.
    """
    total = 0
    F, closed = _without_empty_loops(V, F)
    while True:
        one, other = _contractible(V, F)
        if one.size == 0:
            return F, total + closed
        name = np.arange(len(V))
        name[other] = one
        F = name[F]
        F = F[~collapsed(F)]
        total += one.size


def _without_length(V: Floats, one: Ints, other: Ints) -> Bools:
    return np.asarray((V[one] == V[other]).all(axis=1) & (one != other))


def _contractible(V: Floats, F: Ints) -> tuple[Ints, Ints]:
    """Edges without length that can be contracted at the same time."""
    twin, _, _ = glued_in_pairs(F)
    tail, head = np.roll(F, -1, 1).ravel(), np.roll(F, 1, 1).ravel()
    once = twin.ravel() < np.arange(F.size)
    empty = _without_length(V, tail, head)
    # A surface that is a single point is not a surface, and stays as it is.
    chosen = np.flatnonzero(once & empty)
    if chosen.size == 0 or empty.all():
        return chosen[:0], chosen[:0]
    u, v = tail[chosen], head[chosen]
    n = len(V)
    pairs = csr_array((np.ones(2 * F.size), (np.r_[tail, head], np.r_[head, tail])), shape=(n, n))
    neighbours = pairs.astype(bool).astype(np.int32).tocsr()
    common = np.asarray(neighbours[u].multiply(neighbours[v]).sum(axis=1)).ravel()
    faces = np.bincount(F.ravel(), minlength=n)
    inside = twin.ravel()[chosen] >= 0
    rim = np.zeros(n, dtype=bool)
    free = np.flatnonzero(twin.ravel() < 0)
    rim[tail[free]] = rim[head[free]] = True
    allowed = (
        (common == 1 + inside)
        & ~(inside & rim[u] & rim[v])
        # Nothing would be left of a tetrahedron or a triangle.
        & (faces[u] + faces[v] > np.where(inside, 6, 2))
    )
    blocked = np.zeros(n, dtype=bool)
    taken = []
    for i in np.flatnonzero(allowed):
        star = np.r_[_row(neighbours, u[i]), _row(neighbours, v[i])]
        if not blocked[star].any():
            blocked[star] = True
            taken.append(i)
    return u[taken], v[taken]


def _row(matrix: csr_array, i: int) -> Ints:
    return np.asarray(matrix.indices[matrix.indptr[i] : matrix.indptr[i + 1]])


def _without_empty_loops(V: Floats, F: Ints) -> tuple[Ints, int]:
    """Make every boundary loop without length one vertex, unless that pinches the surface."""
    twin, _, _ = glued_in_pairs(F)
    free = np.flatnonzero(twin.ravel() < 0)
    start, end = F.ravel()[next_corner(free)], F.ravel()[next_corner(free, 2)]
    _, label = components_of(start, end, len(V))
    long = label[start[~_without_length(V, start, end)]]
    empty = ~np.isin(label[start], long)
    name = np.arange(len(V))
    least = np.full(len(V), len(V))
    np.minimum.at(least, label[start[empty]], start[empty])
    name[start[empty]] = least[label[start[empty]]]
    G = name[F]
    G = G[~collapsed(G)]
    if not empty.any() or len(G) == 0:
        return F, 0
    twin, same, faces_at = glued_in_pairs(G)
    _, n_fans = corner_vertices(twin, same)
    if faces_at.max() > 2 or n_fans > np.unique(G).size:
        return F, 0
    return G, int(np.count_nonzero(name != np.arange(len(V))))
