"""What is handed over for recognition, read as balls: numbers and matrices of every kind."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from numbers import Rational
from typing import Any, overload

import flint
import numpy as np

from .algebraic_numbers import LARGEST_DEGREE, LEAST_LEFT_OVER, AlgebraicNumber, recognise_number
from .exact_matrices import RecognisedMatrix, recognise_matrix

# Floating-point numbers are taken to be right to so many digits, unless something else is said.
_FLOAT_DIGITS = 12
_BITS_PER_DIGIT = math.log2(10.0)
_GUARD_BITS = 32


@overload
def recognize(
    x: flint.acb | flint.arb | complex | Fraction | str,
    *,
    degree: int = ...,
    digits: float | None = ...,
    left_over: float = ...,
) -> AlgebraicNumber | None: ...
@overload
def recognize(
    x: Any, *, degree: int = ..., digits: float | None = ..., left_over: float = ...
) -> Any: ...
def recognize(
    x: Any,
    *,
    degree: int = LARGEST_DEGREE,
    digits: float | None = None,
    left_over: float = LEAST_LEFT_OVER,
) -> AlgebraicNumber | RecognisedMatrix | None:
    """Recognise algebraic numbers: their minimal polynomials, with the evidence for them.

    What is found is recognised, not proved.  What the balls exclude is proved to be wrong, and is
    never returned.

    Parameters
    ----------
    x : number or matrix
        acb, arb, float, complex, Fraction, mpmath number, or text that python-flint reads, such as
        ``"1.4142135 +/- 1e-7"``; acb_mat, arb_mat, (n, m) array-like, PeriodMatrix or
        PeriodEnclosure.  Numbers of mpmath are right to their working precision; floats to 12
        digits.
    degree : int
        Largest degree over the rational numbers.
    digits : float, optional
        Take x to be right to so many decimal digits only, relative to max(1, |x|).
    left_over : float
        How many digits of evidence must be left over; see :class:`Evidence`.

    Returns
    -------
    AlgebraicNumber or None
        Of a number; None if nothing convincing was found.
    RecognisedMatrix
        Of a matrix, with None where an entry was not recognised.

    Raises
    ------
    ValueError
        If a number is not finite, the degree or ``digits`` not positive, or this is neither a
        number nor a matrix.

    Examples
    --------
    >>> print(recognize(1.6180339887498949), recognize(3.141592653589793))
    (1 + √5)/2 None
    """
    if digits is not None and not digits > 0:
        raise ValueError(f"digits must be positive, not {digits}")
    with flint.ctx.workprec(_precision(x, digits)):
        balls = _balls(x, digits)
        if isinstance(balls, flint.acb):
            return recognise_number(balls, degree=degree, left_over=left_over)
        return recognise_matrix(balls, degree=degree, left_over=left_over)


def _precision(x: Any, digits: float | None) -> int:
    """A working precision that loses nothing of x."""
    wanted = 0 if digits is None else int(digits * _BITS_PER_DIGIT) + _GUARD_BITS
    own = int(getattr(x, "bits", 0)) if isinstance(getattr(x, "bits", 0), int) else 0
    context = getattr(getattr(x, "context", None), "prec", 0)
    return max(int(flint.ctx.prec), wanted, own, int(context))


def _balls(x: Any, digits: float | None) -> flint.acb | flint.acb_mat:
    """The number or the matrix in balls."""
    matrix = getattr(x, "matrix", None)
    if isinstance(x, flint.acb_mat | flint.arb_mat):
        return _matrix(x.tolist() if x.nrows() else [], digits)
    if isinstance(matrix, flint.acb_mat):
        return _matrix(matrix.tolist() if matrix.nrows() else [], digits)
    if not hasattr(x, "entry_bounds") and _is_number(x):
        return _ball(x, digits)
    array = np.asarray(x)
    if array.ndim != 2 or array.dtype.kind not in "iufcO":
        raise ValueError(
            f"a number or a matrix is needed, not an array of shape {array.shape} and type "
            f"{array.dtype}"
        )
    bounds = getattr(x, "entry_bounds", None)
    rows = _matrix(array.tolist(), digits)
    return rows if bounds is None else _widened(rows, np.asarray(bounds))


def _is_number(x: Any) -> bool:
    return isinstance(x, flint.acb | flint.arb | flint.fmpq | flint.fmpz | str | Rational) or (
        isinstance(x, int | float | complex | np.number)
        or hasattr(x, "_mpf_")
        or hasattr(x, "_mpc_")
    )


def _matrix(rows: Sequence[Sequence[Any]], digits: float | None) -> flint.acb_mat:
    if not rows:
        return flint.acb_mat(0, 0)
    return flint.acb_mat([[_ball(z, digits) for z in row] for row in rows])


def _ball(x: Any, digits: float | None) -> flint.acb:
    """One number, with the radius that its kind or ``digits`` gives it."""
    if isinstance(x, Rational):
        z, known = flint.acb(flint.arb(flint.fmpq(int(x.numerator), int(x.denominator)))), None
    elif isinstance(x, float | complex | np.number):
        z, known = flint.acb(complex(x)), float(_FLOAT_DIGITS)
    elif hasattr(x, "context"):
        z, known = flint.acb(x), (x.context.prec - 2) / _BITS_PER_DIGIT
    else:
        z, known = flint.acb(x), None
    given = known if digits is None else digits
    if given is None:
        return z
    radius = flint.arb(10) ** -flint.arb(given) * max(1.0, abs(complex(z.mid())))
    return _wider(z, radius)


def _wider(z: flint.acb, radius: flint.arb | float) -> flint.acb:
    """The ball with a radius added; a part that is exactly 0 stays so."""
    parts = [
        part if part.is_exact() and part == 0 else part + flint.arb(0, radius)
        for part in (z.real, z.imag)
    ]
    return flint.acb(*parts) if z != 0 else flint.acb(flint.arb(0, radius), flint.arb(0, radius))


def _widened(rows: flint.acb_mat, bounds: np.ndarray[Any, Any]) -> flint.acb_mat:
    return flint.acb_mat(
        [
            [_wider(z, float(b)) for z, b in zip(row, bound, strict=True)]
            for row, bound in zip(rows.tolist(), bounds.tolist(), strict=True)
        ]
    )
