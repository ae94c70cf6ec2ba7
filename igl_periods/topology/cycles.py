"""Canonical cycles as closed walks along edges.

An edge that is left over by tree and cotree closes a loop through the root of the tree.  These
loops are dual to the cochains of the cotree; the canonical cycles are integer combinations of them,
and as walks all of them pass the root, so that they can be joined there.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Ints
from igl_periods.complexes import (
    DeltaComplex,
    check_closed_and_oriented,
    half_edge_ends,
    of_a_surface,
)
from igl_periods.symplectic import integer_symplectic_basis, standard_form

from .cohomology import cotree_cochains, pairing
from .spanning_trees import TreeCotree, tree_cotree


@of_a_surface
def homology_basis(K: DeltaComplex, root: int = 0) -> list[Ints]:
    """The canonical cycles a_1..a_g, b_1..b_g as closed walks along edges.

    They are dual to :func:`cohomology_basis` for the same root: ∮_{a_j} α_i = δ_ij = ∮_{b_j} β_i.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected.
    root : int
        Vertex at which the tree starts.

    Returns
    -------
    list of 2g int arrays
        Half-edges ``h = 3 f + s`` in the order in which the walk passes them, each from corner
        s + 1 to corner s + 2 of face f.  The edges are ``K.edge.ravel()[h]``, passed along
        (+1) or against (-1) their direction as ``K.sign.ravel()[h]`` says, and the vertices are
        where they start ``K.corner_vertex.ravel()[next_corner(h)]``.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected.

    Examples
    --------
    Four closed walks, a_1, a_2, b_1, b_2, along half-edges.

    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> walks = ip.homology_basis(K)
    >>> len(walks)
    4
    """
    check_closed_and_oriented(K)
    trees = tree_cotree(K, root)
    cochains = cotree_cochains(K, trees)
    M = pairing(K, cochains, cochains)
    T = integer_symplectic_basis(M).astype(np.int64)
    # T M Tᵀ = J, so the dual basis is T⁻ᵀ = J T Mᵀ in terms of the loops dual to the cochains.
    # All three are sparse, and a dense product of integers would take longer than everything else.
    J, rows = csr_array(standard_form(len(T) // 2)), csr_array(T)
    coefficients = (J @ rows @ csr_array(M.T)).toarray()
    loops = rooted_loops(K, trees)
    return [_combined(K, loops, row) for row in coefficients]


def rooted_loops(K: DeltaComplex, trees: TreeCotree) -> list[Ints]:
    """The loops from the root through each of the edges left over; 2g walks.

    Each runs along the tree to its edge, over it in its direction, and back along the tree.
    """
    tail, head = half_edge_ends(K)
    twin = K.twin.ravel()

    def from_root(vertex: int) -> list[int]:
        path: list[int] = []
        while (half_edge := int(trees.vertex_parent[vertex])) >= 0:
            path.append(half_edge)
            vertex = int(tail[half_edge])
        return path[::-1]

    loops = []
    for half_edge in trees.generators:
        there, back = from_root(tail[half_edge]), from_root(head[half_edge])
        loops.append(np.array([*there, half_edge, *twin[back[::-1]]], dtype=np.int64))
    return loops


def reversed_walk(walk: Ints, twin: Ints) -> Ints:
    """The walk run through the other way; ``twin`` flat."""
    return np.asarray(twin[walk[::-1]])


def without_returns(walk: Ints, twin: Ints) -> Ints:
    """A closed walk, along edges or across them, without passages of an edge to and fro."""
    kept: list[int] = []
    opposite: list[int] = []
    for half_edge, other in zip(walk.tolist(), twin[walk].tolist()):
        if kept and kept[-1] == other:
            kept.pop()
            opposite.pop()
        else:
            kept.append(half_edge)
            opposite.append(other)
    first, last = 0, len(kept) - 1
    while first < last and kept[first] == opposite[last]:
        first, last = first + 1, last - 1
    return np.array(kept[first : last + 1], dtype=np.int64)


def _combined(K: DeltaComplex, loops: list[Ints], coefficients: Ints) -> Ints:
    """Loops with one base point, run through one after the other."""
    twin = K.twin.ravel()
    parts: list[Ints] = [np.zeros(0, dtype=np.int64)]
    for k in np.flatnonzero(coefficients):
        loop = loops[k] if coefficients[k] > 0 else reversed_walk(loops[k], twin)
        parts += [loop] * int(abs(coefficients[k]))
    return without_returns(np.concatenate(parts), twin)
