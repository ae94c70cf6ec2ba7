r"""Energies D and period matrices Π: the Williamson form and the symplectic mean.

A symmetric positive definite D has the Williamson form :math:`D = T^T \operatorname{diag}(d, d)\,
T` with T symplectic.  With a Cholesky factor D = L Lᵀ the skew matrix LᵀJL has the eigenvalues ±i
d_k; its singular pairs give T.  :math:`G = T^T T` is the symplectic mean, and its blocks are those
of a Siegel point Π = X + iY (:mod:`igl_periods.symplectic`).

References
----------
de Gosson, "Symplectic geometry and quantum mechanics" (2006), section 8.3.
Bhatia, Jain, "On symplectic eigenvalues of positive definite matrices" (2015).
"""

from __future__ import annotations

import numpy as np
import scipy.linalg
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

from igl_periods.arrays import Floats
from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.machine import threads_by_size


def williamson_basis(R: Floats) -> Floats:
    """Coefficients of forms x_i, y_i in terms of the given ones, of energy D = R Rᵀ; (g, 2, 2g).

    x_i D x_jᵀ = y_i D y_jᵀ = d_i δ_ij, x_i J y_jᵀ = δ_ij, all other products are 0, d decreasing.
    """
    g = len(R) // 2
    if g == 0:
        return np.zeros((0, 2, 0))
    A = R[:g].T @ R[g:]
    # i (A − Aᵀ) is Hermitian with the eigenvalues ±d; an eigenvector u + i v of d spans with its
    # conjugate the plane on which the form RᵀJR is d times a quarter turn.
    d, W = np.linalg.eigh(1j * (A - A.T))
    d, W = d[: g - 1 : -1], np.sqrt(2.0) * W[:, : g - 1 : -1]
    pairs = np.sqrt(d)[:, None, None] * np.stack([W.imag.T, W.real.T], axis=1)
    return np.asarray(
        scipy.linalg.solve_triangular(R, pairs.reshape(2 * g, -1).T, lower=True, trans=1).T
    ).reshape(g, 2, 2 * g)


# Singular values are computed from squares while these spread over no more than this.
_LEAST_SQUARE = 1e-3


def energy_matrix(Pi: NDArray[np.complex128]) -> Floats:
    """The Dirichlet matrix D of a Riemann surface with period matrix Π; shape (2g, 2g)."""
    X, Y = Pi.real, Pi.imag
    inverse = _definite_inverse(Y)
    XY = X @ inverse
    return np.block([[Y + XY @ X.T, -XY], [-XY.T, inverse]])


@threads_by_size
def siegel_point(G: Floats) -> NDArray[np.complex128]:
    """The period matrix Π = X + iY of a symplectic Dirichlet matrix: Y = G_bb⁻¹, X = −G_ab Y.

    In a marking in which some cycles are much longer than others, G is far from round, and only
    its Cholesky factors keep the digits that it has, whatever the scale of its rows.  With the b
    first, G = L Lᵀ, they are Y = (L_bb L_bbᵀ)⁻¹ and X = −L_ab L_bb⁻¹.
    """
    g = len(G) // 2
    L = cholesky_factor(np.roll(G, g, axis=(0, 1)))
    inverse = solve_triangular(L[:g, :g], np.eye(g), lower=True)
    return _symmetric(-L[g:, :g] @ inverse) + 1j * _symmetric(inverse.T @ inverse)


def williamson(D: Floats) -> tuple[Floats, Floats]:
    """Symplectic eigenvalues and symplectic mean of a positive definite matrix.

    With D = R Rᵀ (Cholesky), the singular values of the skew matrix A = Rᵀ J R are the symplectic
    eigenvalues, each twice, and :math:`G = R (A^T A)^{-1/2} R^T`.

    Parameters
    ----------
    D : (2g, 2g) float
        Symmetric, positive definite.

    Returns
    -------
    d : (g,) float
        Symplectic eigenvalues, decreasing.
    G : (2g, 2g) float
        Symmetric, positive definite, symplectic.

    Raises
    ------
    NotPositiveDefiniteError
        If D is not positive definite.
    """
    return williamson_of_factor(cholesky_factor(D))


@threads_by_size
def williamson_of_factor(R: Floats) -> tuple[Floats, Floats]:
    """The same, as :func:`williamson`, for D = R Rᵀ with R lower triangular."""
    g = len(R) // 2
    if g == 0:
        return np.zeros(0), np.zeros((0, 0))
    A = R[:g].T @ R[g:]
    d, Q = _singular_pairs(A - A.T)
    root = R @ (Q / np.sqrt(d))
    return d[::-2], _symmetric(root @ root.T)


def _singular_pairs(A: Floats) -> tuple[Floats, Floats]:
    """Singular values of a skew matrix, increasing, and right singular vectors as columns."""
    # The eigenvalues come in pairs.  Divide and conquer keeps their vectors orthogonal to rounding;
    # LAPACK's default for symmetric matrices loses two digits there, and is slower.
    squares, Q = scipy.linalg.eigh(A.T @ A, driver="evd")
    if squares[0] > _LEAST_SQUARE * squares[-1]:
        return np.sqrt(squares), Q
    # Squaring would lose the small ones.
    _, d, Qt = np.linalg.svd(A)
    return d[::-1], Qt[::-1].T


@threads_by_size
def cholesky_factor(D: Floats) -> Floats:
    """The lower triangular R with D = R Rᵀ.

    Raises
    ------
    NotPositiveDefiniteError
    """
    try:
        return np.asarray(np.linalg.cholesky(D), dtype=np.float64)
    except np.linalg.LinAlgError as error:
        least = float(np.linalg.eigvalsh(D)[0]) if np.isfinite(D).all() else float("nan")
        raise NotPositiveDefiniteError(
            f"not positive definite (least eigenvalue {least:.3g}, trace {np.trace(D):.3g})"
        ) from error


def _symmetric(A: Floats) -> Floats:
    return 0.5 * (A + A.T)


def _definite_inverse(A: Floats) -> Floats:
    inverse = solve_triangular(cholesky_factor(A), np.eye(len(A)), lower=True)
    return np.asarray(inverse.T @ inverse, dtype=np.float64)
