r"""Closed cochains: numbers on edges, and their values along sides and walks.

A cochain c is *closed* if the signed sum around every face vanishes.  Then its value along a walk
depends on the class of the walk only, and on a piece of the surface that is simply connected it is
the differential of a function on vertices, its *primitive*.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from igl_periods.arrays import Ints
from igl_periods.errors import ComplexError

from .delta_complex import DeltaComplex


def primitive(corner: Ints, sides: NDArray[Any]) -> NDArray[Any]:
    """Integrate values along sides to values at vertices, along a spanning tree.

    Parameters
    ----------
    corner : (m, 3) int
        The vertices of connected triangles.
    sides : (m, 3, …)
        Value along side s of each face, from corner s + 1 to corner s + 2.

    Returns
    -------
    (n, …)
        0 at vertex 0.
    """
    tail, head = np.roll(corner, -1, axis=1).ravel(), np.roll(corner, 1, axis=1).ravel()
    n = int(corner.max()) + 1
    # Every side both ways: sides of a boundary are run through once only.
    graph = csr_array((np.ones(tail.size, dtype=np.int8), (tail, head)), shape=(n, n))
    order, parent = breadth_first_order(graph + graph.T, 0, directed=True)
    assert order.size == n, "the triangles are connected"
    parent = parent.astype(np.int64)
    parent[0] = 0
    values = sides.reshape(tail.size, *sides.shape[2:])
    total = np.zeros((n, *values.shape[1:]), dtype=values.dtype)
    for start, end, sign in ((tail, head, 1), (head, tail, -1)):
        steps = np.flatnonzero(parent[end] == start)
        total[end[steps]] = sign * values[steps]
    total[0] = 0
    # Add up along the paths to the root, in as many rounds as their length has binary digits.
    while parent.any():
        total += total[parent]
        parent = parent[parent]
    return total


def along_sides(K: DeltaComplex, values: NDArray[Any]) -> NDArray[Any]:
    """Values of cochains (…, n_edges) along the sides of all faces; (…, m, 3)."""
    return values[..., K.edge] * K.sign


def check_cochains(K: DeltaComplex, cochains: csr_array) -> None:
    """Raise ComplexError unless cochains have one column an edge."""
    if cochains.shape[1] != K.n_edges:
        raise ComplexError(
            f"the cochains have {cochains.shape[1]} columns, but the complex has {K.n_edges} edges."
        )


def walk_cochain(K: DeltaComplex, walk: Ints) -> Ints:
    """How often a walk passes each edge, counted with sign; shape (n_edges,)."""
    passed = np.zeros(K.n_edges, dtype=np.int64)
    np.add.at(passed, K.edge.ravel()[walk], K.sign.ravel()[walk])
    return passed
