r"""Numbers and points of the plane as people write them, read as exact numbers.

===========================================  ==================================================
integers, fractions, texts like ``"3/4"``    rational
doubles, also in complex numbers             rational, and marked as rounded
``flint.fmpz``, ``fmpq``, exact ``arb``      rational
elements of number fields, ours or Sage's    algebraic
recognised numbers that are real             algebraic
``flint.arb``, ``acb``                       the ball, which does not shrink
SymPy expressions                            rational, or functions of the precision (``evalf``)
functions of the precision in bits           balls that they give
===========================================  ==================================================

No library is imported for its numbers: they are known by their methods.  Of ``evalf`` and
functions it is trusted that all but the last two of the digits asked for are right, or that the
number lies in the ball.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from numbers import Rational
from typing import Any

import flint
import numpy as np

from igl_periods.errors import ComplexError

from .exact_numbers import (
    ComputedNumber,
    FieldElement,
    Number,
    algebraic_number,
)

_DIGITS_PER_BIT = math.log10(2.0)
_GUARD_DIGITS = 6
Point = tuple[Number, Number]


def exact_number(x: Any) -> Number:
    """A real number as a rational, algebraic or computed one; doubles are rational.

    Raises
    ------
    ComplexError
        If it is not a finite real number.
    """
    return read_number(x)[0]


def read_number(x: Any) -> tuple[Number, bool]:
    """An exact number, and whether it comes from floating point, where it may be rounded."""
    if isinstance(x, np.generic):
        x = x.item()
    if isinstance(x, FieldElement | ComputedNumber):
        return x, False
    if isinstance(x, bool):
        raise ComplexError(f"{x} is not a number of the plane.")
    if isinstance(x, Rational | str):
        return _fraction(x), False
    if isinstance(x, flint.fmpz | flint.fmpq):
        q = flint.fmpq(x)
        return Fraction(int(q.p), int(q.q)), False
    if isinstance(x, flint.arb):
        return _from_ball(x), False
    if getattr(x, "is_real", False) is True and hasattr(x, "polynomial") and hasattr(x, "near"):
        return algebraic_number(x.polynomial, complex(x.near).real), False
    if hasattr(x, "parent") and hasattr(x, "minpoly"):
        return _from_sage(x), False
    if getattr(x, "is_Rational", False):
        return Fraction(int(x.p), int(x.q)), False
    if hasattr(x, "evalf") and not getattr(x, "is_Float", False):
        return _from_evalf(x), False
    if callable(x):
        return ComputedNumber(x), False
    return _from_float(x), True


def read_point(z: Any) -> tuple[Point, bool]:
    """A point of the plane, and whether it comes from floating point.

    Parameters
    ----------
    z : number or pair
        A complex number of Python, NumPy, FLINT or SymPy, a function of the precision that gives
        one, a pair (x, y), or a real number.
    """
    if isinstance(z, complex | np.complexfloating):
        (x, _), (y, _) = read_number(z.real), read_number(z.imag)
        return (x, y), True
    if isinstance(z, flint.acb):
        return (exact_number(z.real), exact_number(z.imag)), False
    if isinstance(z, str):
        return (exact_number(z), Fraction(0)), False
    if hasattr(z, "__len__") and hasattr(z, "__getitem__"):
        if len(z) != 2:
            raise ComplexError(f"a point of the plane has two coordinates, not {len(z)}: {z!r}.")
        (x, one), (y, other) = read_number(z[0]), read_number(z[1])
        return (x, y), one or other
    if hasattr(z, "as_real_imag"):
        x, y = z.as_real_imag()
        return (exact_number(x), exact_number(y)), False
    is_number = isinstance(z, FieldElement | ComputedNumber)
    if callable(z) and not is_number and isinstance(z(64), flint.acb):
        return (ComputedNumber(partial(_real, z)), ComputedNumber(partial(_imag, z))), False
    x, rounded = read_number(z)
    return (x, Fraction(0)), rounded


def read_points(points: Sequence[Any]) -> tuple[list[Point], bool]:
    """Points of the plane, and whether any of them comes from floating point."""
    read = [read_point(z) for z in points]
    return [point for point, _ in read], any(rounded for _, rounded in read)


def _fraction(x: Any) -> Fraction:
    try:
        return Fraction(x) if isinstance(x, str) else Fraction(int(x.numerator), int(x.denominator))
    except (ValueError, ZeroDivisionError) as error:
        raise ComplexError(f"{x!r} is not a rational number.") from error


def _from_float(x: Any) -> Fraction:
    try:
        value = float(x)
    except (TypeError, ValueError, OverflowError) as error:
        raise ComplexError(f"{x!r} is not a real number.") from error
    if not math.isfinite(value):
        raise ComplexError(f"{x!r} is not finite.")
    return Fraction(value)


def _from_ball(x: flint.arb) -> Number:
    if not x.is_finite():
        raise ComplexError(f"{x} is not finite.")
    if x.is_exact():
        mantissa, exponent = x.man_exp()
        return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
    return ComputedNumber(partial(_constant, x))


def _from_sage(x: Any) -> Number:
    """A number of Sage: of Q, of an embedded number field, or any other algebraic one."""
    parent = x.parent()
    if hasattr(parent, "defining_polynomial") and hasattr(x, "list"):
        generator = parent.gen()
        polynomial = _integers(parent.defining_polynomial().list())
        alpha = algebraic_number(polynomial, float(generator))
        # Of a monic polynomial with fractions another multiple of the generator is taken: none.
        return alpha.field.element(*(_sage_fraction(c) for c in x.list()))
    polynomial = _integers(x.minpoly().list())
    if len(polynomial) == 2:
        return Fraction(-polynomial[0], polynomial[1])
    return algebraic_number(polynomial, float(x))


def _integers(coefficients: Sequence[Any]) -> list[int]:
    fractions = [_sage_fraction(c) for c in coefficients]
    common = math.lcm(*(c.denominator for c in fractions))
    return [int(c * common) for c in fractions]


def _sage_fraction(c: Any) -> Fraction:
    if isinstance(c, Rational):
        return Fraction(int(c.numerator), int(c.denominator))
    return Fraction(int(c.numerator()), int(c.denominator()))


def _from_evalf(x: Any) -> Number:
    if getattr(x, "is_real", None) is False or getattr(x, "free_symbols", None):
        raise ComplexError(f"{x} is not a real number.")
    return ComputedNumber(partial(_evaluated, x))


def _evaluated(x: Any, bits: int) -> flint.arb:
    digits = math.ceil(bits * _DIGITS_PER_BIT) + _GUARD_DIGITS
    with flint.ctx.workprec(bits + 32):
        value = flint.arb(str(x.evalf(digits)))
        return value + flint.arb(0, abs(value).upper() * flint.arb(10) ** (2 - digits))


def _constant(x: flint.arb, bits: int) -> flint.arb:
    return x


def _real(z: Callable[[int], flint.acb], bits: int) -> flint.arb:
    return z(bits).real


def _imag(z: Callable[[int], flint.acb], bits: int) -> flint.arb:
    return z(bits).imag
