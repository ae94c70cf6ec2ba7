r"""Midpoint–radius arithmetic on arrays: balls that provably contain the exact results.

A ball is a floating-point midpoint m and a floating-point radius r ≥ 0, the set
:math:`\{ x : |x - m| \le r \}`.  Each operation computes the midpoint of its result in floating
point, and a radius that covers both the radii of the operands and the rounding of the midpoint:

.. math::
    x + y:\;& r_x + r_y + u |m| \\
    x\, y:\;& |x|\, r_y + r_x (|y| + r_y) + u |m| \\
    x / y:\;& \frac{r_x + |m|\, r_y}{|y| - r_y} + u |m| \\
    \sqrt x:\;& \frac{r_x}{\sqrt x + \sqrt{x - r_x}} + u |m|,
    \qquad \sqrt{x - r_x} \ge \sqrt x \, (1 - r_x / x),

u = 2⁻⁵³ and m the midpoint of the result, since a rounded sum, product, quotient or root is off by
at most u times itself.  The radius is a formula of fewer than 16 operations on numbers ≥ 0, so
its own rounding is covered by the factor 1 + 2⁻⁴⁸, and underflow by the term 2⁻¹⁰⁰⁰.  A result
that is not determined (a division by a ball that contains 0, the root of one that is not
positive) has radius ∞, and so has all that is computed from it.

Sums of many products are left to BLAS.  In *whatever order* n products are added, with or without
fused operations, the sum is off by at most :math:`\gamma_n \sum |x_i y_i|`,
:math:`\gamma_n = n u / (1 - n u)` (Higham 2002, section 3.1), and that is at most
:math:`\gamma_n \|x\| \|y\|`.  By the same inequality of Cauchy and Schwarz radii enter by their
norms alone,

.. math:: |x^T y - m_x^T m_y| \le \|m_x\| \|r_y\| + \|r_x\| ( \|m_y\| + \|r_y\| ),

so that a Gram matrix in balls takes one matrix product, like one in floats.  The rows are
multiplied in short portions, and the products are added in pairs, then pairs of pairs: n stays
small, however long the columns are.

What is assumed: floating-point numbers of IEEE 754 double precision, rounded to nearest, results
below the normal range not flushed to zero (:func:`check_arithmetic` tests both), and a BLAS that
forms matrix products by sums of products, not by Strassen's recursion.

References
----------
Rump, "Fast and parallel interval arithmetic" (1999).
Higham, "Accuracy and stability of numerical algorithms" (2002), chapters 2 and 3.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats

UNIT = 2.0**-53
_UP = 1.0 + 2.0**-48
_TINY = 2.0**-1000
# Sums of squares of so many numbers are known to a factor 1 + 2⁻³⁰.
_MOST_ROWS = 2**20
_NORM_UP = 1.0 + 2.0**-30
# Rows multiplied at once, at least and at most.
_FEWEST_ROWS, _LARGEST_PORTION = 32, 1024


@dataclass(frozen=True, eq=False)
class Balls:
    """An array of balls.

    Attributes
    ----------
    mid, rad : arrays of float, of the same shape
        Midpoints and radii.
    """

    mid: Floats
    rad: Floats

    # NumPy arrays leave the operators to this class.
    __array_ufunc__ = None

    @classmethod
    def exact(cls, values: Floats) -> Balls:
        """Numbers that are exactly what they are stored as."""
        return cls(values, np.broadcast_to(np.float64(0.0), values.shape))

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the array."""
        return self.mid.shape

    @property
    def upper(self) -> Floats:
        """Upper bounds of the absolute values."""
        return (np.abs(self.mid) + self.rad) * _UP

    def is_positive(self) -> NDArray[np.bool_]:
        """Where all numbers of a ball are positive."""
        return self.mid > self.rad

    def __getitem__(self, index: Any) -> Balls:
        return Balls(self.mid[index], self.rad[index])

    def __neg__(self) -> Balls:
        return Balls(-self.mid, self.rad)

    def __add__(self, other: Balls) -> Balls:
        mid = self.mid + other.mid
        return Balls(mid, (self.rad + other.rad + UNIT * np.abs(mid)) * _UP)

    def __sub__(self, other: Balls) -> Balls:
        mid = self.mid - other.mid
        return Balls(mid, (self.rad + other.rad + UNIT * np.abs(mid)) * _UP)

    def __mul__(self, other: Balls) -> Balls:
        mid = self.mid * other.mid
        rad = np.abs(self.mid) * other.rad + self.rad * (np.abs(other.mid) + other.rad)
        return Balls(mid, (rad + UNIT * np.abs(mid) + _TINY) * _UP)

    def __truediv__(self, other: Balls) -> Balls:
        room = np.abs(other.mid) - other.rad
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            mid = self.mid / other.mid
            size = np.abs(mid)
            rad = (self.rad + (size + _TINY) * other.rad) / room + UNIT * size + _TINY
        return _known(mid, rad * _UP, room > 0.0)

    def sqrt(self) -> Balls:
        """Square roots."""
        with np.errstate(divide="ignore", invalid="ignore"):
            mid = np.sqrt(self.mid)
            rad = self.rad / (mid * (2.0 - self.rad / self.mid)) + UNIT * mid + _TINY
        return _known(mid, rad * _UP, self.is_positive())

    def scaled(self, factor: float | Floats) -> Balls:
        """Multiples by powers of 2, which are exact."""
        return Balls(self.mid * factor, self.rad * np.abs(factor) + _TINY)

    def reshape(self, *shape: int) -> Balls:
        """The same balls in another shape."""
        return Balls(self.mid.reshape(*shape), self.rad.reshape(*shape))


