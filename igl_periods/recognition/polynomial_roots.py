"""Roots of irreducible integer polynomials in balls, and the polynomials that they determine."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

import flint

_LEAST_BITS = 64


@lru_cache(maxsize=512)
def _isolated(coefficients: tuple[int, ...], bits: int) -> tuple[flint.acb, ...]:
    with flint.ctx.workprec(bits):
        found: Any = flint.fmpz_poly(list(coefficients)).complex_roots()
        return tuple(root for root, _ in found)


def isolated_roots(coefficients: Sequence[int], bits: int) -> tuple[flint.acb, ...]:
    """All roots of a square-free polynomial c_0 + … + c_n xⁿ in disjoint balls.

    Real roots have the imaginary part 0, exactly.
    """
    return _isolated(tuple(int(c) for c in coefficients), max(bits, _LEAST_BITS))


def root_near(coefficients: Sequence[int], near: complex, bits: int) -> flint.acb:
    """The root next to a number, in a ball; a rational one to the precision.

    Examples
    --------
    >>> (root_near([-5, 0, 1], 2.2, 64).real ** 2).contains(5)
    True
    """
    if len(coefficients) == 2:
        with flint.ctx.workprec(max(bits, _LEAST_BITS)):
            return flint.acb(flint.arb(flint.fmpq(-coefficients[0], coefficients[1])))
    roots = isolated_roots(coefficients, bits)
    return min(roots, key=lambda root: abs(complex(root.mid()) - near))


def integer_polynomial(coefficients: Sequence[Fraction | int]) -> tuple[int, ...]:
    """The polynomial with integer coefficients without a common divisor, the leading one positive.

    Examples
    --------
    >>> integer_polynomial([Fraction(1, 2), 0, -2])
    (-1, 0, 4)
    """
    exact = [Fraction(c) for c in coefficients]
    q = flint.fmpq_poly([flint.fmpq(c.numerator, c.denominator) for c in exact])
    p = [int(c) for c in q.numer().coeffs()]
    divisor = int(flint.fmpz_poly(p).content())
    sign = 1 if p[-1] > 0 else -1
    return tuple(sign * c // divisor for c in p)


def polynomial_text(coefficients: Sequence[int], name: str = "x") -> str:
    """c_0 + … + c_n xⁿ as it is read, the highest power first.

    Examples
    --------
    >>> polynomial_text([-1, -4, 1]), polynomial_text([2, 0, -3], "a")
    ('x^2 - 4 x - 1', '-3 a^2 + 2')
    """
    text = ""
    for k in reversed(range(len(coefficients))):
        c = coefficients[k]
        if c == 0:
            continue
        power = "" if k == 0 else name if k == 1 else f"{name}^{k}"
        size = " ".join(
            part for part in (str(abs(c)) if abs(c) != 1 or not k else "", power) if part
        )
        sign = ("-" if c < 0 else "") if not text else (" - " if c < 0 else " + ")
        text += sign + size
    return text or "0"


def vanishing_factor(polynomial: flint.fmpz_poly, z: flint.acb) -> tuple[int, ...] | None:
    """The one irreducible factor that can vanish at a number in a ball; None if several can."""
    factors = [f for f, _ in polynomial.factor()[1] if f(z).contains(0)]
    if len(factors) != 1:
        return None
    return integer_polynomial([int(c) for c in factors[0].coeffs()])
