"""Gluings of triangles: from faces, from squares, and the vertices and edges that they make.

A gluing is an array ``twin`` of shape (m, 3): ``twin[f, s] = 3 f' + s'`` glues side ``s`` of
face ``f`` to side ``s'`` of face ``f'``, and -1 leaves it free.  A second array ``same`` of the
same shape says which sides are glued running the *same* way, so that orientations disagree
there; on an oriented surface it is all False.

Side ``s`` runs from corner ``s + 1`` to corner ``s + 2`` (mod 3).
"""

from __future__ import annotations

import operator
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from .errors import ComplexError, MeshError
from .validation import checked_array

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

# More triangles than this do not fit into the memory of common computers.
_MOST_TRIANGLES = 10**8


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
    small = faces.astype(index_type(faces.size))
    tail, head = np.roll(small, -1, 1).ravel(), np.roll(small, 1, 1).ravel()
    low, high = np.minimum(tail, head), np.maximum(tail, head)
    order = _sorted_by(high, labels.size)
    by_low = _sorted_by(low[order], labels.size)
    order = order[by_low]
    low, high = low[order], high[order]
    paired = (low[1:] == low[:-1]) & (high[1:] == high[:-1])
    if np.any(paired[1:] & paired[:-1]):
        _raise_crowded_edge(low * np.int64(labels.size) + high, order, labels[tail], labels[head])
    if paired[0::2].all() and not paired[1::2].any():
        one, other = order[0::2], order[1::2]
    else:
        one, other = order[:-1][paired], order[1:][paired]
    twin = np.full(tail.size, -1, dtype=np.int64)
    twin[one], twin[other] = other, one
    same = np.zeros(tail.size, dtype=bool)
    same[one] = same[other] = tail[one] == tail[other]
    return twin.reshape(-1, 3), same.reshape(-1, 3)


def index_type(largest: int) -> type[np.signedinteger[Any]]:
    """The type of indices up to ``largest``: 32 bits, where they do, halve the memory traffic."""
    return np.int32 if largest < np.iinfo(np.int32).max else np.int64


def _sorted_by(keys: NDArray[np.signedinteger[Any]], n: int) -> NDArray[np.signedinteger[Any]]:
    """The stable order of keys below n, in linear time: the transpose of a sparse matrix."""
    rows = np.arange(keys.size + 1, dtype=keys.dtype)
    return csr_array((rows[:-1], keys, rows), shape=(keys.size, n)).tocsc().data


