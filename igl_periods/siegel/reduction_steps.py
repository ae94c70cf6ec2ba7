r"""The steps of Siegel reduction: what is done to Π, and the modular transformation that does it.

A lattice step is :math:`\Pi \to U \Pi U^T - S`, U unimodular such that U Y Uᵀ is LLL-reduced, and S
integer and symmetric such that the real part gets at most ½.  It leaves det Y as it is.

An inversion step is a run of quasi-inversions,

.. math:: \Pi_{jj} \to -1/\Pi_{jj}, \quad \Pi_{ij} \to \Pi_{ij} / \Pi_{jj}, \quad
          \Pi_{ik} \to \Pi_{ik} - \Pi_{ij} \Pi_{jk} / \Pi_{jj},

each at the least |Π_jj| < 1, with shifts after it.  Each multiplies det Y by |Π_jj|⁻² > 1.

The transformations are exact.  The points are moved in floating point, and good for choosing the
next step.  A lattice step is O(g³), a quasi-inversion O(g²).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.errors import NotASiegelPointError, NotPositiveDefiniteError
from igl_periods.run_log import progress
from igl_periods.symplectic import product, unimodular_inverse

from .lll import is_lll_reduced, lll_basis, shortest_first

# |Π_jj| ≥ 1 − ε and |Re Π| ≤ ½ + ε count as reduced.
_EPSILON = 1e-12
# Up to this genus a shortest vector is put first; above it the LLL basis is taken as it is.
_SHORTEST_VECTOR_GENUS = 8
# Integers above this end a run of quasi-inversions in floating point.
_LARGE = 1e6
# Up to this genus quasi-inversions are made one by one.  Above it so many are made before the whole
# matrix is changed and shifted.
SMALL_GENUS = 16
_AT_ONCE = 32
# What is reduced up to this needs no other start, only a few more steps.
_NEARLY = 1e-6


class Step(NamedTuple):
    """A modular transformation, and the matrix moved by it in floating point.

    ``point`` is None where that has lost so many digits that it has to be computed anew.
    """

    point: Complexes | None
    gamma: Ints

    @property
    def idle(self) -> bool:
        """Whether there was nothing to do."""
        return np.array_equal(self.gamma, np.eye(len(self.gamma), dtype=np.int64))


def lattice_step(Pi: Complexes) -> Step:
    """γ = [[U, −S U⁻ᵀ], [0, U⁻ᵀ]]: reduce the lattice of Im Π, then shift Re Π."""
    g = len(Pi)
    try:
        U = shortest_first(Pi.imag) if g <= _SHORTEST_VECTOR_GENUS else lll_basis(Pi.imag)
    except NotPositiveDefiniteError as error:
        raise NotASiegelPointError(
            f"the imaginary part is {error}: the matrix is too close to the boundary of the Siegel "
            "upper half-space"
        ) from error
    dual = unimodular_inverse(U).T
    X, Y = U @ Pi.real @ U.T, U @ Pi.imag @ U.T
    S = _integer_part(X)
    zero = np.zeros((g, g), dtype=np.int64)
    gamma = np.block([[U, exact_product(-S, dual) if S.any() else zero], [zero, dual]])
    return Step(_symmetric(X - S) + 1j * _symmetric(Y), gamma)


def inversion_step(Pi: Complexes, most: int) -> Step:
    """Up to ``most`` quasi-inversions at indices with |Π_jj| < 1, smallest first, and shifts."""
    g, done = len(Pi), 0
    moved = Pi.copy()
    # Small integers, kept in floating point for the sake of fast products.
    upper, lower = np.split(np.eye(2 * g), 2)
    at_once = 1 if g <= SMALL_GENUS else _AT_ONCE
    good = True
    while g and good and done < most:
        count = _quasi_invert(moved, upper, lower, min(at_once, most - done))
        if count == 0:
            break
        done += count
        good = _shift(moved, upper, lower)
        progress("quasi-inversions", done)
    point = _symmetric(moved.real) + 1j * _symmetric(moved.imag)
    return Step(point if good else None, np.vstack([upper, lower]).astype(np.int64))


def is_nearly_reduced(Pi: Complexes) -> bool:
    """Whether Π is what Siegel reduction promises, up to 1e-6."""
    return bool(
        np.abs(Pi.real).max(initial=0.0) <= 0.5 + _NEARLY
        and np.abs(np.diagonal(Pi)).min(initial=1.0) >= 1.0 - _NEARLY
        and is_lll_reduced(Pi.imag, _NEARLY)
    )


def _quasi_invert(Pi: Complexes, upper: Floats, lower: Floats, most: int) -> int:
    r"""Up to ``most`` quasi-inversions, each with a shift of the diagonal; in place.  How many.

    With c the column j of Π and p = Π_jj, a quasi-inversion is a change of rank one outside the
    diagonal, :math:`\Pi \to \Pi - w w^T / p`, where w is c with p − 1 at j.  So the columns to come
    follow from those before, and Π itself, but for its diagonal, is changed at the end only.
    """
    diagonal = np.diagonal(Pi).copy()
    W = np.empty((most, len(Pi)), dtype=np.complex128)
    quotients, count = np.empty_like(W), 0
    while count < most:
        j = int(np.argmin(np.abs(diagonal)))
        pivot = diagonal[j]
        if abs(pivot) >= 1 - _EPSILON:
            break
        w = Pi[:, j] - quotients[:count, j] @ W[:count]
        w[j] = pivot - 1
        W[count], quotients[count] = w, w / pivot
        diagonal -= w * quotients[count]
        diagonal[j] = -1 / pivot
        upper[j], lower[j] = -lower[j], upper[j].copy()
        count += 1
        (rows,) = np.nonzero(np.abs(diagonal.real) > 0.5 + _EPSILON)
        S = np.rint(diagonal.real[rows])
        if _is_large(S, lower):
            break
        diagonal[rows] -= S
        upper[rows] -= S[:, None] * lower[rows]
    Pi -= quotients[:count].T @ W[:count]
    np.fill_diagonal(Pi, diagonal)
    return count


def _shift(Pi: Complexes, upper: Floats, lower: Floats) -> bool:
    """Take the integer part off Re Π, in place; False, and nothing is done, if it is too large."""
    rows, columns, S = _sparse_integer_part(Pi.real)
    if _is_large(S, lower):
        return False
    Pi[rows, columns] -= S
    moved = np.unique(rows)
    upper[moved] -= csr_array((S, (rows, columns)), shape=Pi.shape)[moved] @ lower
    return True


def _is_large(S: Floats, lower: Floats) -> bool:
    """Whether a shift is so large that digits of Π were lost: then exact values are needed."""
    return bool(len(lower) * np.abs(S).max(initial=0.0) * np.abs(lower).max() > _LARGE)


def _sparse_integer_part(X: Floats) -> tuple[Ints, Ints, Floats]:
    """Rows, columns and values of the symmetric S with |X − S| ≤ ½, where it is not 0."""
    rows, columns = np.nonzero(np.abs(X) > 0.5 + _EPSILON)
    above = rows <= columns
    rows, columns = rows[above], columns[above]
    S = np.rint(X[rows, columns])
    off = rows < columns
    return (
        np.concatenate([rows, columns[off]]),
        np.concatenate([columns, rows[off]]),
        np.concatenate([S, S[off]]),
    )


def _integer_part(X: Floats) -> Ints:
    """The integer symmetric S with |X − S| ≤ ½, 0 where |X| ≤ ½ + ε already."""
    if X.size and np.abs(X).max() >= 2.0**62:
        raise NotASiegelPointError(
            f"the real part reaches {float(np.abs(X).max()):.3g} in the course of the reduction, "
            "which no 64-bit integers shift back: it is as large from the beginning, or the matrix "
            "is close to the boundary of the half-space"
        )
    S = np.where(np.abs(X) > 0.5 + _EPSILON, np.rint(X), 0.0).astype(np.int64)
    return np.triu(S) + np.triu(S, 1).T


def _symmetric(A: Floats) -> Floats:
    return 0.5 * (A + A.T)


def exact_product(A: Ints, B: Ints) -> Ints:
    """The exact product of integer matrices, or an error where it does not fit into 64 bits."""
    try:
        return product(A, B)
    except OverflowError as error:
        raise NotASiegelPointError(
            "the modular transformation does not fit into 64-bit integers: the matrix is too "
            "close to the boundary of the Siegel upper half-space"
        ) from error
