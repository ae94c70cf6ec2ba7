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
from scipy.sparse import csc_array, csc_matrix, csr_array
from sksparse.cholmod import CholmodNotPositiveDefiniteError, Factor, analyze

from .delta_complex import DeltaComplex
from .errors import ComplexError
from .homology import half_edge_ends
from .linear_forms import LinearForms, blocks, gram_matrix

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SOLVES_AT_ONCE = 32


def edge_ends(K: DeltaComplex) -> tuple[Ints, Ints]:
    """Vertices at which each edge starts and ends; two arrays of shape (n_edges,)."""
    forward = np.flatnonzero(K.sign.ravel() > 0)
    edge = K.edge.ravel()[forward]
    tail, head = np.empty((2, K.n_edges), dtype=np.int64)
    starts, ends = half_edge_ends(K)
    tail[edge], head[edge] = starts[forward], ends[forward]
    return tail, head


def laplacian(K: DeltaComplex, weights: Floats) -> csc_array:
    """The positive semidefinite Laplacian dᵀ ρ d; (n_vertices, n_vertices) sparse.

    Parameters
    ----------
    weights : (n_edges,) float
        ρ, for instance :func:`igl_periods.delta_complex.cotan_weights`.
    """
    lower = _lower_laplacian(K.n_vertices, *edge_ends(K), weights, 0)
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
    k = cochains.shape[0]
    potentials = np.zeros((K.n_vertices, k))
    if K.n_vertices == 1 or k == 0:
        return potentials
    tail, head = edge_ends(K)
    factor = _factored(K.n_vertices, tail, head, weights)
    for start in range(0, k, _SOLVES_AT_ONCE):
        columns = slice(start, min(start + _SOLVES_AT_ONCE, k))
        flux = _outflow(K.n_vertices, tail, head, weights, cochains[columns])
        potentials[1:, columns] = factor(flux[1:])
    return potentials


def factored_laplacian(K: DeltaComplex, weights: Floats) -> Factor:
    """The Cholesky factor of the Laplacian without its row and column 0.

    Raises
    ------
    ComplexError
        If the weights define no positive definite energy.
    """
    return _factored(K.n_vertices, *edge_ends(K), weights)


def _factored(n: int, tail: Ints, head: Ints, weights: Floats) -> Factor:
    grounded = _lower_laplacian(n, tail, head, weights, 1)
    try:
        # Supernodal is L Lᵀ, which fails on matrices that are not positive definite; the
        # simplicial L D Lᵀ would go on.
        factor = analyze(grounded, mode="supernodal", ordering_method="amd")
        factor.cholesky_inplace(grounded)
    except CholmodNotPositiveDefiniteError as error:
        raise ComplexError(
            "the weights define no positive definite energy: the Laplacian is not positive "
            f"definite ({np.count_nonzero(weights < 0)} weights are negative, the least is "
            f"{weights.min():.3g}; {np.count_nonzero(weights == 0)} are zero). With cotangent "
            "weights this means that triangles are too extreme for double precision."
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
    return gram_matrix(LinearForms.of(K, cochains, potentials, face_weights))


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


def _lower_laplacian(n: int, tail: Ints, head: Ints, weights: Floats, first: int) -> csc_matrix:
    """Lower triangle of dᵀ ρ d, from row and column ``first`` on; CHOLMOD reads no more."""
    low, high = np.minimum(tail, head), np.maximum(tail, head)
    # A loop has no difference of f along it, hence no place in the Laplacian.
    if np.any(low == high):
        proper = low < high
        low, high, weights = low[proper], high[proper], weights[proper]
    diagonal = np.bincount(low, weights, n) + np.bincount(high, weights, n)
    if first > 0:
        inner = low >= first
        low, high, weights = low[inner], high[inner], weights[inner]
    rows = np.concatenate([high, np.arange(first, n)]) - first
    columns = np.concatenate([low, np.arange(first, n)]) - first
    values = np.concatenate([-weights, diagonal[first:]])
    return csc_matrix((values, (rows, columns)), shape=(n - first, n - first))


def _outflow(n: int, tail: Ints, head: Ints, weights: Floats, cochains: csr_array) -> Floats:
    """−dᵀ ρ c for each cochain, as columns; (n, k)."""
    support = cochains.tocoo()
    flow = weights[support.col] * support.data
    rows = np.concatenate([tail[support.col], head[support.col]])
    columns = np.concatenate([support.row, support.row])
    k = cochains.shape[0]
    flux = np.bincount(rows * k + columns, np.concatenate([flow, -flow]), n * k)
    return flux.astype(np.float64, copy=False).reshape(n, k)
