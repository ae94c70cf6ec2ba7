r"""Cycles on the dual graph Γ*: closed walks of faces, and how they cross walks along edges.

A walk along edges is an array of half-edges ``h = 3 f + s``, passed one after the other, as in
:func:`igl_periods.homology_basis`.  A walk of faces is an array of half-edges too: those
through which the faces are left, from face ``h // 3`` to face ``twin[h] // 3``.  The edge e* of Γ*
crosses e from right to left, and the face of a half-edge lies on its left; so a walk of faces that
leaves a face through h passes e* against its direction where h runs with e.

A closed walk along edges, moved off the edges to its left, is a closed walk of faces in the same
homotopy class.  In this way the canonical cycles on Γ give canonical cycles on Γ*.

The crossing numbers of the edges with a closed walk of faces are a closed cochain, its Poincaré
dual: its sum along a closed walk along edges is the intersection number of the two walks.  For the
canonical cycles a_i, b_i these cochains are cohomologous to β_i, −α_i.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Ints
from igl_periods.complexes import DeltaComplex, half_edge_ends, next_corner, of_a_surface
from igl_periods.errors import ComplexError

from .cycles import homology_basis, without_returns


@of_a_surface
def dual_homology_basis(K: DeltaComplex, root: int = 0) -> list[Ints]:
    """The canonical cycles a_1..a_g, b_1..b_g as closed walks of faces, cycles on Γ*.

    They are those of :func:`igl_periods.homology_basis`, moved off the edges to the left.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected.
    root : int
        As in :func:`igl_periods.homology_basis`.

    Returns
    -------
    list of 2g int arrays
        Half-edges h: the walk goes from face ``h // 3`` through h to face ``K.twin.flat[h] // 3``.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected.

    Examples
    --------
    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> len(ip.dual_homology_basis(K))
    4
    """
    return [dual_walk(K, walk) for walk in homology_basis(K, root)]


def dual_walk(K: DeltaComplex, walk: Ints) -> Ints:
    """The closed walk of faces along the left side of a closed walk along edges.

    It crosses the edges that leave the walk to its left, in order, and is homotopic to it.
    Passages to and fro are left out.

    Parameters
    ----------
    walk : (k,) int
        Half-edges; the last one ends where the first one starts.

    Returns
    -------
    (l,) int
        Half-edges through which the faces are left.

    Raises
    ------
    ComplexError
        If the walk is not closed.
    """
    tail, head = half_edge_ends(K)
    if not np.array_equal(head[walk], tail[np.roll(walk, -1)]):
        raise ComplexError("the walk is not closed: some half-edge does not start where it should.")
    twin = K.twin.ravel()
    after = next_corner(np.arange(twin.size))
    crossed: list[int] = []
    for here, there in zip(walk, np.roll(walk, -1)):
        # The half-edges that start where `here` ends, clockwise, until the walk goes on.
        half_edge = after[here]
        while half_edge != there:
            crossed.append(int(half_edge))
            half_edge = after[twin[half_edge]]
    return without_returns(np.array(crossed, dtype=np.int64), twin)


def crossing_cochain(K: DeltaComplex, dual: Ints) -> Ints:
    """How often a walk of faces crosses each edge, + from its left to its right; (n_edges,).

    The intersection number of the walk with a closed walk along edges is the sum of this cochain
    along the latter.  The integral of a form on Γ* along the walk is minus its sum over all edges,
    counted so: e* crosses e from right to left.
    """
    crossings = np.zeros(K.n_edges, dtype=np.int64)
    np.add.at(crossings, K.edge.ravel()[dual], K.sign.ravel()[dual])
    return crossings
