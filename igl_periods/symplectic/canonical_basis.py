r"""Symplectic linear algebra: integer bases, the Williamson form, actions on D and Π.

Write :math:`J = \begin{pmatrix} 0 & 1 \\ -1 & 0 \end{pmatrix}` in g × g blocks.  In a canonical
basis α_1..α_g, β_1..β_g of integer cohomology, :math:`\int \alpha_i \wedge \beta_j = \delta_{ij}`,
the energies of the harmonic forms of a Riemann surface with period matrix Π = X + iY are

.. math::

    D = \begin{pmatrix} Y + X Y^{-1} X & -X Y^{-1} \\ -Y^{-1} X & Y^{-1} \end{pmatrix},
    \qquad D J D = J :

D is symmetric, positive definite and symplectic, and such matrices are the same thing as points
of the Siegel upper half-space.

A symmetric positive definite matrix that is not symplectic has the Williamson form
:math:`D = T^T \mathrm{diag}(d, d)\, T` with T symplectic.  The numbers d are its *symplectic
eigenvalues* (the moduli of the eigenvalues of JD), and :math:`G = T^T T` is its *symplectic
mean*, the geometric mean of D and :math:`J D^{-1} J^T`.  Neither depends on the basis.

Integer symplectic matrices act twice: on Π by the Möbius transformation of
:math:`\gamma = \begin{pmatrix} a & b \\ c & d \end{pmatrix}`,
:math:`\gamma \cdot \Pi = (a \Pi + b)(c \Pi + d)^{-1}`, and on the basis of forms, D → U D Uᵀ, by
:math:`U = K \gamma K`, K = diag(1, −1).

References
----------
de Gosson, "Symplectic geometry and quantum mechanics" (2006), section 8.3.
Bhatia, Jain, "On symplectic eigenvalues of positive definite matrices" (2015).
"""

from __future__ import annotations

import flint
import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Ints

from .integer_matrices import product


def standard_form(g: int) -> Ints:
    """The matrix J = [[0, 1], [−1, 0]] in g × g blocks; shape (2g, 2g)."""
    identity = np.eye(g, dtype=np.int64)
    zero = np.zeros_like(identity)
    return np.block([[zero, identity], [-identity, zero]])


def integer_symplectic_basis(M: NDArray[np.integer]) -> NDArray[np.int8]:
    """An integer matrix T with ``T M Tᵀ = J``, for the pairing M of tree–cotree cochains.

    Symplectic Gram–Schmidt: split off a pair (a, b) with M_ab = ±1 and make everything else
    orthogonal to both, a rank-2 update of the matrix; g times.

    The cochains of a tree–cotree decomposition are the letters of a one-vertex map, and a union
    of some of its bands is a surface with one or more boundaries.  Therefore every principal
    minor of M is 0 or 1, so that M, all its Schur complements and T have entries 0 and ±1: a
    pivot ±1 always exists and nothing can grow.  Taking sparse rows first keeps them sparse.

    Parameters
    ----------
    M : (2g, 2g) int
        Skew, with all principal minors 0 or 1.

    Returns
    -------
    (2g, 2g) int8
        Rows α_1..α_g, β_1..β_g.

    Raises
    ------
    ValueError
        If M is not unimodular, or has a pivot other than ±1.
    """
    size = len(M)
    rest, T = M.astype(np.int8), np.eye(size, dtype=np.int8)
    count = np.count_nonzero(rest, axis=1)
    alphas: list[int] = []
    betas: list[int] = []
    for _ in range(size // 2):
        a = int(np.argmin(np.where(count > 0, count, size + 1)))
        neighbours = np.flatnonzero(rest[a])
        if neighbours.size == 0:
            raise ValueError(f"the pairing is degenerate: its rank is {2 * len(alphas)} of {size}.")
        b = int(neighbours[np.argmin(count[neighbours])])
        if abs(rest[a, b]) != 1:
            raise ValueError(
                f"the pairing has the pivot {rest[a, b]}; cotree cochains have ±1 only."
            )
        if rest[a, b] < 0:
            T[b], rest[b], rest[:, b] = -T[b], -rest[b], -rest[:, b]
        _split_off(rest, T, count, a, b)
        alphas.append(a)
        betas.append(b)
    return T[alphas + betas]


def _split_off(M: NDArray[np.int8], T: NDArray[np.int8], count: Ints, a: int, b: int) -> None:
    """Make all rows but a and b orthogonal to both, in place."""
    row_a, row_b = M[a].copy(), M[b].copy()
    row_a[b] = row_b[a] = 0
    rest = np.flatnonzero(row_a | row_b)
    to_a, to_b = row_b[rest, None], row_a[rest, None]
    support = np.flatnonzero(T[a] | T[b])
    T[np.ix_(rest, support)] += to_a * T[a, support] - to_b * T[b, support]
    M[np.ix_(rest, rest)] += to_a * row_a[rest] - to_b * row_b[rest]
    M[[a, b]], M[:, [a, b]] = 0, 0
    count[rest] = np.count_nonzero(M[rest], axis=1)
    count[[a, b]] = 0


def is_symplectic(U: NDArray[np.integer], M: NDArray[np.integer] | None = None) -> bool:
    """Whether ``U M Uᵀ = J`` exactly (M = J where it is not given)."""
    g = len(U) // 2
    if U.shape != (2 * g, 2 * g):
        return False
    A = np.asarray(U, dtype=np.int64)
    form = standard_form(g) if M is None else np.asarray(M, dtype=np.int64)
    try:
        if M is not None:
            return np.array_equal(product(product(A, form), A.T), standard_form(g))
        # U J Uᵀ is the difference of one product and its transpose.
        half = product(A[:, :g], A[:, g:].T)
        if np.abs(half).max(initial=0) < 2**62:
            return np.array_equal(half - half.T, standard_form(g))
    except OverflowError:
        pass
    return _is_symplectic_in_flint(A, form)


def _is_symplectic_in_flint(U: Ints, M: Ints) -> bool:
    """The same for integers of any size."""
    left = flint.fmpz_mat(U.tolist())
    form = flint.fmpz_mat(standard_form(len(U) // 2).tolist())
    return bool(left * flint.fmpz_mat(M.tolist()) * left.transpose() == form)


def form_action(gamma: NDArray[np.integer]) -> Ints:
    """The change U = K γ K of the basis of forms that acts on Π as the Möbius map of γ."""
    g = len(gamma) // 2
    flip = np.r_[np.ones(g, dtype=np.int64), -np.ones(g, dtype=np.int64)]
    return np.asarray(flip[:, None] * gamma * flip, dtype=np.int64)
