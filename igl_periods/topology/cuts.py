"""A cut along edges that makes a surface a disk.

Cut along the tree and the 2g edges that tree and cotree leave over; branches of the tree that end
nowhere are mended again.  Made from shortest paths, so that the cut is short.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Bools, Ints
from igl_periods.complexes import DeltaComplex, corner_vertices, half_edge_ends

from .spanning_trees import TreeCotree, shortest_tree_cotree


def cut_to_disk(K: DeltaComplex) -> tuple[Bools, Ints, Ints]:
    """Short edge paths that cut a surface to a disk, and the vertices of that disk.

    The faces are joined across the cotree of the shortest loops; what is left of the tree and
    the loops, without dead ends, is the cut.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected, of genus ≥ 1; gluings that are not meshes are allowed.

    Returns
    -------
    cut : (m, 3) bool
        Mask of the sides at which it is cut.
    corner : (m, 3) int
        Vertex of the disk at each corner.
    vertex : (n,) int
        Vertex of ``K`` that each vertex of the disk is a copy of.

    References
    ----------
    Erickson, Har-Peled, "Optimally cutting a surface into a disk" (2004).
    """
    trees = shortest_tree_cotree(K)
    edges = np.zeros(K.n_edges, dtype=bool)
    edges[K.edge.ravel()[trees.generators]] = True
    edges[K.edge.ravel()[_tree_without_dead_ends(K, trees)]] = True
    cut = edges[K.edge]
    corner, n = corner_vertices(np.where(cut, -1, K.twin), np.zeros_like(cut))
    vertex = np.empty(n, dtype=np.int64)
    vertex[corner] = K.corner_vertex
    return cut, corner, vertex


def _tree_without_dead_ends(K: DeltaComplex, trees: TreeCotree) -> Ints:
    """Half-edges of the tree that have ends of generators on both sides."""
    tail, head = half_edge_ends(K)
    climbing = np.concatenate([tail[trees.generators], head[trees.generators]])
    n_ends, beyond = climbing.size, np.zeros(K.n_vertices, dtype=np.int64)
    while climbing.size:
        np.add.at(beyond, climbing, 1)
        half_edge = trees.vertex_parent[climbing]
        climbing = tail[half_edge[half_edge >= 0]]
    half_edges = trees.vertex_parent[(beyond > 0) & (beyond < n_ends)]
    return half_edges[half_edges >= 0]
