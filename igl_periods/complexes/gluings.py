"""Gluings of triangles: from faces, from squares, and the vertices and edges that they make.

A gluing is an array ``twin`` of shape (m, 3): ``twin[f, s] = 3 f' + s'`` glues side ``s`` of
face ``f`` to side ``s'`` of face ``f'``, and -1 leaves it free.  A second array ``same`` of the
same shape says which sides are glued running the *same* way, so that orientations disagree
there; on an oriented surface it is all False.

Side ``s`` runs from corner ``s + 1`` to corner ``s + 2`` (mod 3).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from igl_periods.arrays import Bools, Ints
from igl_periods.errors import ComplexError, MeshError

from .checked_arrays import checked_array

# More triangles than this do not fit into the memory of common computers.
MOST_TRIANGLES = 10**8


def twins_of_faces(faces: Ints, labels: Ints) -> tuple[Ints, Bools]:
    """Glue the faces of a simplicial complex where they share two corners.

    Parameters
    ----------
    faces : (m, 3) int
        Corners, numbered without gaps.
    labels : (n,) int
        What the corners are called in messages.

    Returns
    -------
    twin, same : (m, 3) int, (m, 3) bool

    Raises
    ------
    MeshError
        If an edge has more than two faces.
    """
    tail, head = ends_of_sides(faces, index_type(2 * faces.size))
    # Half-edges by their lower ends, and there by their higher ones; with each, which way it runs.
    tagged = np.arange(0, 2 * tail.size, 2, dtype=tail.dtype)
    tagged += tail > head
    by_low = sorted_by_rows(tagged, np.minimum(tail, head), np.maximum(tail, head), labels.size)
    high, order, upward = by_low.indices, by_low.data >> 1, (by_low.data & 1).astype(bool)
    paired = high[1:] == high[:-1]
    ends_of_rows = by_low.indptr[1:-1]
    paired[ends_of_rows[(ends_of_rows > 0) & (ends_of_rows < high.size)] - 1] = False
    if np.any(paired[1:] & paired[:-1]):
        low = np.repeat(np.arange(labels.size), np.diff(by_low.indptr))
        _raise_crowded_edge(low * labels.size + high, order, labels[tail], labels[head])
    if not (paired[0::2].all() and not paired[1::2].any()):
        first = np.flatnonzero(paired)
        glued = np.stack([first, first + 1], axis=1).ravel()
        order, upward = order[glued], upward[glued]
    one, other = order[0::2], order[1::2]
    twin = np.full(tail.size, -1, dtype=np.int64)
    twin[one], twin[other] = other, one
    same = np.zeros(tail.size, dtype=bool)
    alike = upward[0::2] == upward[1::2]
    if alike.any():
        same[one[alike]] = same[other[alike]] = True
    return twin.reshape(-1, 3), same.reshape(-1, 3)


def ends_of_sides(
    faces: Ints, index: type[np.signedinteger[Any]]
) -> tuple[NDArray[Any], NDArray[Any]]:
    """Corners at which the sides of (m, 3) faces start and end, two arrays of shape (3 m,)."""
    tail, head = np.empty(faces.shape, dtype=index), np.empty(faces.shape, dtype=index)
    for s in range(3):
        tail[:, s], head[:, s] = faces[:, s - 2], faces[:, s - 1]
    return tail.ravel(), head.ravel()


def index_type(largest: int) -> type[np.signedinteger[Any]]:
    """The type of indices up to ``largest``: 32 bits, where they do, halve the memory traffic."""
    return np.int32 if largest < np.iinfo(np.int32).max else np.int64


def sorted_by_rows(
    values: NDArray[Any], rows: NDArray[Any], columns: NDArray[Any], n: int
) -> csr_array:
    """Values sorted by row, and there by column, entries of one place side by side."""
    entries = coo_array((values, (rows, columns)), shape=(n, n))
    # Or they would be added up.
    entries.has_canonical_format = True
    by_rows = entries.tocsr()
    by_rows.has_sorted_indices = False
    by_rows.sort_indices()
    return by_rows


def _raise_crowded_edge(key: Ints, order: Ints, tail: Ints, head: Ints) -> None:
    _, first, count = np.unique(key, return_index=True, return_counts=True)
    bad = np.flatnonzero(count > 2)
    half_edge = order[first[bad[0]]]
    raise MeshError(
        f"{bad.size} edges border more than two faces; the first, from vertex {tail[half_edge]} to "
        f"{head[half_edge]}, borders {count[bad[0]]}. A surface has at most two faces at an edge: "
        "look for duplicate faces, internal walls or sheets that touch, and split them there "
        "(load_mesh(…, repair=True), --repair)."
    )


def checked_twin(twin: ArrayLike) -> Ints:
    """``twin`` as an (m, 3) integer array, an involution without fixed points (or -1).

    Raises
    ------
    ComplexError
    """
    glued = checked_array(twin, "twin", ComplexError)
    if glued.ndim != 2 or glued.shape[1] != 3 or glued.shape[0] == 0:
        raise ComplexError(f"twin must have shape (m, 3) with m >= 1, not {glued.shape}.")
    if not np.issubdtype(glued.dtype, np.integer):
        raise ComplexError(f"twin must be integer (half-edges 3 f + s), not {glued.dtype}.")
    low, high = int(glued.min()), int(glued.max())
    if low < -1 or high >= glued.size:
        raise ComplexError(
            f"twin has entries from {low} to {high}; with {len(glued)} faces the half-edges are "
            f"0 … {glued.size - 1}, and -1 is a free side."
        )
    glued = glued.astype(np.int64)
    flat = glued.ravel()
    half_edge = np.flatnonzero(flat >= 0)
    wrong = half_edge[(flat[flat[half_edge]] != half_edge) | (flat[half_edge] == half_edge)]
    if wrong.size:
        h = int(wrong[0])
        raise ComplexError(
            f"twin is not an involution without fixed points: half-edge {h} is glued to {flat[h]}, "
            f"and {flat[h]} to {flat[flat[h]]} ({wrong.size} such half-edges). Each side is glued "
            "to one other side, and back."
        )
    return glued


def checked_same(same: ArrayLike, twin: Ints) -> Bools:
    """``same`` as an (m, 3) boolean array, equal on glued sides and False on free ones.

    Raises
    ------
    ComplexError
    """
    alike = checked_array(same, "same", ComplexError)
    if alike.shape != twin.shape or alike.dtype != np.bool_:
        raise ComplexError(
            f"same must be a boolean array of the shape of twin, {twin.shape}, not {alike.shape} "
            f"of {alike.dtype}."
        )
    wrong = np.flatnonzero(np.where(twin >= 0, alike != alike.ravel()[twin], alike))
    if wrong.size:
        raise ComplexError(
            f"same differs on the two halves of an edge, or is True on a free side: half-edge "
            f"{wrong[0]} ({wrong.size} such half-edges)."
        )
    return alike


def corner_vertices(twin: Ints, same: Bools) -> tuple[Ints, int]:
    """The vertex at each corner: the classes of corners that the gluing identifies.

    Returns
    -------
    corner_vertex : (m, 3) int
        Numbered by first appearance.
    n_vertices : int
    """
    half_edge = np.flatnonzero(twin.ravel() >= 0)
    other = twin.ravel()[half_edge]
    start, end = next_corner(half_edge), next_corner(half_edge, 2)
    other_start, other_end = next_corner(other), next_corner(other, 2)
    crossed = same.ravel()[half_edge]
    one: Ints = np.concatenate([start, end])
    two: Ints = np.concatenate(
        [np.where(crossed, other_start, other_end), np.where(crossed, other_end, other_start)]
    )
    n, label = components_of(one, two, twin.size)
    _, first = np.unique(label, return_index=True)
    rank = np.empty(n, dtype=np.int64)
    rank[np.argsort(first)] = np.arange(n)
    return rank[label].reshape(-1, 3), n


def fans_are_whole(twin: Ints, corner_vertex: Ints, n_vertices: int) -> bool:
    """Whether walking once around each vertex meets all of its corners; closed and oriented only.

    Much faster than :func:`corner_vertices`, where the vertices are known already.
    """
    corners = corner_vertex.ravel()
    index = index_type(corners.size)
    # The corner at the same vertex in the face across the side before it.
    across = np.empty(twin.shape, dtype=index)
    for s in range(3):
        across[:, s] = twin[:, s - 1]
    onward = next_corner(across.ravel(), 2)
    first = np.empty(n_vertices, dtype=index)
    first[corners] = np.arange(corners.size, dtype=index)
    met, corner = 0, first
    while corner.size:
        met += corner.size
        corner = onward[corner]
        going = corner != first
        corner, first = corner[going], first[going]
    return met == corners.size


def next_corner(half_edge: Ints, steps: int = 1) -> Ints:
    """The half-edge (or corner) ``steps`` further round in the same face."""
    # Quotients by a constant are fast, remainders are not.
    corner = half_edge - 3 * (half_edge // 3)
    return np.where(corner < 3 - steps, half_edge + steps, half_edge + (steps - 3))


def components_of(one: Ints, two: Ints, n: int) -> tuple[int, NDArray[np.int32]]:
    """Connected components of the graph on ``n`` nodes with edges ``one[i] two[i]``."""
    graph = coo_array((np.ones(one.size, dtype=np.int8), (one, two)), shape=(n, n)).tocsr()
    return connected_components(graph, directed=False)


def first_half(twin: Ints) -> NDArray[np.bool_]:
    """Mask of the half-edges that give their edge its direction, flat of length 3 m."""
    flat = twin.ravel()
    return (flat < 0) | (np.arange(flat.size) < flat)


def reversing_sides(twin: Ints, sign: NDArray[np.int8]) -> Bools:
    """Mask of the sides across which orientations disagree; (m, 3)."""
    return np.asarray((twin >= 0) & (sign == sign.ravel()[twin]))


def face_components(twin: Ints) -> tuple[int, Ints]:
    """Number of components of a gluing, and the component of each face."""
    glued = np.flatnonzero(twin.ravel() >= 0)
    n, label = components_of(glued // 3, twin.ravel()[glued] // 3, len(twin))
    return n, label.astype(np.int64)


def orientable_faces(twin: Ints, same: Bools) -> Bools:
    """Mask of the faces whose component is orientable: its orientation cover falls in two."""
    m = len(twin)
    half_edge = np.flatnonzero(twin.ravel() >= 0)
    here, there = half_edge // 3, twin.ravel()[half_edge] // 3
    swap = m * same.ravel()[half_edge].astype(np.int64)
    _, sheet = components_of(
        np.concatenate([here, here + m]), np.concatenate([there + swap, there + m - swap]), 2 * m
    )
    return np.asarray(sheet[:m] != sheet[m:])


def check_fans(twin: Ints, same: Bools, corner_vertex: Ints, labels: Ints) -> None:
    """Raise if the faces at some vertex form more than one fan."""
    if twin.min() >= 0 and not same.any() and fans_are_whole(twin, corner_vertex, labels.size):
        return
    fan, n_fans = corner_vertices(twin, same)
    if n_fans == labels.size:
        return
    vertex_of_fan = np.empty(n_fans, dtype=np.int64)
    vertex_of_fan[fan] = corner_vertex
    count = np.bincount(vertex_of_fan, minlength=labels.size)
    bad = np.flatnonzero(count > 1)
    raise MeshError(
        f"{bad.size} vertices join more than one fan of faces; the first, vertex {labels[bad[0]]}, "
        f"joins {count[bad[0]]}. The surface pinches there: split such vertices, one copy per fan "
        "(load_mesh(…, repair=True), --repair)."
    )


def compressed(indices: Ints) -> tuple[Ints, Ints]:
    """The sorted indices that occur, and the array renumbered by them."""
    if indices.max() > 4 * indices.size:
        present, compact = np.unique(indices, return_inverse=True)
        return present, compact.reshape(indices.shape)
    used = np.zeros(int(indices.max()) + 1, dtype=bool)
    used[indices] = True
    present = np.flatnonzero(used)
    if present.size == used.size:
        return present, indices
    return present, (np.cumsum(used) - 1)[indices]
