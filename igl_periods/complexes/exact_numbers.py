r"""Real numbers that are known exactly: rational, algebraic, or computable to any precision.

Coordinates of polygons come in three kinds,

* rational numbers, as :class:`fractions.Fraction`; every double is one;
* elements of a real number field :math:`\mathbb Q(\alpha)`, α a real root of an irreducible integer
  polynomial: :math:`x = \sum_{k<d} c_k \alpha^k`, with rational c_k.  Sums, products and quotients
  are those of polynomials modulo that of α, so that x = 0 is decided by the c_k, and the sign of
  x ≠ 0 by balls that shrink until they do not contain 0;
* *computed* numbers, functions of the precision in bits that give balls.  Of these one knows that
  they differ, when balls do not meet, but never that they are equal.

The third kind is what everything else becomes where numbers of several fields meet.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, lru_cache, partial
from typing import Any

import flint

from igl_periods.errors import ComplexError

# Computed numbers that do not differ in so many bits are taken to be equal where it matters.
DECIDING_BITS = 384


@dataclass(frozen=True)
class RealField:
    """The field Q(α) of a real root α.

    Attributes
    ----------
    coefficients : tuple of int
        Of an irreducible polynomial, from the constant one to the leading one.
    index : int
        Which of its real roots α is, in increasing order.
    """

    coefficients: tuple[int, ...]
    index: int

    @property
    def degree(self) -> int:
        """The degree over Q."""
        return len(self.coefficients) - 1

    def root(self, bits: int) -> flint.arb:
        """A ball that contains α."""
        return _real_roots(self.coefficients, bits)[self.index]

    def element(self, *coefficients: int | Fraction) -> FieldElement:
        """The number Σ c_k α^k."""
        return _reduced(self, flint.fmpq_poly([_fmpq(Fraction(c)) for c in coefficients]))


@dataclass(frozen=True, repr=False)
class FieldElement:
    """A number Σ c_k α^k of a real number field, with the arithmetic of the field.

    Attributes
    ----------
    field : RealField
    coefficients : tuple of Fraction
        As many as the degree of the field.
    """

    field: RealField
    coefficients: tuple[Fraction, ...]

    def __repr__(self) -> str:
        if self.is_rational():
            return str(self.coefficients[0])
        surd = quadratic_text(self)
        return surd if surd else f"{float(self):.15g} (degree {self.field.degree})"

    def __float__(self) -> float:
        return float(self.ball(128).mid())

    def __neg__(self) -> FieldElement:
        return FieldElement(self.field, tuple(-c for c in self.coefficients))

    def __add__(self, other: Any) -> FieldElement:
        y = self._beside(other)
        if y is None:
            return NotImplemented
        pairs = zip(self.coefficients, y.coefficients)
        return FieldElement(self.field, tuple(a + b for a, b in pairs))

    def __sub__(self, other: Any) -> FieldElement:
        y = self._beside(other)
        return NotImplemented if y is None else self + -y

    def __rsub__(self, other: Any) -> FieldElement:
        return -self + other

    def __mul__(self, other: Any) -> FieldElement:
        y = self._beside(other)
        return NotImplemented if y is None else _reduced(self.field, self._poly() * y._poly())

    def __truediv__(self, other: Any) -> FieldElement:
        y = self._beside(other)
        if y is None:
            return NotImplemented
        if not any(y.coefficients):
            raise ZeroDivisionError("division by 0 in a number field")
        one, inverse, _ = y._poly().xgcd(_modulus(self.field))
        return _reduced(self.field, self._poly() * inverse / one[0])

    def __rtruediv__(self, other: Any) -> FieldElement:
        y = self._beside(other)
        return NotImplemented if y is None else y / self

    __radd__ = __add__
    __rmul__ = __mul__

    def __eq__(self, other: object) -> bool:
        y = self._beside(other)
        return NotImplemented if y is None else self.coefficients == y.coefficients

    def __hash__(self) -> int:
        c = self.coefficients
        return hash(c[0]) if self.is_rational() else hash((self.field, c))

    def is_rational(self) -> bool:
        """Whether the number lies in Q."""
        return not any(self.coefficients[1:])

    def ball(self, bits: int) -> flint.arb:
        """A ball that contains the number."""
        with flint.ctx.workprec(bits):
            alpha, value = self.field.root(bits), flint.arb(0)
            for c in reversed(self.coefficients):
                value = value * alpha + flint.arb(_fmpq(c))
            return value

    def sign(self) -> int:
        """−1, 0 or 1."""
        if not any(self.coefficients):
            return 0
        bits = 64
        while True:
            ball = self.ball(bits)
            if not ball.contains(0):
                return 1 if ball > 0 else -1
            bits *= 2

    def _beside(self, other: Any) -> FieldElement | None:
        """Another number as an element of this field; None where it is none."""
        if isinstance(other, FieldElement):
            return other if other.field == self.field else None
        if isinstance(other, int | Fraction):
            return self.field.element(other)
        return None

    def _poly(self) -> flint.fmpq_poly:
        return flint.fmpq_poly([_fmpq(c) for c in self.coefficients])


@dataclass(frozen=True, eq=False, repr=False)
class ComputedNumber:
    """A real number given by a function of the precision in bits, which gives a ball."""

    formula: Callable[[int], flint.arb]

    def __repr__(self) -> str:
        return f"{float(self):.15g} (computed)"

    def __float__(self) -> float:
        return float(self.ball(128).mid())

    def ball(self, bits: int) -> flint.arb:
        """A ball that contains the number."""
        with flint.ctx.workprec(bits):
            return flint.arb(self.formula(bits))


Number = Fraction | FieldElement | ComputedNumber


def algebraic_number(coefficients: list[int] | tuple[int, ...], near: float) -> FieldElement:
    """The real root of an integer polynomial that lies closest to a number.

    Parameters
    ----------
    coefficients : sequence of int
        From the constant one to the leading one.  The polynomial may be reducible.
    near : float

    Returns
    -------
    FieldElement
        With the arithmetic of its field: sums, products and quotients are exact.

    Raises
    ------
    ComplexError
        If the coefficients are not integers, or the polynomial has no real root.

    Examples
    --------
    >>> golden = algebraic_number([-1, -1, 1], 1.6)
    >>> golden, golden * golden, 1 / golden
    (1/2 + 1/2 √5, 3/2 + 1/2 √5, -1/2 + 1/2 √5)
    """
    given = list(coefficients)
    if not all(isinstance(c, int) and not isinstance(c, bool) for c in given) or not any(given[1:]):
        raise ComplexError(f"a polynomial is a list of integers, not constant: {given!r} is none.")
    best: tuple[float, RealField] | None = None
    for factor, _ in flint.fmpz_poly(given).factor()[1]:
        integers = tuple(int(c) for c in factor)
        for index, root in enumerate(_real_roots(integers, 128)):
            distance = abs(float(root.mid()) - near)
            if best is None or distance < best[0]:
                best = distance, RealField(integers, index)
    if best is None:
        raise ComplexError(f"the polynomial with the coefficients {given} has no real root.")
    return best[1].element(0, 1)


def ball_of(x: Any, bits: int) -> flint.arb:
    """A ball that contains a number of any of the three kinds."""
    if isinstance(x, int | Fraction):
        with flint.ctx.workprec(bits):
            return flint.arb(_fmpq(Fraction(x)))
    return x.ball(bits)


def sign_of(x: Any) -> int:
    """−1, 0 or 1; balls that contain 0 count as 0."""
    if isinstance(x, flint.arb):
        return 0 if x.contains(0) else (1 if x > 0 else -1)
    return x.sign() if isinstance(x, FieldElement) else (x > 0) - (x < 0)


def in_one_field(numbers: list[Number]) -> bool:
    """Whether all are rational or elements of one number field."""
    if any(isinstance(x, ComputedNumber) for x in numbers):
        return False
    return len({x.field for x in numbers if isinstance(x, FieldElement)}) <= 1


def computed(x: Number) -> ComputedNumber:
    """The same number as a function of the precision."""
    return x if isinstance(x, ComputedNumber) else ComputedNumber(partial(ball_of, x))


def computed_sum(x: ComputedNumber, y: ComputedNumber) -> ComputedNumber:
    """The sum as a function of the precision."""
    return ComputedNumber(partial(_sum_of_balls, x, y))


def root_of_number(square: Fraction | FieldElement) -> Callable[[], flint.arb]:
    """The formula √x at the working precision."""
    return partial(square_root_of_number, square)


def square_root_of_number(square: Fraction | FieldElement) -> flint.arb:
    """√x."""
    return ball_of(square, flint.ctx.prec).sqrt()


@cache
def cosine_field(n: int) -> RealField:
    """The field of 2 cos(2π/n), n ≥ 3; where that is rational, Q with the generator 2 cos(2π/n)."""
    coefficients = tuple(int(c) for c in flint.fmpz_poly.cos_minpoly(n))
    # 2 cos(2π/n) is the largest of its conjugates 2 cos(2πk/n).
    return RealField(coefficients, len(_real_roots(coefficients, 64)) - 1)


def cosine(k: int, n: int) -> FieldElement:
    """cos(2πk/n) as an element of the field of 2 cos(2π/n)."""
    field = cosine_field(n)
    before, now = field.element(2), field.element(0, 1)
    alpha = now
    for _ in range(k % n):
        before, now = now, alpha * now - before
    return before * Fraction(1, 2)


def cosine_and_sine(k: int, n: int) -> tuple[FieldElement, FieldElement]:
    """cos(2πk/n) and sin(2πk/n), in the field of 2 cos(2π/lcm(n, 4))."""
    N = math.lcm(n, 4)
    return cosine(k * N // n, N), cosine(k * N // n - N // 4, N)


def quadratic_text(x: FieldElement) -> str:
    """``a + b √d`` with d without squares, or nothing for other degrees."""
    if x.field.degree != 2:
        return ""
    c, b, a = x.field.coefficients
    d, root = b * b - 4 * a * c, 1
    for p in range(2, math.isqrt(d) + 1):
        while d % (p * p) == 0:
            d, root = d // (p * p), root * p
    # α = (−b ± √Δ) / 2a, the second root with the sign of a.
    up = 1 if (x.field.index == 1) == (a > 0) else -1
    rational = x.coefficients[0] - x.coefficients[1] * Fraction(b, 2 * a)
    factor = x.coefficients[1] * Fraction(up * root, 2 * a)
    surd = f"√{d}" if abs(factor) == 1 else f"{abs(factor)} √{d}"
    if rational == 0:
        return f"-{surd}" if factor < 0 else surd
    return f"{rational} {'-' if factor < 0 else '+'} {surd}"


@lru_cache(maxsize=256)
def _real_roots(coefficients: tuple[int, ...], bits: int) -> tuple[flint.arb, ...]:
    """The real roots of a polynomial without multiple roots, in increasing order."""
    with flint.ctx.workprec(bits + 16):
        roots: Any = flint.fmpz_poly(list(coefficients)).complex_roots()
    real = [z.real for z, _ in roots if z.imag == 0]
    return tuple(sorted(real, key=lambda x: float(x.mid())))


def _sum_of_balls(x: ComputedNumber, y: ComputedNumber, bits: int) -> flint.arb:
    return x.ball(bits) + y.ball(bits)


def _modulus(field: RealField) -> flint.fmpq_poly:
    return flint.fmpq_poly(list(field.coefficients))


def _reduced(field: RealField, poly: flint.fmpq_poly) -> FieldElement:
    rest = poly % _modulus(field)
    found = [Fraction(int(c.p), int(c.q)) for c in rest]
    return FieldElement(field, tuple(found + [Fraction(0)] * (field.degree - len(found))))


def _fmpq(x: Fraction) -> flint.fmpq:
    return flint.fmpq(x.numerator, x.denominator)
