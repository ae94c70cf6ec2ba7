r"""Homology of a closed surface over the integers, from a tree and a cotree.

A spanning tree of the vertices, and a spanning tree of the faces that crosses none of its edges,
leave 2g edges over (Eppstein 2003).  Each of them closes two loops: one of vertices, along the
tree, and one of faces, along the cotree.  The signed crossing numbers c_k of the k-th loop of
faces with the edges form a closed integer cochain, and c_k takes the value δ_kl on the l-th loop
of vertices.  So the cochains are a basis of integer cohomology, and the loops its dual basis.

The pairing of closed cochains,

.. math:: \int \alpha \wedge \beta
          = \tfrac12 \sum_{\text{faces}} (\alpha_{01} \beta_{12} - \alpha_{12} \beta_{01}),

is integer, skew and unimodular; :func:`igl_periods.symplectic.integer_symplectic_basis` turns the
c_k into a canonical basis α_1..α_g, β_1..β_g with ∫ α_i ∧ β_j = δ_ij and all other pairings 0.  The
canonical cycles a_1..a_g, b_1..b_g are the dual basis,
:math:`\oint_{a_j} \alpha_i = \delta_{ij} = \oint_{b_j} \beta_i`, with intersection numbers
a_i · b_j = δ_ij.

Everything here is exact, and deterministic: the same complex always gets the same basis.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Eppstein, "Dynamic generators of topologically embedded graphs" (2003).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from .delta_complex import DeltaComplex, check_closed_and_oriented, check_connected
from .errors import ComplexError
from .gluing import index_type
from .symplectic import integer_symplectic_basis, standard_form

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class TreeCotree:
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
    if not 0 <= root < K.n_vertices:
        raise ValueError(f"root = {root} is no vertex: there are {K.n_vertices}, counted from 0.")
    index = index_type(3 * K.n_faces)
    half_edge = np.arange(3 * K.n_faces + 1, dtype=index)
    tail, head = (end.astype(index) for end in half_edge_ends(K))
    ones = np.ones(tail.size)
    # The half-edges at each vertex, as the rows of a transpose.
    around = csr_array((head, tail, half_edge), shape=(tail.size, K.n_vertices)).tocsc()
    graph = csr_array((ones, around.data, around.indptr), shape=(K.n_vertices,) * 2)
    before = _predecessors(graph, root)
    vertex_parent = _first_per_node(np.flatnonzero(before[head] == tail), head, K.n_vertices)
    if np.count_nonzero(vertex_parent < 0) > 1:
        check_connected(K)

    in_tree = np.zeros(K.n_edges, dtype=bool)
    in_tree[K.edge.ravel()[vertex_parent[vertex_parent >= 0]]] = True
    open_sides = ~in_tree[K.edge]
    there = K.twin.astype(index) // 3
    start = np.zeros(K.n_faces + 1, dtype=index)
    np.cumsum(np.count_nonzero(open_sides, axis=1), out=start[1:])
    across = there[open_sides]
    dual_graph = csr_array((ones[: across.size], across, start), shape=(K.n_faces,) * 2)
    before = _predecessors(dual_graph, 0)
    towards_parent = np.flatnonzero(open_sides & (before[:, None] == there))
    face_parent = _first_per_node(towards_parent, half_edge[:-1] // 3, K.n_faces)

    in_tree[K.edge.ravel()[face_parent[face_parent >= 0]]] = True
    generators = np.flatnonzero((K.sign.ravel() > 0) & ~in_tree[K.edge.ravel()])
    return TreeCotree(vertex_parent, face_parent, generators)


def half_edge_ends(K: DeltaComplex) -> tuple[Ints, Ints]:
    """Vertices at which each half-edge starts and ends, two arrays of shape (3 m,)."""
    tail = np.roll(K.corner_vertex, -1, axis=1).ravel()
    head = np.roll(K.corner_vertex, 1, axis=1).ravel()
    return tail, head


def check_cochains(K: DeltaComplex, cochains: csr_array) -> None:
    """Raise ComplexError unless cochains have one column an edge."""
    if cochains.shape[1] != K.n_edges:
        raise ComplexError(
            f"the cochains have {cochains.shape[1]} columns, but the complex has {K.n_edges} edges."
        )


def cotree_cochains(K: DeltaComplex, trees: TreeCotree) -> csr_array:
    """Crossing numbers of the edges with the loop of faces of each generator; (2g, n_edges) int.

    Loop k crosses generator k along its direction and returns through the cotree.
    """
    half_edges = trees.generators
    loops = np.arange(half_edges.size)
    across = K.twin.ravel()[half_edges] // 3
    # From the face behind the generator up to the root, and from the root down to the one before
    # it: where both paths run together they cancel.
    up_loop, up_half_edge = _climb(trees.face_parent, K, across, loops)
    down_loop, down_half_edge = _climb(trees.face_parent, K, half_edges // 3, loops)
    half_edge = np.concatenate([half_edges, up_half_edge, down_half_edge])
    row = np.concatenate([loops, up_loop, down_loop])
    value = np.ones(half_edge.size, dtype=np.int64)
    value[half_edges.size + up_half_edge.size :] = -1
    value *= K.sign.ravel()[half_edge]
    cochains = csr_array(
        (value, (row, K.edge.ravel()[half_edge])), shape=(half_edges.size, K.n_edges)
    )
    cochains.eliminate_zeros()
    return cochains


def pairing(K: DeltaComplex, alpha: csr_array, beta: csr_array) -> Ints:
    """The pairings ∫ α_i ∧ β_j of closed integer cochains; shape (k, l).

    Parameters
    ----------
    alpha, beta : (k, n_edges), (l, n_edges) sparse int
    """
    touched = np.zeros(K.n_edges, dtype=bool)
    touched[alpha.indices] = True
    faces = np.flatnonzero(touched[K.edge].any(axis=1))
    alpha_12, alpha_01 = _along_sides(K, alpha, faces)
    beta_12, beta_01 = _along_sides(K, beta, faces)
    twice = (alpha_01.T @ beta_12 - alpha_12.T @ beta_01).toarray()
    if np.any(twice % 2):
        raise ComplexError("the cochains are not closed: their pairing is not an integer.")
    return twice // 2


def cohomology_basis(K: DeltaComplex, root: int = 0) -> csr_array:
    """A canonical basis of integer cohomology.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
    root : int
        Vertex at which the tree starts; another root gives another basis.

    Returns
    -------
    (2g, n_edges) sparse int
        Closed cochains α_1..α_g, β_1..β_g with ∫ α_i ∧ β_j = δ_ij and all other pairings 0;
        entry [i, e] is the value along edge e in its direction.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected.
    """
    cochains, T = cochains_and_basis(K, root)
    return (csr_array(T.astype(np.int64)) @ cochains).tocsr()


def cochains_and_basis(K: DeltaComplex, root: int = 0) -> tuple[csr_array, NDArray[np.int8]]:
    """Thin cochains c of a tree–cotree decomposition, and T such that T c is canonical.

    The rows of c are supported on single loops of faces, those of T c on many: energies are best
    computed for c, and T applied to the 2g × 2g matrix.
    """
    check_closed_and_oriented(K)
    cochains = cotree_cochains(K, tree_cotree(K, root))
    M = pairing(K, cochains, cochains)
    T = integer_symplectic_basis(M)
    # Both are sparse, and a dense product would take longer than everything before it.
    rows = csr_array(T.astype(np.int64))
    J = csr_array(standard_form(len(T) // 2))
    assert (rows @ csr_array(M) @ rows.T - J).count_nonzero() == 0, "the cochains are a basis"
    return cochains, T


def homology_basis(K: DeltaComplex, root: int = 0) -> list[Ints]:
    """The canonical cycles a_1..a_g, b_1..b_g as closed walks along edges.

    They are dual to :func:`cohomology_basis` for the same root: ∮_{a_j} α_i = δ_ij = ∮_{b_j} β_i.

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
    """
    check_closed_and_oriented(K)
    trees = tree_cotree(K, root)
    cochains = cotree_cochains(K, trees)
    M = pairing(K, cochains, cochains)
    T = integer_symplectic_basis(M).astype(np.int64)
    # T M Tᵀ = J, so the dual basis is T⁻ᵀ = J T Mᵀ in terms of the loops dual to the cochains.
    coefficients = standard_form(len(T) // 2) @ T @ M.T
    loops = [loop.tolist() for loop in rooted_loops(K, trees)]
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


def walk_cochain(K: DeltaComplex, walk: Ints) -> Ints:
    """How often a walk passes each edge, counted with sign; shape (n_edges,)."""
    passed = np.zeros(K.n_edges, dtype=np.int64)
    np.add.at(passed, K.edge.ravel()[walk], K.sign.ravel()[walk])
    return passed


def _predecessors(graph: csr_array, root: int) -> Ints:
    """The node before each one on the way from the root; neighbours are met in their order."""
    graph.sort_indices()
    return breadth_first_order(graph, root, directed=True, return_predecessors=True)[1]


def _first_per_node(half_edges: Ints, node: NDArray[Any], n: int) -> Ints:
    """For each node the least of the half-edges at it, or -1."""
    first = np.full(n, -1, dtype=np.int64)
    descending = half_edges[::-1]
    first[node[descending]] = descending
    return first


def _climb(parent: Ints, K: DeltaComplex, faces: Ints, loops: Ints) -> tuple[Ints, Ints]:
    """The half-edges passed from each face to the root, with the loop each belongs to."""
    twin = K.twin.ravel()
    passed: list[Ints] = [faces[:0]]
    owner: list[Ints] = [loops[:0]]
    while faces.size:
        half_edge = parent[faces]
        below = half_edge >= 0
        half_edge, loops = half_edge[below], loops[below]
        passed.append(half_edge)
        owner.append(loops)
        faces = twin[half_edge] // 3
    return np.concatenate(owner), np.concatenate(passed)


def _along_sides(K: DeltaComplex, cochains: csr_array, faces: Ints) -> tuple[csr_array, csr_array]:
    """Values along sides 0 (corner 1 to 2) and 2 (corner 0 to 1) of the faces; (faces, k) each."""
    by_edge = cochains.T.tocsr()
    along = []
    for s in (0, 2):
        values = by_edge[K.edge[faces, s]]
        values.data = values.data * np.repeat(K.sign[faces, s], np.diff(values.indptr))
        along.append(values)
    return along[0], along[1]


def _reversed(K: DeltaComplex, walk: list[int]) -> list[int]:
    return [int(K.twin.flat[half_edge]) for half_edge in reversed(walk)]


def _combined(K: DeltaComplex, loops: list[list[int]], coefficients: Ints) -> Ints:
    """Loops with one base point run through one after the other, without passages to and fro."""
    walk: list[int] = []
    for k in np.flatnonzero(coefficients):
        loop = loops[k] if coefficients[k] > 0 else _reversed(K, loops[k])
        for half_edge in loop * int(abs(coefficients[k])):
            if walk and walk[-1] == K.twin.flat[half_edge]:
                walk.pop()
            else:
                walk.append(half_edge)
    first, last = 0, len(walk) - 1
    while first < last and walk[first] == K.twin.flat[walk[last]]:
        first, last = first + 1, last - 1
    return np.array(walk[first : last + 1], dtype=np.int64)
