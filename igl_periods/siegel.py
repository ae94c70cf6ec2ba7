r"""Siegel reduction: a point with small entries in the orbit of a period matrix.

Siegel reduction walks along the orbit of Π = X + iY under Sp(2g, Z) with three kinds of steps,

* Π → U Π Uᵀ, U unimodular, which LLL-reduces Y and puts a shortest vector first,
* Π → Π − S, S integer and symmetric, which makes the entries of X at most ½,
* the quasi-inversion at an index j with |Π_jj| < 1, the partial modular inversion Π_jj → −1/Π_jj.

Only the last one changes det Y, by the factor |Π_jj|⁻² > 1.  The determinants det Y along an
orbit do not accumulate at a positive number, so the walk ends.  The result is *not* a normal form
for g ≥ 2: it is not to be compared entry by entry.

All transformations are integer and exact.  The matrix that is returned is computed from the
given one and the accumulated γ in ball arithmetic, so no error accumulates either.

References
----------
Deconinck, Heil, Bobenko, van Hoeij, Schmies, "Computing Riemann theta functions" (2004), section 5.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import NotASiegelPointError
from .half_space import check_siegel_point, moebius, siegel_distance, siegel_transform
from .lattice import lll_basis, product, shortest_first, unimodular_inverse

__all__ = [
    "SiegelReduction",
    "check_siegel_point",
    "siegel_distance",
    "siegel_reduce",
    "siegel_transform",
]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Complexes = NDArray[np.complex128]

# |Π_jj| ≥ 1 − ε and |Re Π| ≤ ½ + ε count as reduced.
_EPSILON = 1e-12
# Up to this genus a shortest vector is put first; above it the LLL basis is taken as it is.
_SHORTEST_VECTOR_GENUS = 8
# Integers above this end a run of quasi-inversions in floating point.
_LARGE = 1e6
# After so many steps (there are seldom ten) every single quasi-inversion starts from exact values,
# so that det Y rises for certain.
_HASTY_STEPS = 100


class SiegelReduction(NamedTuple):
    """A reduced period matrix and the modular transformation that leads to it.

    Attributes
    ----------
    matrix : (g, g) complex
        γ · Π.
    gamma : (2g, 2g) int
        Integer symplectic, exactly.
    """

    matrix: Complexes
    gamma: Ints


def siegel_reduce(Pi: ArrayLike) -> SiegelReduction:
    """Siegel reduction: a modular transformation γ to a matrix Π' = γ · Π with small entries.

    It promises |Re Π'| ≤ ½, Im Π' LLL-reduced (up to g = 8 with a shortest vector first), and
    |Π'_jj| ≥ 1 at every index j, all up to 1e-12.

    Parameters
    ----------
    Pi : (g, g) array-like or PeriodMatrix
        Symmetric, with positive definite imaginary part.

    Returns
    -------
    SiegelReduction
        ``(matrix, gamma)``.

    Raises
    ------
    NotASiegelPointError
        If Π is no point of the Siegel upper half-space, or so close to its boundary that γ would
        not fit into 64-bit integers.

    References
    ----------
    Deconinck, Heil, Bobenko, van Hoeij, Schmies (2004), section 5; here with quasi-inversions at
    all indices, which needs fewer lattice reductions.

    Examples
    --------
    >>> matrix, gamma = siegel_reduce([[0.25 + 0.25j]])
    >>> np.round(matrix, 12), gamma.tolist()
    (array([[0.+2.j]]), [[2, -1], [1, 0]])
    """
    start = check_siegel_point(Pi)
    point, gamma = start, np.eye(2 * len(start), dtype=np.int64)
    for n_steps in itertools.count():
        step = _lattice_step(point)
        if _is_identity(step):
            step = _inversion_step(point, len(start) if n_steps < _HASTY_STEPS else 1)
        if _is_identity(step):
            return SiegelReduction(point, gamma)
        gamma = _product(step, gamma)
        point = moebius(gamma, start)
    raise AssertionError("unreachable: the walk along the orbit ends")


def _lattice_step(Pi: Complexes) -> Ints:
    """γ = [[U, −S U⁻ᵀ], [0, U⁻ᵀ]]: reduce the lattice of Im Π, then shift Re Π."""
    g = len(Pi)
    basis = shortest_first if g <= _SHORTEST_VECTOR_GENUS else lll_basis
    U = basis(Pi.imag)
    dual = unimodular_inverse(U).T
    S = _integer_part(U @ Pi.real @ U.T)
    return np.block([[U, _product(-S, dual)], [np.zeros((g, g), dtype=np.int64), dual]])


def _inversion_step(Pi: Complexes, most: int) -> Ints:
    """Up to ``most`` quasi-inversions at indices with |Π_jj| < 1, smallest first, and shifts."""
    g = len(Pi)
    Pi = Pi.copy()
    # Small integers, kept in floating point for the sake of fast products.
    upper, lower = np.split(np.eye(2 * g), 2)
    for _ in range(most):
        j = int(np.argmin(np.abs(np.diag(Pi)))) if g else 0
        if not g or abs(Pi[j, j]) >= 1 - _EPSILON:
            break
        _quasi_invert(Pi, j)
        upper[j], lower[j] = -lower[j], upper[j].copy()
        S = _integer_part(Pi.real)
        # A large shift means that digits of Π were lost: start again from exact values.
        if g * float(np.abs(S).max()) * float(np.abs(lower).max()) > _LARGE:
            break
        Pi -= S
        upper -= S.astype(np.float64) @ lower
    return np.vstack([upper, lower]).astype(np.int64)


def _quasi_invert(Pi: Complexes, j: int) -> None:
    """Π_jj → −1/Π_jj, Π_ij → Π_ij/Π_jj, Π_ik → Π_ik − Π_ij Π_jk/Π_jj; in place."""
    column, pivot = Pi[:, j].copy(), Pi[j, j]
    Pi -= np.outer(column, column) / pivot
    Pi[:, j] = Pi[j] = column / pivot
    Pi[j, j] = -1 / pivot


def _integer_part(X: Floats) -> Ints:
    """The integer symmetric S with |X − S| ≤ ½, 0 where |X| ≤ ½ + ε already."""
    if X.size and np.abs(X).max() >= 2.0**62:
        raise NotASiegelPointError(
            f"the real part reaches {float(np.abs(X).max()):.3g} in the course of the reduction: "
            "the matrix is too close to the boundary of the half-space for 64-bit integers"
        )
    S = np.where(np.abs(X) > 0.5 + _EPSILON, np.rint(X), 0.0).astype(np.int64)
    return np.triu(S) + np.triu(S, 1).T


def _is_identity(gamma: Ints) -> bool:
    return np.array_equal(gamma, np.eye(len(gamma), dtype=np.int64))


def _product(A: Ints, B: Ints) -> Ints:
    """The exact product of integer matrices, or an error where it does not fit into 64 bits."""
    try:
        return product(A, B)
    except OverflowError as error:
        raise NotASiegelPointError(
            "the modular transformation does not fit into 64-bit integers: the matrix is too "
            "close to the boundary of the Siegel upper half-space"
        ) from error
