r"""The steps of Siegel reduction: what is done to Π, and the modular transformation that does it.

A lattice step is :math:`\Pi \to U \Pi U^T - S`, U unimodular such that U Y Uᵀ is LLL-reduced, and S
integer and symmetric such that the real part gets at most ½.  It leaves det Y as it is.

An inversion step is a run of quasi-inversions, :math:`\Pi_{jj} \to -1/\Pi_{jj}`,
:math:`\Pi_{ij} \to \Pi_{ij} / \Pi_{jj}`,
:math:`\Pi_{ik} \to \Pi_{ik} - \Pi_{ij} \Pi_{jk} / \Pi_{jj}`, each at the least |Π_jj| < 1 and with a
shift after it.  Each multiplies det Y by |Π_jj|⁻² > 1.

The transformations are exact.  The points are moved in floating point, and good for choosing the
next step.  A lattice step is O(g³), a quasi-inversion O(g²).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from .errors import NotASiegelPointError
from .integer_matrices import product, unimodular_inverse
from .lattice import lll_basis, shortest_first
from .stages import progress

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Complexes = NDArray[np.complex128]

# |Π_jj| ≥ 1 − ε and |Re Π| ≤ ½ + ε count as reduced.
_EPSILON = 1e-12
# Up to this genus a shortest vector is put first; above it the LLL basis is taken as it is.
_SHORTEST_VECTOR_GENUS = 8
# Integers above this end a run of quasi-inversions in floating point.
_LARGE = 1e6


class Step(NamedTuple):
    """A modular transformation, and the matrix moved by it in floating point."""

    point: Complexes
    gamma: Ints

    @property
    def idle(self) -> bool:
        """Whether there was nothing to do."""
        return np.array_equal(self.gamma, np.eye(len(self.gamma), dtype=np.int64))


def lattice_step(Pi: Complexes) -> Step:
    """γ = [[U, −S U⁻ᵀ], [0, U⁻ᵀ]]: reduce the lattice of Im Π, then shift Re Π."""
    g = len(Pi)
    U = shortest_first(Pi.imag) if g <= _SHORTEST_VECTOR_GENUS else lll_basis(Pi.imag)
    dual = unimodular_inverse(U).T
    X, Y = U @ Pi.real @ U.T, U @ Pi.imag @ U.T
    S = _integer_part(X)
    gamma = np.block(
        [[U, exact_product(-S, dual)], [np.zeros((g, g), dtype=np.int64), dual]]
    )
    return Step(_symmetric(X - S) + 1j * _symmetric(Y), gamma)


def inversion_step(Pi: Complexes, most: int) -> Step:
    """Up to ``most`` quasi-inversions at indices with |Π_jj| < 1, smallest first, and shifts."""
    g = len(Pi)
    X, Y = Pi.real.copy(), Pi.imag.copy()
    # Small integers, kept in floating point for the sake of fast products.
    upper, lower = np.split(np.eye(2 * g), 2)
    for count in range(most):
        size = np.hypot(np.diagonal(X), np.diagonal(Y))
        j = int(np.argmin(size)) if g else 0
        if not g or size[j] >= 1 - _EPSILON:
            break
        _quasi_invert(X, Y, j)
        upper[j], lower[j] = -lower[j], upper[j].copy()
        rows, columns, S = _sparse_integer_part(X)
        # A large shift means that digits of Π were lost: start again from exact values.
        if g * np.abs(S).max(initial=0.0) * np.abs(lower).max() > _LARGE:
            break
        X[rows, columns] -= S
        moved = np.unique(rows)
        upper[moved] -= csr_array((S, (rows, columns)), shape=(g, g))[moved] @ lower
        progress("quasi-inversions", count + 1)
    return Step(_symmetric(X) + 1j * _symmetric(Y), np.vstack([upper, lower]).astype(np.int64))


def _quasi_invert(X: Floats, Y: Floats, j: int) -> None:
    """The quasi-inversion of Π = X + iY at j; in place."""
    column = X[:, j] + 1j * Y[:, j]
    pivot = column[j]
    quotient = column / pivot
    parts = np.column_stack([column.real, column.imag])
    X -= parts @ np.stack([quotient.real, -quotient.imag])
    Y -= parts @ np.stack([quotient.imag, quotient.real])
    quotient[j] = -1 / pivot
    X[:, j] = X[j] = quotient.real
    Y[:, j] = Y[j] = quotient.imag


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
            f"the real part reaches {float(np.abs(X).max()):.3g} in the course of the reduction: "
            "the matrix is too close to the boundary of the half-space for 64-bit integers"
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
