"""Half-edges: an edge as it is seen from one of its faces.

Half-edge h = 3 f + s is side s of face f, run through from corner s + 1 to corner s + 2.  An edge
has two half-edges, or one on the boundary; its own direction is that of the first.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Ints

from .delta_complex import DeltaComplex
from .gluings import ends_of_sides, next_corner


def forward_half_edges(K: DeltaComplex) -> Ints:
    """Of each edge the half-edge that runs with it (either, where both do); (n_edges,)."""
    forward = np.flatnonzero(K.sign.ravel() > 0)
    half_edge = np.empty(K.n_edges, dtype=np.int64)
    half_edge[K.edge.ravel()[forward]] = forward
    return half_edge


def edge_ends(K: DeltaComplex) -> tuple[Ints, Ints]:
    """Vertices at which each edge starts and ends; two arrays of shape (n_edges,)."""
    forward, corners = forward_half_edges(K), K.corner_vertex.ravel()
    return corners[next_corner(forward)], corners[next_corner(forward, 2)]


def half_edge_ends(K: DeltaComplex) -> tuple[Ints, Ints]:
    """Vertices at which each half-edge starts and ends, two arrays of shape (3 m,)."""
    return ends_of_sides(K.corner_vertex, np.int64)


def walk_vertices(K: DeltaComplex, walk: Ints) -> Ints:
    """The vertices at which the half-edges of a walk start; shape of ``walk``."""
    return np.asarray(K.corner_vertex.ravel()[next_corner(walk)])
