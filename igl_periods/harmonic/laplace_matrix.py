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
from scipy.sparse import csc_array, csr_array, csr_matrix

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, edge_ends, index_type


def laplacian(K: DeltaComplex, weights: Floats) -> csc_array:
    """The positive semidefinite Laplacian dᵀ ρ d; (n_vertices, n_vertices) sparse.

    Parameters
    ----------
    weights : (n_edges,) float
        ρ, for instance :func:`igl_periods.complexes.weights.cotan_weights`.
    """
    lower = lower_laplacian(K.n_vertices, *edge_ends(K), weights, 0)
    strict = lower.copy()
    strict.setdiag(0.0)
    return csc_array(lower + strict.T)


def grounded_laplacian(K: DeltaComplex, weights: Floats) -> csr_matrix:
    """Lower triangle of the Laplacian without row and column 0; CHOLMOD reads no more."""
    return lower_laplacian(K.n_vertices, *edge_ends(K), weights, 1)


def lower_laplacian(n: int, tail: Ints, head: Ints, weights: Floats, first: int) -> csr_matrix:
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
    return csr_matrix((values, (rows, columns)), shape=(n - first, n - first))


def outflow(n: int, tail: Ints, head: Ints, weights: Floats, cochains: csr_array) -> csc_array:
    """−dᵀ ρ c for each cochain, as columns; (n, k) sparse."""
    support = cochains.tocoo()
    flow = weights[support.col] * support.data
    rows = np.concatenate([tail[support.col], head[support.col]])
    columns = np.concatenate([support.row, support.row])
    values = np.concatenate([flow, -flow])
    return csc_array((values, (rows, columns)), shape=(n, cochains.shape[0]))
