r"""The fundamental group of a surface: its fundamental polygon, and shortest loops at a vertex.

A spanning tree of the vertices and a spanning tree of the faces that do not cross
(:class:`igl_periods.homology.TreeCotree`) leave 2g edges over.  Cut along the tree and these
edges, the surface becomes a disc, the *fundamental polygon*: glued across the cotree, the faces
are one polygon, whose boundary passes every edge of the tree twice and every edge left over twice.
Omitting the tree, its boundary is a cyclic *word* in 2g letters, each occurring once in either
direction, the only relation between the 2g loops that the letters close through the tree.

The word knows the intersection numbers.  If c_k is the cochain that counts crossings with the k-th
loop of faces (:func:`igl_periods.homology.cotree_cochains`), x_k the place of the k-th letter in
the word and y_k that of its inverse, then with lo ≤ hi these two places in order

.. math:: \int c_k \wedge c_l = \operatorname{sign}(y_k - x_k) \,
          \bigl( [lo_k < x_l < hi_k] - [lo_k < y_l < hi_k] \bigr) .

*Shortest loops.*  Let the tree consist of shortest paths from a root r.  The shortest loop at r
through an edge u v runs along the tree to u, over the edge, and back from v.  If the cotree is a
maximum spanning tree for the length of these loops, then the k-th shortest of the 2g loops that
remain is no longer than the k-th shortest of any 2g loops at r that generate the fundamental
group, or that are independent in homology (Erickson, Whittlesey 2005).

Walks are arrays of half-edges ``h = 3 f + s``, as in :func:`igl_periods.homology.homology_basis`.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Erickson, Whittlesey, "Greedy optimal homotopy and homology generators" (2005).
Eppstein, "Dynamic generators of topologically embedded graphs" (2003).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, dijkstra, minimum_spanning_tree

from .delta_complex import DeltaComplex, check_surface
from .errors import ComplexError
from .gluing import next_corner
from .homology import TreeCotree, half_edge_ends, rooted_loops, tree_cotree

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class FundamentalPolygon:
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


def fundamental_polygon(K: DeltaComplex, trees: TreeCotree | None = None) -> FundamentalPolygon:
    """Cut a surface open along a tree and the edges that are left over.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
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


def word_pairing(word: Ints) -> Ints:
    """The pairings ∫ c_k ∧ c_l of the cochains of the letters, read off the word; (2g, 2g).

    Parameters
    ----------
    word : (4g,) int
        As :class:`FundamentalPolygon` has it: the letters ±1, …, ±2g, each once.
    """
    order = np.argsort(word)
    half = word.size // 2
    inverse, place = order[:half][::-1], order[half:]
    low, high = np.minimum(place, inverse), np.maximum(place, inverse)

    def between(x: Ints) -> Ints:
        inside = (low[:, None] < x) & (x < high[:, None])
        return inside.astype(np.int64)

    return np.sign(inverse - place)[:, None] * (between(place) - between(inverse))


def shortest_loops(
    K: DeltaComplex, root: int = 0, edge_lengths: ArrayLike | None = None
) -> list[Ints]:
    """The shortest loops at a vertex that generate the fundamental group, along edges.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
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
        If the surface is not closed, oriented and connected, ``root`` is no vertex, or edge
        lengths are not positive and finite.

    References
    ----------
    Erickson, Whittlesey, "Greedy optimal homotopy and homology generators" (2005).
    """
    lengths = _checked_lengths(K, edge_lengths)
    trees = shortest_tree_cotree(K, root, lengths)
    loops = rooted_loops(K, trees)
    order = np.argsort([lengths[K.edge.ravel()[loop]].sum() for loop in loops], kind="stable")
    return [loops[k] for k in order]


def shortest_tree_cotree(
    K: DeltaComplex, root: int = 0, edge_lengths: ArrayLike | None = None
) -> TreeCotree:
    """The tree of shortest paths from a root, and the cotree that leaves the shortest loops over.

    Parameters, errors and source are those of :func:`shortest_loops`.
    """
    check_surface(K)
    if not 0 <= root < K.n_vertices:
        raise ComplexError(f"there is no vertex {root}: vertices are 0 … {K.n_vertices - 1}.")
    lengths = _checked_lengths(K, edge_lengths)[K.edge.ravel()]
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


def walk_vertices(K: DeltaComplex, walk: Ints) -> Ints:
    """The vertices at which the half-edges of a walk start; shape of ``walk``."""
    return np.asarray(K.corner_vertex.ravel()[next_corner(walk)])


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


def _checked_lengths(K: DeltaComplex, edge_lengths: ArrayLike | None) -> Floats:
    if edge_lengths is None:
        own = np.empty(K.n_edges)
        own[K.edge.ravel()] = K.lengths.ravel()
        return own
    lengths = np.asarray(edge_lengths, dtype=np.float64)
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
