r"""The functions f with L f = −dᵀ ρ c, for which c + df is harmonic.

The Laplacian is singular: its kernel are the constants.  It is *grounded*, row and column 0 left
out, and f is 0 at vertex 0.  A complex with one vertex has nothing to solve.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse import csc_array, csr_array, csr_matrix

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, edge_ends
from igl_periods.errors import ComplexError, NotPositiveDefiniteError

from .cholmod import CholeskyFactor, factor, solve
from .laplace_matrix import grounded_laplacian, outflow


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
    if cochains.shape[0] == 0:
        return np.zeros(sources.shape)
    return solutions(factored_laplacian(K, weights), sources)


def solutions(grounded: CholeskyFactor, sources: Floats | csc_array) -> Floats:
    """The functions f, 0 at vertex 0, with L f = ``sources`` elsewhere; (n_vertices, k).

    Parameters
    ----------
    grounded : CholeskyFactor
        Of the grounded Laplacian, :func:`factored_laplacian`.
    sources : (n_vertices, k) float
        Sparse or dense.
    """
    potentials = np.zeros(sources.shape)
    solve(grounded, sources[1:], out=potentials[1:])
    return potentials


def factored_laplacian(K: DeltaComplex, weights: Floats) -> CholeskyFactor:
    """The Cholesky factor of the grounded Laplacian of given weights.

    Raises
    ------
    ComplexError
        If the weights define no positive definite energy.
    """
    return factored(grounded_laplacian(K, weights))


def factored(grounded: csr_matrix) -> CholeskyFactor:
    """The Cholesky factor of a grounded Laplacian.

    Raises
    ------
    ComplexError
        If it is not positive definite.
    """
    try:
        return factor(grounded)
    except NotPositiveDefiniteError as error:
        weights = -sparse.tril(grounded, -1).data
        raise ComplexError(
            "the weights define no positive definite energy: the Laplacian is not positive "
            f"definite (without vertex 0, {np.count_nonzero(weights < 0)} weights between vertices "
            f"are negative, the least is {weights.min(initial=0.0):.3g}; "
            f"{np.count_nonzero(weights == 0)} are zero). With cotangent weights this means that "
            "triangles are too extreme for double precision."
        ) from error