def _known(mid: Floats, rad: Floats, determined: NDArray[np.bool_]) -> Balls:
    """Balls, with radius ∞ where nothing is determined."""
    if determined.all():
        return Balls(mid, rad)
    return Balls(np.where(determined, mid, 0.0), np.where(determined, rad, np.inf))


def check_arithmetic() -> None:
    """Test the assumptions about floating-point arithmetic that can be tested.

    Raises
    ------
    ArithmeticError
        If results are not rounded to nearest, or tiny ones are flushed to zero, as some libraries
        ask of the processor when they are loaded.
    """
    one, half = np.ones(8), np.full(8, UNIT)
    to_nearest = (one + half == one).all() and (one + 1.5 * half > one).all()
    to_nearest &= (one - 0.5 * half == one).all() and (-one - half == -one).all()
    least = np.full(8, 2.0**-1022) * 0.25
    if not to_nearest or not (least > 0.0).all():
        raise ArithmeticError(
            "floating-point numbers are not rounded to nearest here, or tiny ones are flushed to "
            "zero: nothing can be proved. A library compiled with -ffast-math does this; import "
            "it after igl_periods, or leave rigorous=True away."
        )


def gamma(n: int) -> float:
    """An upper bound of γ_n = n u / (1 − n u)."""
    return n * UNIT * (1.0 + 2.0**-20) if n < 2**30 else np.inf


def norms(columns: Floats) -> Floats:
    """Upper bounds of the Euclidean norms of the columns of an array (n, k), n ≤ 2²⁰."""
    n = len(columns)
    if n > _MOST_ROWS:
        raise ValueError(f"columns of {n} numbers are too long, {_MOST_ROWS} is the limit.")
    squares = np.einsum("nk,nk->k", columns, columns)
    return np.asarray((np.sqrt(squares + n * 2.0**-1022) + _TINY) * _NORM_UP)


def inner_products(X: Balls, Y: Balls) -> Balls:
    """Xᵀ Y for arrays of balls (n, k) and (n, l), n ≤ 2²⁰."""
    of_X, r_X = norms(X.mid), norms(X.rad)
    of_Y, r_Y = (of_X, r_X) if Y is X else (norms(Y.mid), norms(Y.rad))
    mid, n_terms = _short_products(X.mid, Y.mid)
    rad = np.outer(of_X, r_Y + gamma(n_terms) * of_Y) + np.outer(r_X, of_Y + r_Y)
    return Balls(mid, rad * _UP + len(X.mid) * _TINY)


def total(parts: Iterable[Balls]) -> Balls:
    """The sum of arrays of balls of one shape, in pairs, pairs of pairs, …"""
    waiting: list[tuple[int, Balls]] = []
    for part in parts:
        count = 1
        while waiting and waiting[-1][0] == count:
            part, count = waiting.pop()[1] + part, 2 * count
        waiting.append((count, part))
    _, whole = waiting.pop()
    while waiting:
        whole = waiting.pop()[1] + whole
    return whole


def _short_products(X: Floats, Y: Floats) -> tuple[Floats, int]:
    """Xᵀ Y, and the most operations that any of its products takes part in."""
    n, k = X.shape
    rows = int(np.clip(2 * k, _FEWEST_ROWS, _LARGEST_PORTION))
    count = n // rows
    whole = count * rows
    left, right = X[:whole].reshape(count, rows, k), Y[:whole].reshape(count, rows, Y.shape[1])
    parts = left.transpose(0, 2, 1) @ right
    if whole < n or n == 0:
        parts = np.concatenate([parts, (X[whole:].T @ Y[whole:])[None]])
    n_terms = rows
    while len(parts) > 1:
        half = len(parts) // 2
        sums = parts[:half] + parts[half : 2 * half]
        parts = np.concatenate([sums, parts[2 * half :]]) if len(parts) % 2 else sums
        n_terms += 1
    return parts[0], n_terms
