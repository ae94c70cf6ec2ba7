r"""The fundamental group of a surface: its fundamental polygon, and shortest loops at a vertex.

A spanning tree of the vertices and a spanning tree of the faces that do not cross
(:mod:`igl_periods.topology.spanning_trees`) leave 2g edges over.  Cut along the tree and these
edges, the surface becomes a disc, the *fundamental polygon*: glued across the cotree, the faces
are one polygon, whose boundary passes every edge of the tree twice and every edge left over twice.
Omitting the tree, its boundary is a cyclic *word* in 2g letters, each occurring once in either
direction, the only relation between the 2g loops that the letters close through the tree.

The word knows the intersection numbers.  If c_k is the cochain that counts crossings with the k-th
loop of faces (:mod:`igl_periods.topology.cohomology`), x_k the place of the k-th letter in the word
and y_k that of its inverse, then with lo ≤ hi these two places in order

.. math:: \int c_k \wedge c_l = \operatorname{sign}(y_k - x_k) \,
          \bigl( [lo_k < x_l < hi_k] - [lo_k < y_l < hi_k] \bigr) .

*Shortest loops.*  Let the tree consist of shortest paths from a root r.  The shortest loop at r
through an edge u v runs along the tree to u, over the edge, and back from v.  If the cotree is a
maximum spanning tree for the length of these loops, then the k-th shortest of the 2g loops that
remain is no longer than the k-th shortest of any 2g loops at r that generate the fundamental
group, or that are independent in homology (Erickson, Whittlesey 2005).

Walks are arrays of half-edges ``h = 3 f + s``, as in :func:`igl_periods.homology_basis`.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Erickson, Whittlesey, "Greedy optimal homotopy and homology generators" (2005).
Eppstein, "Dynamic generators of topologically embedded graphs" (2003).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from igl_periods.arrays import Ints, ReadOnlyArrays
from igl_periods.complexes import DeltaComplex, check_surface, next_corner, of_a_surface
from igl_periods.display import facts_html
from igl_periods.errors import ComplexError

from .cycles import rooted_loops
from .spanning_trees import TreeCotree, checked_edge_lengths, shortest_tree_cotree, tree_cotree

# Letters of the word that a notebook shows: those of genus 8.
_LETTERS_SHOWN = 32


@dataclass(frozen=True, eq=False)
class FundamentalPolygon(ReadOnlyArrays):
    """A surface cut open to a disc.

    Attributes
    ----------
    boundary : (2 (n_vertices − 1) + 4g,) int
        The half-edges on the boundary of the disc, counterclockwise: the faces lie on their left.
    word : (4g,) int
        The letters on the boundary, in this order: ±(k + 1) for the k-th edge that is in neither
        tree, + in its direction.  Each occurs once with either sign.
    """

    boundary: Ints
    word: Ints

    def __repr__(self) -> str:
        return f"FundamentalPolygon({self.word.size} sides, {self.boundary.size} edges around)"

    def _repr_html_(self) -> str:
        shown = [f"x{abs(k)}{'⁻¹' * (k < 0)}" for k in self.word[:_LETTERS_SHOWN].tolist()]
        word = " ".join([*shown, *["…"] * (self.word.size > _LETTERS_SHOWN)])
        facts = [("sides", self.word.size), ("edges around", self.boundary.size), ("word", word)]
        return facts_html("Fundamental polygon", facts)


@of_a_surface
def fundamental_polygon(K: DeltaComplex, trees: TreeCotree | None = None) -> FundamentalPolygon:
    """Cut a surface open along a tree and the edges that are left over: a 4g-gon.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected.
    trees : TreeCotree, optional
        The default is ``tree_cotree(K)``; also ``shortest_tree_cotree(K, root)``.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected, or what the trees leave of it is not
        one disc.

    Examples
    --------
    >>> from igl_periods import DeltaComplex
    >>> torus = DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=2)
    >>> fundamental_polygon(torus).word.tolist()
    [1, 2, -1, -2]
    """
    check_surface(K)
    if trees is None:
        trees = tree_cotree(K)
    boundary = _boundary(K, trees)
    letter = np.zeros(K.twin.size, dtype=np.int64)
    letter[trees.generators] = np.arange(1, trees.generators.size + 1)
    letter[K.twin.ravel()[trees.generators]] = -letter[trees.generators]
    word = letter[boundary]
    return FundamentalPolygon(boundary, word[word != 0])


@of_a_surface
def shortest_loops(
    K: DeltaComplex, root: int = 0, edge_lengths: ArrayLike | None = None
) -> list[Ints]:
    """The shortest loops at a vertex that generate the fundamental group, along edges.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected.
    root : int
        Vertex at which all loops start and end.
    edge_lengths : (n_edges,) array-like, optional
        Positive; the lengths of the edges on the surface where they are not given.  With ones, the
        loops have the fewest edges.

    Returns
    -------
    list of 2g int arrays
        Half-edges in the order in which the loop passes them, the shortest loop first.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected, ``root`` is not a vertex, or edge
        lengths are not positive and finite.

    References
    ----------
    Erickson, Whittlesey, "Greedy optimal homotopy and homology generators" (2005).

    Examples
    --------
    As many as the fundamental group has generators.

    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> len(ip.shortest_loops(K))
    4
    """
    lengths = checked_edge_lengths(K, edge_lengths)
    trees = shortest_tree_cotree(K, root, lengths)
    loops = rooted_loops(K, trees)
    order = np.argsort([lengths[K.edge.ravel()[loop]].sum() for loop in loops], kind="stable")
    return [loops[k] for k in order]


def _boundary(K: DeltaComplex, trees: TreeCotree) -> Ints:
    """The boundary of the faces glued across the cotree, from the first edge left over on."""
    twin, half_edges = K.twin.ravel(), np.arange(K.twin.size)
    glued = np.zeros(twin.size, dtype=bool)
    crossed = trees.face_parent[trees.face_parent >= 0]
    glued[crossed] = glued[twin[crossed]] = True
    # From a side that is glued the boundary goes on in the neighbouring face, round a vertex.
    onward = np.where(glued, next_corner(twin), half_edges)
    for _ in range(twin.size.bit_length()):
        onward = onward[onward]
    ones, after = np.ones(twin.size, dtype=np.int8), onward[next_corner(half_edges)]
    successors = csr_array((ones, (half_edges, after)), shape=(twin.size, twin.size))
    free = np.flatnonzero(~glued)
    start = trees.generators[0] if trees.generators.size else free[0]
    boundary = breadth_first_order(successors, int(start), return_predecessors=False)
    if boundary.size != free.size:
        raise ComplexError(
            "the trees do not cut the surface open to one disc: the boundary at half-edge "
            f"{start} has {boundary.size} of {free.size} sides."
        )
    return boundary.astype(np.int64)
