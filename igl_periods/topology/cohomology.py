r"""Homology of a closed surface over the integers, from a tree and a cotree.

A spanning tree of the vertices, and a spanning tree of the faces that crosses none of its edges,
leave 2g edges over (Eppstein 2003).  Each of them closes two loops: one of vertices, along the
tree, and one of faces, along the cotree.  The signed crossing numbers c_k of the k-th loop of
faces with the edges form a closed integer cochain, and c_k takes the value δ_kl on the l-th loop
of vertices.  So the cochains are a basis of integer cohomology, and the loops its dual basis.

The pairing of closed cochains,

.. math:: \int \alpha \wedge \beta
          = \tfrac12 \sum_{\text{faces}} (\alpha_{01} \beta_{12} - \alpha_{12} \beta_{01}),

is integer, skew and unimodular; :func:`~igl_periods.symplectic.integer_symplectic_basis` turns the
c_k into a canonical basis α_1..α_g, β_1..β_g with ∫ α_i ∧ β_j = δ_ij and all other pairings 0.  The
canonical cycles a_1..a_g, b_1..b_g are the dual basis, :math:`\oint_{a_j} \alpha_i = \delta_{ij} =
\oint_{b_j} \beta_i`, with intersection numbers a_i · b_j = δ_ij.

Everything here is exact, and deterministic: the same complex always gets the same basis.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Eppstein, "Dynamic generators of topologically embedded graphs" (2003).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Ints
from igl_periods.complexes import (
    DeltaComplex,
    MarkedComplex,
    check_closed_and_oriented,
    of_a_surface,
)
from igl_periods.errors import ComplexError
from igl_periods.symplectic import integer_symplectic_basis, standard_form

from .spanning_trees import TreeCotree, tree_cotree


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
    faces = np.unique(np.flatnonzero(touched[K.edge.ravel()]) // 3)
    alpha_12, alpha_01 = _along_sides(K, alpha, faces)
    beta_12, beta_01 = _along_sides(K, beta, faces)
    twice = (alpha_01.T @ beta_12 - alpha_12.T @ beta_01).toarray()
    if np.any(twice % 2):
        raise ComplexError("the cochains are not closed: their pairing is not an integer.")
    return twice // 2


@of_a_surface
def cohomology_basis(K: DeltaComplex, root: int = 0) -> csr_array:
    """A canonical basis of integer cohomology.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected.
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

    Examples
    --------
    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> ip.cohomology_basis(K).shape == (2 * K.genus, K.n_edges)
    True
    """
    cochains, T = cochains_and_basis(K, root)
    return (csr_array(T.astype(np.int64)) @ cochains).tocsr()


def mark(K: DeltaComplex, root: int = 0) -> MarkedComplex:
    """The complex with the cochains of its cotree and the matrix that makes them canonical.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected.
    """
    return MarkedComplex(K, *cochains_and_basis(K, root))


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
