"""A spanning tree of the vertices, and one of the faces that crosses none of its edges.

The two are a *tree–cotree decomposition*: on a closed connected surface 2g edges are in neither of
them (Eppstein 2003).  Any two trees will do for homology, where breadth-first search from a fixed
root makes the result deterministic.  For shortest loops the tree consists of shortest paths, and
the cotree is a maximum spanning tree for the lengths of the loops that its edges close.

References
----------
Eppstein, "Dynamic generators of topologically embedded graphs" (2003).
Erickson, Whittlesey, "Greedy optimal homotopy and homology generators" (2005).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, dijkstra, minimum_spanning_tree

from igl_periods.arrays import Bools, Floats, Ints, ReadOnlyArrays
from igl_periods.complexes import (
    DeltaComplex,
    check_connected,
    check_surface,
    checked_array,
    ends_of_sides,
    half_edge_ends,
    index_type,
    sorted_by_rows,
)
from igl_periods.display import arrays_repr
from igl_periods.errors import ComplexError
from igl_periods.options import checked_integer


@dataclass(frozen=True, eq=False)
class TreeCotree(ReadOnlyArrays):
    """A spanning tree of the vertices and one of the faces that do not cross.

    Attributes
    ----------
    vertex_parent : (n_vertices,) int
        The half-edge that runs from the parent of each vertex to it; -1 at the root.
    face_parent : (m,) int
        The half-edge through which each face is left towards its parent; -1 at the root.
    generators : (2g,) int
        The half-edges, running with their edges, of the edges in neither tree.
    """

    __repr__ = arrays_repr

    vertex_parent: Ints
    face_parent: Ints
    generators: Ints


def tree_cotree(K: DeltaComplex, root: int = 0) -> TreeCotree:
    """Breadth-first tree of the vertices from ``root``, and of the faces around it.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
    root : int
        Vertex at which the tree starts.
    """
    root = checked_integer("root", root)
    if not 0 <= root < K.n_vertices:
        raise ValueError(
            f"root = {root} is not a vertex: there are {K.n_vertices}, counted from 0."
        )
    vertex_parent = _vertex_tree(K, root)
    if np.count_nonzero(vertex_parent < 0) > 1:
        check_connected(K)
    in_tree = np.zeros(K.n_edges, dtype=bool)
    in_tree[K.edge.ravel()[vertex_parent[vertex_parent >= 0]]] = True
    face_parent = _face_tree(K, ~in_tree[K.edge])
    in_tree[K.edge.ravel()[face_parent[face_parent >= 0]]] = True
    generators = np.flatnonzero((K.sign.ravel() > 0) & ~in_tree[K.edge.ravel()])
    return TreeCotree(vertex_parent, face_parent, generators)


def _vertex_tree(K: DeltaComplex, root: int) -> Ints:
    """The least half-edge to each vertex from the one before it, breadth first; -1 elsewhere."""
    index = index_type(3 * K.n_faces)
    tail, head = ends_of_sides(K.corner_vertex, index)
    around = sorted_by_rows(np.arange(tail.size, dtype=index), tail, head, K.n_vertices)
    before = _predecessors(around.indices, around.indptr, root)
    # The half-edges back, side by side at each vertex; there are several where edges are multiple.
    degree = np.diff(around.indptr)
    back = np.flatnonzero(around.indices == np.repeat(before, degree))
    towards = K.twin.ravel()[around.data[back]]
    vertex = head[towards]
    first = np.flatnonzero(np.diff(vertex, prepend=-1))
    parent = np.full(K.n_vertices, -1, dtype=np.int64)
    parent[vertex[first]] = np.minimum.reduceat(towards, first) if first.size else towards
    return parent


def _face_tree(K: DeltaComplex, open_sides: Bools) -> Ints:
    """The first open side of each face towards the one before it, breadth first; -1 elsewhere."""
    there = K.twin.astype(index_type(3 * K.n_faces)) // 3
    start = np.zeros(K.n_faces + 1, dtype=there.dtype)
    for s in range(3):
        start[1:] += open_sides[:, s]
    np.cumsum(start, out=start)
    before = _predecessors(there[open_sides], start, 0)
    parent = np.full(K.n_faces, -1, dtype=np.int64)
    for s in (2, 1, 0):
        face = np.flatnonzero(open_sides[:, s] & (there[:, s] == before))
        parent[face] = 3 * face + s
    return parent


def _predecessors(neighbour: NDArray[Any], start: NDArray[Any], root: int) -> Ints:
    """The node before each one on the way from the root; neighbours are met in their order."""
    n = start.size - 1
    graph = csr_array((np.ones(neighbour.size), neighbour, start), shape=(n, n))
    graph.sort_indices()
    return breadth_first_order(graph, root, directed=True, return_predecessors=True)[1]


def shortest_tree_cotree(
    K: DeltaComplex, root: int = 0, edge_lengths: ArrayLike | None = None
) -> TreeCotree:
    """The tree of shortest paths from a root, and the cotree that leaves the shortest loops over.

    Parameters, errors and source are those of :func:`shortest_loops`.
    """
    check_surface(K)
    root = checked_integer("root", root)
    if not 0 <= root < K.n_vertices:
        raise ComplexError(f"there is no vertex {root}: vertices are 0 … {K.n_vertices - 1}.")
    lengths = checked_edge_lengths(K, edge_lengths)[K.edge.ravel()]
    tail, head = half_edge_ends(K)
    vertex_parent, distance = _shortest_paths(K.n_vertices, tail, head, lengths, root)

    free = np.ones(K.n_edges, dtype=bool)
    free[K.edge.ravel()[vertex_parent[vertex_parent >= 0]]] = False
    crossable = np.flatnonzero(free[K.edge.ravel()])
    through = distance[tail] + lengths + distance[head]
    longest_first = crossable[np.argsort(-through[crossable], kind="stable")]
    face_parent = _cotree(K, longest_first)
    free[K.edge.ravel()[face_parent[face_parent >= 0]]] = False
    generators = np.flatnonzero((K.sign.ravel() > 0) & free[K.edge.ravel()])
    return TreeCotree(vertex_parent, face_parent, generators)


def checked_edge_lengths(K: DeltaComplex, edge_lengths: ArrayLike | None) -> Floats:
    """Positive lengths of edges, by default those of the surface."""
    if edge_lengths is None:
        own = np.empty(K.n_edges)
        own[K.edge.ravel()] = K.lengths.ravel()
        return own
    given = checked_array(edge_lengths, "edge_lengths", ComplexError)
    if given.dtype.kind not in "iuf":
        raise ComplexError(f"edge lengths are real numbers, not {given.dtype}.")
    lengths = given.astype(np.float64)
    if lengths.shape != (K.n_edges,):
        raise ComplexError(
            f"edge lengths must have shape ({K.n_edges},), one per edge, not {lengths.shape}."
        )
    if not (np.isfinite(lengths) & (lengths > 0)).all():
        raise ComplexError("edge lengths must be positive and finite.")
    return lengths


def _shortest_paths(
    n: int, tail: Ints, head: Ints, lengths: Floats, root: int
) -> tuple[Ints, Floats]:
    """The half-edge that leads to each vertex on a shortest path, -1 at the root; distances."""
    proper = np.flatnonzero(tail != head)
    # Of the half-edges with the same ends, the shortest.
    proper = proper[np.argsort(lengths[proper], kind="stable")]
    _, first = np.unique(tail[proper] * n + head[proper], return_index=True)
    half_edge = proper[first]
    graph = csr_array((lengths[half_edge], (tail[half_edge], head[half_edge])), shape=(n, n))
    distance, before = dijkstra(graph, indices=root, return_predecessors=True)
    last = half_edge[before[head[half_edge]] == tail[half_edge]]
    parent = np.full(n, -1, dtype=np.int64)
    parent[head[last]] = last
    return parent, distance


def _cotree(K: DeltaComplex, half_edges: Ints) -> Ints:
    """The spanning tree of the faces that prefers the first half-edges; as parents of faces."""
    m, twin = K.n_faces, K.twin.ravel()
    here, there = half_edges // 3, twin[half_edges] // 3
    # Ranks as weights: no two are equal, and a weight names its half-edge.
    rank = np.arange(half_edges.size)
    _, first = np.unique(np.minimum(here, there) * m + np.maximum(here, there), return_index=True)
    first = first[here[first] != there[first]]
    # Older versions of SciPy find spanning trees for 32-bit indices only.
    ends = here[first].astype(np.int32), there[first].astype(np.int32)
    graph = csr_array((rank[first] + 1.0, ends), shape=(m, m))
    chosen = half_edges[minimum_spanning_tree(graph).data.astype(np.int64) - 1]
    both = np.concatenate([chosen, twin[chosen]])
    tree = csr_array((np.ones(both.size), (both // 3, twin[both] // 3)), shape=(m, m))
    _, before = breadth_first_order(tree, 0, return_predecessors=True)
    upward = both[before[both // 3] == twin[both] // 3]
    parent = np.full(m, -1, dtype=np.int64)
    parent[upward // 3] = upward
    return parent
