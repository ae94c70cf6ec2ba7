r"""Harmonic forms and their Dirichlet matrix.

The harmonic representative of a cohomology class c is the cochain ω = c + df of least energy
:math:`\sum_e \rho(e)\, \omega(e)^2`; f solves the Laplace equation

.. math:: L f = -d^T \rho\, c, \qquad L = d^T \rho\, d .

L is the same for every class: it is factored once, and solved for all of them.  The *Dirichlet
matrix* :math:`D_{ij} = \sum_e \rho(e)\, \omega_i(e)\, \omega_j(e)` of a basis of cohomology is
the only number the period matrix needs.

With cotangent weights the energy of ω is that of a closed differential form on the surface itself,
constant on every triangle.  D is evaluated as the Gram matrix of these constant gradients, face
by face: a sum of squares of explicit forms c + df.  So it is the energy matrix of forms in the
right cohomology classes whatever the solver did to f, and by Dirichlet's principle it is never
below the exact one; an error of f enters it at second order.  (Expressions like
:math:`c^T \rho c - z^T z` are equal to it only for an exact solution, and can fall below.)

The forms of the paper on the dual graph need no second solve: harmonic forms on Γ* are Hodge
stars of those on Γ, and their energies are :math:`J D^{-1} J^T`.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Chen, Davis, Hager, Rajamanickam, "Algorithm 887: CHOLMOD" (2008).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csc_array, csc_matrix, csr_array
from sksparse.cholmod import CholmodNotPositiveDefiniteError, Factor, analyze

from .delta_complex import DeltaComplex
from .errors import ComplexError
from .gluing import index_type, next_corner
from .linear_forms import Jumps, LinearForms, WeightedFaces, blocks, gram_matrix
from .memory import release_freed_memory
from .stages import progress

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SOLVES_AT_ONCE = 32
# From so many unknowns on, memory is put in order before it is filled.
_LARGE = 100_000


def edge_ends(K: DeltaComplex) -> tuple[Ints, Ints]:
    """Vertices at which each edge starts and ends; two arrays of shape (n_edges,)."""
    forward = np.flatnonzero(K.sign.ravel() > 0)
    edge = K.edge.ravel()[forward]
    corners = K.corner_vertex.ravel()
    tail, head = np.empty((2, K.n_edges), dtype=np.int64)
    tail[edge], head[edge] = corners[next_corner(forward)], corners[next_corner(forward, 2)]
    return tail, head


def laplacian(K: DeltaComplex, weights: Floats) -> csc_array:
    """The positive semidefinite Laplacian dᵀ ρ d; (n_vertices, n_vertices) sparse.

    Parameters
    ----------
    weights : (n_edges,) float
        ρ, for instance :func:`igl_periods.delta_complex.cotan_weights`.
    """
    lower = lower_laplacian(K.n_vertices, *edge_ends(K), weights, 0)
    strict = lower.copy()
    strict.setdiag(0.0)
    return csc_array(lower + strict.T)


def harmonic_potentials(K: DeltaComplex, weights: Floats, cochains: csr_array) -> Floats:
    """The functions f for which the cochains c + df are harmonic.

    Parameters
    ----------
    weights : (n_edges,) float
    cochains : (k, n_edges) sparse
        Closed.

    Returns
    -------
    (n_vertices, k) float
        0 at vertex 0.

    Raises
    ------
    ComplexError
        If the weights define no positive definite energy.
    """
    tail, head = edge_ends(K)
    sources = outflow(K.n_vertices, tail, head, weights, cochains)
    return solutions(factored_laplacian(K, weights) if cochains.shape[0] else None, sources)


def solutions(factor: Factor | None, sources: csc_array) -> Floats:
    """The functions f, 0 at vertex 0, with L f = ``sources`` elsewhere.

    Parameters
    ----------
    factor : Factor or None
        Of the grounded Laplacian, :func:`factorised`.
    sources : (n_vertices, k) sparse float
    """
    n, k = sources.shape
    potentials = np.zeros((n, k))
    if factor is None:
        return potentials
    for start in range(0, k, _SOLVES_AT_ONCE):
        progress("equations", start, k)
        columns = slice(start, min(start + _SOLVES_AT_ONCE, k))
        potentials[1:, columns] = factor(sources[1:, columns].toarray(order="F"))
    return potentials


def factored_laplacian(K: DeltaComplex, weights: Floats) -> Factor | None:
    """The Cholesky factor of the Laplacian without its row and column 0; see :func:`factorised`.

    Raises
    ------
    ComplexError
        If the weights define no positive definite energy.
    """
    return factorised(grounded_laplacian(K, weights))


def factorised(grounded: csc_matrix) -> Factor | None:
    """The Cholesky factor of a grounded Laplacian; None where one vertex leaves nothing to factor.

    Raises
    ------
    ComplexError
        If it is not positive definite.
    """
    if grounded.shape[0] == 0:
        return None
    tidy = release_freed_memory if grounded.shape[0] > _LARGE else lambda: None
    tidy()
    # Supernodal is L Lᵀ, which fails on matrices that are not positive definite; the simplicial
    # L D Lᵀ would go on.
    factor = analyze(grounded, mode="supernodal", ordering_method="amd")
    tidy()
    try:
        factor.cholesky_inplace(grounded)
    except CholmodNotPositiveDefiniteError as error:
        weights = -sparse.tril(grounded, -1).data
        raise ComplexError(
            "the weights define no positive definite energy: the Laplacian is not positive "
            f"definite (without vertex 0, {np.count_nonzero(weights < 0)} weights between vertices "
            f"are negative, the least is {weights.min(initial=0.0):.3g}; "
            f"{np.count_nonzero(weights == 0)} are zero). With cotangent weights this means that "
            "triangles are too extreme for double precision."
        ) from error
    return factor


def dirichlet_matrix(
    K: DeltaComplex, cochains: csr_array, potentials: Floats, face_weights: Floats | None = None
) -> Floats:
    """Energies of the piecewise constant forms c + df on the polyhedral surface; (k, k).

    A sum of squares of gradients over all faces (or those of positive ``face_weights``, each
    counted with its weight), never a difference.

    Parameters
    ----------
    cochains : (k, n_edges) sparse
        Closed.
    potentials : (n_vertices, k) float
        Any functions; the harmonic ones give the least energies.
    face_weights : (m,) float, optional
    """
    faces = WeightedFaces.of(K, face_weights)
    return gram_matrix(LinearForms(faces, Jumps.of(K, cochains, face_weights), potentials))


def weighted_energies(
    K: DeltaComplex, weights: Floats, cochains: csr_array, potentials: Floats
) -> Floats:
    """The matrix Σ_e ρ(e) ω_i(e) ω_j(e) of the cochains ω = c + df; (k, k).

    For weights that are no energy on a surface (extrinsic or abstract ones); no bound rests on it.
    """
    k = cochains.shape[0]
    D = np.zeros((k, k))
    tail, head = edge_ends(K)
    by_edge = cochains.T.tocsr()
    for block in blocks(K.n_edges, k):
        forms = by_edge[block].toarray() + (potentials[head[block]] - potentials[tail[block]])
        D += forms.T @ (weights[block, None] * forms)
    return 0.5 * (D + D.T)


def grounded_laplacian(K: DeltaComplex, weights: Floats) -> csc_matrix:
    """Lower triangle of the Laplacian without row and column 0; CHOLMOD reads no more."""
    return lower_laplacian(K.n_vertices, *edge_ends(K), weights, 1)


def lower_laplacian(n: int, tail: Ints, head: Ints, weights: Floats, first: int) -> csc_matrix:
    """Lower triangle of dᵀ ρ d, from row and column ``first`` on.

    Parameters
    ----------
    n : int
        Number of vertices.
    tail, head : (n_edges,) int
        :func:`edge_ends`.
    """
    low, high = np.minimum(tail, head), np.maximum(tail, head)
    # A loop has no difference of f along it, hence no place in the Laplacian.
    if np.any(low == high):
        proper = low < high
        low, high, weights = low[proper], high[proper], weights[proper]
    diagonal = np.bincount(low, weights, n) + np.bincount(high, weights, n)
    if first > 0:
        inner = low >= first
        low, high, weights = low[inner], high[inner], weights[inner]
    index = index_type(n)
    all_vertices = np.arange(first, n, dtype=index)
    rows = np.concatenate([high.astype(index), all_vertices]) - first
    columns = np.concatenate([low.astype(index), all_vertices]) - first
    values = np.concatenate([-weights, diagonal[first:]])
    return csc_matrix((values, (rows, columns)), shape=(n - first, n - first))


def outflow(n: int, tail: Ints, head: Ints, weights: Floats, cochains: csr_array) -> csc_array:
    """−dᵀ ρ c for each cochain, as columns; (n, k) sparse."""
    support = cochains.tocoo()
    flow = weights[support.col] * support.data
    rows = np.concatenate([tail[support.col], head[support.col]])
    columns = np.concatenate([support.row, support.row])
    values = np.concatenate([flow, -flow])
    return csc_array((values, (rows, columns)), shape=(n, cochains.shape[0]))