def _raise_crowded_edge(key: Ints, order: Ints, tail: Ints, head: Ints) -> None:
    _, first, count = np.unique(key, return_index=True, return_counts=True)
    bad = np.flatnonzero(count > 2)
    half_edge = order[first[bad[0]]]
    raise MeshError(
        f"{bad.size} edges border more than two faces; the first, from vertex {tail[half_edge]} to "
        f"{head[half_edge]}, borders {count[bad[0]]}. A surface has at most two faces at an edge: "
        "look for duplicate faces, internal walls or sheets that touch, and split them there."
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
            f"twin is no involution without fixed points: half-edge {h} is glued to {flat[h]}, "
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
    half_edge: Ints = np.arange(corners.size)
    # The corner at the same vertex in the face across the side before it.
    onward = twin.ravel()[next_corner(half_edge, 2)]
    onward = next_corner(onward, 2)
    first = np.empty(n_vertices, dtype=np.int64)
    first[corners] = half_edge
    met, corner = 0, first
    while corner.size:
        met += corner.size
        corner = onward[corner]
        going = corner != first
        corner, first = corner[going], first[going]
    return met == corners.size


def next_corner(half_edge: Ints, steps: int = 1) -> Ints:
    """The half-edge (or corner) ``steps`` further round in the same face."""
    corner = half_edge % 3
    return half_edge + np.where(corner + steps < 3, steps, steps - 3)


def components_of(one: Ints, two: Ints, n: int) -> tuple[int, NDArray[np.int32]]:
    """Connected components of the graph on ``n`` nodes with edges ``one[i] two[i]``."""
    graph = coo_array((np.ones(one.size, dtype=np.int8), (one, two)), shape=(n, n)).tocsr()
    return connected_components(graph, directed=False)


def squares(gluing: Iterable[Sequence[Sequence[int]]], n: int) -> tuple[Floats, Ints]:
    """Unit squares glued as told, each divided into n × n squares of two right triangles.

    Parameters
    ----------
    gluing : iterable of ((square, side), (square, side))
        Sides are 0 bottom, 1 right, 2 top, 3 left; glued sides run in opposite directions.
    n : int

    Returns
    -------
    lengths : (2 n² N, 3) float
    twin : (2 n² N, 3) int

    Raises
    ------
    ComplexError
        If ``n < 1``, there would be more than 1e8 triangles, or a side does not exist, is glued
        twice, to itself, or not at all.
    """
    n = _checked_subdivision(n)
    side_twin = _glued_sides(gluing)
    n_squares = len(side_twin) // 4
    if 2 * n_squares * n * n > _MOST_TRIANGLES:
        raise ComplexError(
            f"{n_squares} squares divided into {n} x {n} squares have {2 * n_squares * n * n:.3g} "
            f"triangles, and up to {_MOST_TRIANGLES:.3g} are made."
        )
    # Cell (k, i, j): column i, row j of square k.  Its diagonal runs from bottom left to top
    # right; the lower triangle has corners (bottom left, bottom right, top right), the upper one
    # (bottom left, top right, top left).
    k, i, j = np.meshgrid(np.arange(n_squares), np.arange(n), np.arange(n), indexing="ij")
    lower = 2 * ((k * n + i) * n + j)
    upper = lower + 1
    bottom, right, top, left = 3 * lower + 2, 3 * lower, 3 * upper, 3 * upper + 1
    twin = np.empty(6 * n_squares * n * n, dtype=np.int64)
    _glue(twin, 3 * lower + 1, 3 * upper + 2)
    _glue(twin, right[:, :-1, :], left[:, 1:, :])
    _glue(twin, top[:, :, :-1], bottom[:, :, 1:])
    # The small sides along each side of each square, counterclockwise: shape (4 N, n).
    sides = np.stack(
        [bottom[:, :, 0], right[:, -1, :], top[:, ::-1, -1], left[:, 0, ::-1]], axis=1
    ).reshape(-1, n)
    _glue(twin, sides, sides[side_twin, ::-1])
    lengths = np.empty((2 * n_squares * n * n, 3))
    lengths[0::2], lengths[1::2] = (1.0, np.sqrt(2.0), 1.0), (1.0, 1.0, np.sqrt(2.0))
    return lengths / n, twin.reshape(-1, 3)


def _checked_subdivision(n: int) -> int:
    try:
        number = operator.index(n)
    except TypeError:
        number = 0
    if number < 1:
        raise ComplexError(f"n = {n!r}: each square is divided into n x n squares, n >= 1.")
    return number


def _glue(twin: Ints, one: Ints, other: Ints) -> None:
    twin[one], twin[other] = other, one


def _glued_sides(gluing: Iterable[Sequence[Sequence[int]]]) -> Ints:
    """The involution of the sides ``4 square + side``."""
    try:
        pairs = np.asarray([np.asarray(pair) for pair in gluing])
    except (ValueError, TypeError):
        pairs = np.zeros(0)
    if pairs.ndim != 3 or pairs.shape[1:] != (2, 2) or not np.issubdtype(pairs.dtype, np.integer):
        raise ComplexError(
            "a gluing of squares is a list of pairs ((square, side), (square, side))."
        )
    square, side = pairs[..., 0], pairs[..., 1]
    if square.min() < 0 or side.min() < 0 or side.max() > 3:
        raise ComplexError(
            "squares are numbered from 0, and sides are 0 bottom, 1 right, 2 top, 3 left."
        )
    if square.max() >= 2 * square.size:
        raise ComplexError(
            f"square {square.max()} is named, but {square.size} glued sides are those of "
            f"{square.size // 4} squares."
        )
    sides = 4 * square + side
    count = np.bincount(sides.ravel(), minlength=4 * (int(square.max()) + 1))
    wrong = np.flatnonzero(count != 1)
    if wrong.size:
        s = int(wrong[0])
        raise ComplexError(
            f"side {s % 4} of square {s // 4} is glued {count[s]} times ({wrong.size} such sides); "
            "every side of every square is glued once, and to another side."
        )
    side_twin = np.empty(count.size, dtype=np.int64)
    side_twin[sides[:, 0]], side_twin[sides[:, 1]] = sides[:, 1], sides[:, 0]
    return side_twin
