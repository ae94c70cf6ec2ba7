"""What a complex consists of, from side lengths and a gluing; the pieces of one that has several.

Edges and vertices get their numbers here: an edge runs the way of its first half-edge.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats, Ints

from .checked_arrays import check_equal_when_glued, check_scale
from .gluings import compressed, corner_vertices, face_components, first_half
from .triangles import mollify

if TYPE_CHECKING:
    from .delta_complex import DeltaComplex


def assembled(
    lengths: Floats, twin: Ints, same: NDArray[np.bool_], corner_vertex: Ints | None = None
) -> dict[str, Any]:
    """Number edges and vertices, average glued lengths, mollify: the attributes of a complex.

    Parameters
    ----------
    lengths : (m, 3) float
    twin, same : (m, 3) int, (m, 3) bool
        As in :meth:`DeltaComplex.from_gluing`, checked.
    corner_vertex : (m, 3) int, optional
        Numbers of the vertices, where they have some.

    Raises
    ------
    ComplexError
        If glued lengths differ, or a triangle is degenerate beyond what mollification mends.
    """
    first = first_half(twin)
    half_edge = np.flatnonzero(first)
    edge = np.empty(twin.size, dtype=np.int64)
    edge[half_edge] = np.arange(half_edge.size)
    second = np.flatnonzero(~first)
    edge[second] = edge[twin.ravel()[second]]
    sign = np.where(first | same.ravel(), 1, -1).astype(np.int8)
    if corner_vertex is None:
        corner_vertex, n_vertices = corner_vertices(twin, same)
    else:
        n_vertices = int(corner_vertex.max()) + 1
    check_scale(lengths)
    lengths, delta = mollify(_glued_lengths(lengths, twin))
    return {
        "lengths": lengths,
        "twin": twin,
        "edge": edge.reshape(-1, 3),
        "sign": sign.reshape(-1, 3),
        "corner_vertex": corner_vertex,
        "n_vertices": n_vertices,
        "n_edges": half_edge.size,
        "labels": np.arange(n_vertices),
        "mollification": delta,
    }


def parts_of(K: DeltaComplex) -> list[DeltaComplex]:
    """The connected components, in the order of their first faces."""
    n, label = face_components(K.twin)
    if n == 1:
        return [K]
    # Sorted once: with a thousand components, a mask of all faces for each would take seconds.
    faces = np.argsort(label, kind="stable")
    sizes = np.bincount(label)
    starts = np.cumsum(sizes) - sizes
    new_face = np.empty(faces.size, dtype=np.int64)
    new_face[faces] = np.arange(faces.size) - np.repeat(starts, sizes)
    parts = sorted(np.split(faces, starts[1:]), key=lambda part: int(part[0]))
    return [_restricted(K, part, new_face) for part in parts]


def _restricted(K: DeltaComplex, chosen: Ints, new_face: Ints) -> DeltaComplex:
    """The subcomplex of the chosen faces, a union of components, which get new numbers."""
    old = K.twin[chosen]
    twin = np.where(old >= 0, 3 * new_face[old // 3] + old % 3, -1)
    reversing = (old >= 0) & (K.sign[chosen] == K.sign.ravel()[old])
    vertices, corner_vertex = compressed(K.corner_vertex[chosen])
    part = assembled(K.lengths[chosen], twin, reversing, corner_vertex) | {
        "labels": K.labels[vertices],
        "positions": None if K.positions is None else K.positions[vertices],
        "mollification": K.mollification,
        "distortion": None if K.distortion is None else K.distortion[chosen],
        "cell": None if K.cell is None else K.cell.of_faces(chosen),
    }
    return replace(K, **part, exact_lengths=None, polygons=None)


def _glued_lengths(lengths: Floats, twin: Ints) -> Floats:
    """Lengths made equal on glued sides, where they may differ by rounding."""
    other = lengths.ravel()[twin]
    if twin.min() < 0:
        other = np.where(twin >= 0, other, lengths)
    if np.array_equal(other, lengths):
        return lengths
    check_equal_when_glued(lengths, twin, "lengths")
    return 0.5 * (lengths + other)
