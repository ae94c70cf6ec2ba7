r"""Midpoint refinement: every triangle into four similar ones, cochains carried along.

The midpoints of the sides divide a triangle into four triangles of half its size.  On a surface
this adds a vertex on every edge, where the surface is flat, so that

* no triangle of the refined complex has two corners at old vertices;
* every refined edge that ends at an old vertex has a midpoint at its other end.

A closed cochain passes to the refinement by any closed cochain that sums to the old value over
the two halves of every edge.  Here the first half, in the direction of the edge, takes the whole
value and the second half takes 0, and closedness gives the values on the inner edges: integers
stay integers, and the cohomology class stays the same.

.. code-block:: text

              2                    Child i < 3 lies at corner i and has the corners of its parent
             / \                   in their order, each moved to halfway from corner i.  Child 3
            / 2 \                  is the middle: its corner s is the midpoint of side s.  Inner
        m1 *-----* m0              edges join side s of child s to side s of child 3.
          / \ 3 / \
         / 0 \ / 1 \
        0-----*-----1
              m2
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints

from .cochains import check_cochains
from .delta_complex import DeltaComplex
from .gluings import reversing_sides


def split(K: DeltaComplex, cochains: csr_array) -> tuple[DeltaComplex, csr_array]:
    """Divide every face into four at the midpoints of its sides.

    Parameters
    ----------
    K : DeltaComplex
        Any complex: boundaries, loops, and faces glued to themselves are allowed.
    cochains : (k, n_edges) sparse int
        Closed.

    Returns
    -------
    K : DeltaComplex
        The same surface.  Old vertices keep their index, the midpoint of edge e is vertex
        ``n_vertices + e`` with label -1.  Face f becomes the faces 4 f … 4 f + 3.  The halves of
        edge e are the edges 2 e and 2 e + 1, in its direction.
    cochains : (k, 2 n_edges + 3 m) sparse int
        The same cohomology classes; the value on edge e is on its first half.

    Raises
    ------
    ComplexError
        If ``cochains`` does not have one column an edge.
    """
    check_cochains(K, cochains)
    twin, same = _twins(K)
    edge, first = _edges(K), np.arange(twin.size).reshape(-1, 3) < twin
    sign = np.where(first | same | (twin < 0), 1, -1).astype(np.int8)
    positions = K.positions
    if positions is not None:
        positions = np.concatenate([positions, _midpoints(K)])
    refined = DeltaComplex(
        lengths=np.repeat(0.5 * K.lengths, 4, axis=0),
        twin=twin,
        edge=edge,
        sign=sign,
        corner_vertex=_corner_vertices(K),
        n_vertices=K.n_vertices + K.n_edges,
        n_edges=2 * K.n_edges + 3 * K.n_faces,
        labels=np.concatenate([K.labels, np.full(K.n_edges, -1)]),
        positions=positions,
        mollification=0.5 * K.mollification,
        distortion=None if K.distortion is None else np.repeat(K.distortion, 4),
        cell=None if K.cell is None else K.cell.divided(),
    )
    return refined, (cochains @ _carry(K, refined)).tocsr()


# The half of side s that comes first lies in child s + 1, the other in child s + 2; within the
# child it is side s again.
_SIDE = np.arange(3)
_FIRST, _SECOND = 3 * ((_SIDE + 1) % 3) + _SIDE, 3 * ((_SIDE + 2) % 3) + _SIDE


def _twins(K: DeltaComplex) -> tuple[Ints, NDArray[np.bool_]]:
    """Half-edges glued to those of the children, and which are glued running the same way."""
    parent = 12 * np.arange(K.n_faces)[:, None]
    glued = K.twin >= 0
    same = reversing_sides(K.twin, K.sign)
    other_parent, other_side = 12 * (K.twin // 3), K.twin % 3
    twin = np.empty((K.n_faces, 12), dtype=np.int64)
    reverses = np.zeros((K.n_faces, 12), dtype=bool)
    for here, alike, opposite in ((_FIRST, _FIRST, _SECOND), (_SECOND, _SECOND, _FIRST)):
        there = other_parent + np.where(same, alike[other_side], opposite[other_side])
        twin[:, here] = np.where(glued, there, -1)
        reverses[:, here] = same
    inner, middle = 4 * _SIDE, 9 + _SIDE
    twin[:, inner], twin[:, middle] = parent + middle, parent + inner
    return twin.reshape(-1, 3), reverses.reshape(-1, 3)


def _edges(K: DeltaComplex) -> Ints:
    edge = np.empty((K.n_faces, 12), dtype=np.int64)
    against = K.sign < 0
    edge[:, _FIRST], edge[:, _SECOND] = 2 * K.edge + against, 2 * K.edge + ~against
    inner = 2 * K.n_edges + np.arange(3 * K.n_faces).reshape(-1, 3)
    edge[:, 4 * _SIDE] = edge[:, 9 + _SIDE] = inner
    return edge.reshape(-1, 3)


def _corner_vertices(K: DeltaComplex) -> Ints:
    corner = np.empty((K.n_faces, 4, 3), dtype=np.int64)
    midpoint = K.n_vertices + K.edge
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        corner[:, i, i], corner[:, i, j], corner[:, i, k] = (
            K.corner_vertex[:, i],
            midpoint[:, k],
            midpoint[:, j],
        )
    corner[:, 3] = midpoint
    return corner.reshape(-1, 3)


def _midpoints(K: DeltaComplex) -> Floats:
    assert K.positions is not None
    midpoints = np.empty((K.n_edges, K.positions.shape[1]))
    for s in range(3):
        ends = K.corner_vertex[:, (s + 1) % 3], K.corner_vertex[:, (s + 2) % 3]
        midpoints[K.edge[:, s]] = 0.5 * (K.positions[ends[0]] + K.positions[ends[1]])
    return midpoints


def _carry(K: DeltaComplex, refined: DeltaComplex) -> csr_array:
    """The matrix (n_edges, n_edges') of the step: values on old edges to values on new ones."""
    sign = K.sign.astype(np.int64)
    parent = 12 * np.arange(K.n_faces)[:, None]
    # The first half of an edge is the first half of a side that runs with it, and the second half
    # of a side that runs against it: its value along that side is the one along the whole side.
    carrier = parent + np.where(sign > 0, _FIRST, _SECOND)
    side = np.empty(K.n_edges, dtype=np.int64)
    side[K.edge.ravel()] = np.arange(K.edge.size)
    half = carrier.ravel()[side]
    rows = [np.arange(K.n_edges)]
    columns = [refined.edge.ravel()[half]]
    values = [sign.ravel()[side] * refined.sign.ravel()[half]]
    # Child i ends at side i: it holds the second half of side i + 1 and the first of side i + 2.
    for i in range(3):
        for s, runs in (((i + 1) % 3, -1), ((i + 2) % 3, 1)):
            f = np.flatnonzero(sign[:, s] == runs)
            inner = 12 * f + 4 * i
            rows.append(K.edge[f, s])
            columns.append(refined.edge.ravel()[inner])
            values.append(-runs * refined.sign.ravel()[inner].astype(np.int64))
    return csr_array(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
        shape=(K.n_edges, refined.n_edges),
    )
