r"""Which algebraic number a ball may be: minimal polynomials, and what speaks for them.

A number z that is known to an error δ is a root of an integer polynomial P of degree n if the
lattice of polynomials with the norm of coefficients and 1/δ times the value at z has a short
vector.  LLL finds one; of its irreducible factors one that has exactly one root in the ball is a
candidate.  A factor without a root there is proved wrong, and dropped.

A candidate always exists, so it says nothing by itself.  *Evidence* compares two numbers.  Among
the N integer polynomials whose coefficients, weighted by the powers of z, are at most as large,

.. math:: N \cdot \frac{(|P'(z)|\, \delta)^m}{s}, \qquad m = 1 \text{ (real)}, 2,

come as close by chance, where s is the length or the area over which their values are spread and m
counts the real coordinates.
``digits`` is minus the logarithm of the bracket, what the ball says; ``spent`` is log N; and what
is ``left_over`` are the digits that a coincidence would have had to guess.  A random number has
nothing left over, and a polynomial of the height ``random_height``.

What is found is recognised, not proved.

References
----------
Kannan, Lenstra, Lovász, "Polynomial factorization and nonrandomness of bits of algebraic and some
transcendental numbers" (1988).
Cohen, "A course in computational algebraic number theory" (1993), section 2.7.2.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

import flint

from .integer_relations import reduced_relations
from .polynomial_roots import (
    integer_polynomial,
    isolated_roots,
    polynomial_text,
    root_near,
    vanishing_factor,
)

# Digits that must be left over: a coincidence of this many is not believed.
LEAST_LEFT_OVER = 6.0
LARGEST_DEGREE = 10
_GUARD_BITS = 64
# Longer polynomials are not written out.
_LONGEST_TEXT = 100


@dataclass(frozen=True)
class Evidence:
    """What speaks for a recognised number.

    Attributes
    ----------
    digits : float
        Decimal digits that were used, those of the real and of the imaginary part together.
    spent : float
        Logarithm of the number of candidates that are as simple.
    random_height : float
        Logarithm of the height that the polynomial of a random number of this size, known as well,
        would have.
    """

    digits: float
    spent: float
    random_height: float

    @property
    def left_over(self) -> float:
        """Digits left over: minus the logarithm of the expected number of coincidences."""
        return self.digits - self.spent

    def __str__(self) -> str:
        return (
            f"{self.digits:.0f} digits used, {self.left_over:.0f} left over; "
            f"a random number has height 10^{self.random_height:.0f}"
        )


@dataclass(frozen=True)
class AlgebraicNumber:
    """A root of an irreducible integer polynomial, with the evidence if it was recognised.

    Attributes
    ----------
    polynomial : (n + 1,) tuple of int
        c_0, …, c_n, irreducible, without a common divisor, c_n > 0.
    near : complex
        The root next to this one is meant.
    evidence : Evidence or None
        None if the number is exact by itself.
    """

    polynomial: tuple[int, ...]
    near: complex
    evidence: Evidence | None = None

    @classmethod
    def root(
        cls, polynomial: tuple[int, ...], near: complex, evidence: Evidence | None = None
    ) -> AlgebraicNumber:
        """The root of an irreducible polynomial next to a number."""
        exact = root_near(polynomial, near, _GUARD_BITS)
        return cls(polynomial, complex(exact.mid()), evidence)

    @property
    def degree(self) -> int:
        """The degree over the rational numbers."""
        return len(self.polynomial) - 1

    @property
    def height(self) -> int:
        """The largest coefficient."""
        return max(abs(c) for c in self.polynomial)

    @property
    def is_rational(self) -> bool:
        """Whether this is a fraction."""
        return self.degree == 1

    @property
    def is_real(self) -> bool:
        """Whether this is a real number: decided by the roots, which are isolated."""
        return bool(self.ball(_GUARD_BITS).imag == 0)

    def ball(self, bits: int) -> flint.acb:
        """The number in a ball, to about so many bits; real and rational ones are that exactly."""
        return root_near(self.polynomial, self.near, bits)

    def __complex__(self) -> complex:
        return self.near

    def same_number(self, other: AlgebraicNumber) -> bool:
        """Whether both are the same root of the same polynomial."""
        return self.polynomial == other.polynomial and bool(
            self.ball(_GUARD_BITS).overlaps(other.ball(_GUARD_BITS))
        )

    def __str__(self) -> str:
        from .radicals import in_radicals

        surd = in_radicals(self)
        if surd is not None:
            return str(surd)
        text = polynomial_text(self.polynomial)
        if len(text) > _LONGEST_TEXT:
            height = len(str(self.height)) - 1
            text = f"a polynomial of degree {self.degree} and height 10^{height}"
        near = f"{self.near.real:.6g}" if self.is_real else f"{self.near:.6g}"
        return f"root of {text} near {near}"


def recognise_number(
    z: flint.acb,
    *,
    degree: int = LARGEST_DEGREE,
    left_over: float = LEAST_LEFT_OVER,
) -> AlgebraicNumber | None:
    """Recognise an algebraic number in a ball.

    Parameters
    ----------
    z : acb
        A ball, of which the number is somewhere inside.  One that contains a real number is taken
        for real, and one that contains an imaginary number for imaginary.  A number without a
        radius is exactly that, and known to the working precision.
    degree : int
        The largest degree that is tried, from 1 on.
    left_over : float
        Digits of evidence that must be left over.

    Returns
    -------
    AlgebraicNumber or None
        None if nothing convincing is in the ball.

    Raises
    ------
    ValueError
        If z is not finite, or the degree not positive.

    Examples
    --------
    >>> with flint.ctx.workdps(40):
    ...     x = recognise_number(flint.acb(2 + flint.arb(5).sqrt()))
    >>> x.polynomial, x.height, x.evidence.left_over > 30
    ((-1, -4, 1), 4, True)
    """
    if not z.is_finite():
        raise ValueError(f"a finite number is needed, not {z}")
    if degree < 1:
        raise ValueError(f"the degree must be at least 1, not {degree}")
    precision = max(flint.ctx.prec, z.bits()) + _GUARD_BITS
    known = max(flint.ctx.prec, z.bits())
    with flint.ctx.workprec(precision):
        if z.imag.contains(0):
            return _first_convincing(z, known, degree, left_over, real=True)
        if z.real.contains(0):
            y = _first_convincing(flint.acb(z.imag), known, degree, left_over, real=True)
            number = None if y is None else _times_i(y)
            return number if number is not None and number.degree <= degree else None
        return _first_convincing(z, known, degree, left_over, real=False)


def _first_convincing(
    z: flint.acb, known: int, degree: int, left_over: float, *, real: bool
) -> AlgebraicNumber | None:
    """The candidate of the least degree that has enough evidence."""
    error = _error(z, known)
    for n in range(1, degree + 1):
        for candidate in _candidates(z, error, n, real=real):
            evidence = candidate.evidence
            if evidence is not None and evidence.left_over >= left_over:
                return candidate
    return None


def _error(z: flint.acb, known: int) -> flint.arb:
    """The radius of a ball; of an exact number what the precision leaves open."""
    radius = z.real.rad().max(z.imag.rad())
    size = z.mid().abs_upper()
    least = (size if size > 0 else flint.arb(1)) * flint.arb(2) ** -known
    return radius.max(least).mid()


def _candidates(z: flint.acb, error: flint.arb, n: int, *, real: bool) -> Iterator[AlgebraicNumber]:
    """Irreducible factors of what LLL finds in degree n that have one root in the ball."""
    if z.contains(0):
        yield AlgebraicNumber((0, 1), 0j, _evidence((0, 1), z, error, real=real))
        return
    size = z.mid().abs_upper()
    for weights in dict.fromkeys((_flat(size, n), _graded(size, n))):
        coefficients = _short_polynomial(z, error, weights, real=real)
        for factor, _ in flint.fmpz_poly(coefficients).factor()[1]:
            if factor.degree() < 1 or not factor(z).contains(0):
                continue
            near = _only_root(factor, z)
            if near is not None:
                c = integer_polynomial([int(x) for x in factor.coeffs()])
                yield AlgebraicNumber(c, near, _evidence(c, z, error, real=real))


def _short_polynomial(
    z: flint.acb, error: flint.arb, weights: tuple[int, ...], *, real: bool
) -> list[int]:
    """The polynomial that is shortest with these weights of its coefficients and values."""
    n, size = len(weights) - 1, z.mid().abs_upper()
    relative = float((size / error).log() / flint.arb(2).log())
    bits = max(4, int(relative - math.log2(n + 1)))
    # The largest value of a monomial with a coefficient of weight 1 is scaled to 1.
    largest = max((size**k / w for k, w in enumerate(weights)), key=lambda x: float(x.log()))
    values = [
        [p.real] if real else [p.real, p.imag]
        for p in (z.mid() ** k / largest for k in range(n + 1))
    ]
    return reduced_relations(values, bits, weights)[0]


def _flat(size: flint.arb, n: int) -> tuple[int, ...]:
    """All coefficients weigh the same."""
    return (1,) * (n + 1)


def _graded(size: flint.arb, n: int) -> tuple[int, ...]:
    """Weights next to the powers of |z|, none below 1: all terms are as large as each other."""
    e = round(float(size.log() / flint.arb(2).log()))
    return tuple(1 << (e * k if e >= 0 else -e * (n - k)) for k in range(n + 1))


def _only_root(factor: flint.fmpz_poly, z: flint.acb) -> complex | None:
    """The one root of an irreducible polynomial that lies in the ball; None if none or two do."""
    coefficients = [int(c) for c in factor.coeffs()]
    inside = [root for root in isolated_roots(coefficients, flint.ctx.prec) if root.overlaps(z)]
    return complex(inside[0].mid()) if len(inside) == 1 else None


def _evidence(c: tuple[int, ...], z: flint.acb, error: flint.arb, *, real: bool) -> Evidence:
    """The evidence by the kind of weights that speaks most for the polynomial."""
    size = flint.arb(1) if z.contains(0) else z.mid().abs_upper()
    boxes = [weights(size, len(c) - 1) for weights in (_flat, _graded)]
    kinds = [_evidence_in_box(c, weights, z, error, real=real) for weights in boxes]
    return max(kinds, key=lambda evidence: evidence.left_over)


def _evidence_in_box(
    c: tuple[int, ...], weights: tuple[int, ...], z: flint.acb, error: flint.arb, *, real: bool
) -> Evidence:
    """Among polynomials with |c_k| w_k as small: how many have a value as small as the error."""
    size = flint.arb(1) if z.contains(0) else z.mid().abs_upper()
    miss = flint.fmpz_poly(list(c)).derivative()(z.mid()).abs_upper() * error
    coordinates = 1 if real else 2
    box = max(abs(x) * w for x, w in zip(c, weights, strict=True))
    # Half of them, since −P is as good as P; but boxes of two kinds are tried.
    spent = sum(math.log10(2 * (box // w) + 1) for w in weights)
    values = [z.mid() ** k * flint.arb(box) / w for k, w in enumerate(weights)]
    digits = max(_log10(_spread(values, real=real)) - coordinates * _log10(miss), 0.0)
    graded = sum(math.log10(w) - math.log10(min(weights)) for w in weights)
    height = (graded - coordinates * _log10(error / size)) / len(c)
    return Evidence(digits, spent, max(0.0, height))


def _spread(values: list[flint.acb], *, real: bool) -> flint.arb:
    """Where sums of these values with coefficients from −1 to 1 are spread: a length, or an area.

    In the plane it is the sum of the parallelograms that two of them span, however long the
    longest value is: where all but one are short, sums fill a narrow strip.
    """
    if real:
        return sum((x.abs_upper() for x in values), flint.arb(0))
    pairs = itertools.combinations(values, 2)
    return sum((abs((x.conjugate() * y).imag).abs_upper() for x, y in pairs), flint.arb(0))


def _log10(x: flint.arb) -> float:
    return float((x.log() / flint.arb(10).log()).mid())


def _times_i(y: AlgebraicNumber) -> AlgebraicNumber:
    """The number i y for a real y.

    P(y) = E(y²) + y O(y²), so that x = iy is a root of E(−x²)² + x² O(−x²)².
    """
    square = flint.fmpz_poly([0, 0, -1])
    even = flint.fmpz_poly(list(y.polynomial[0::2]))(square)
    odd = flint.fmpz_poly(list(y.polynomial[1::2]))(square)
    norm = even * even + flint.fmpz_poly([0, 0, 1]) * odd * odd
    bits = flint.ctx.prec
    while True:
        with flint.ctx.workprec(bits):
            c = vanishing_factor(norm, y.ball(bits) * flint.acb(0, 1))
        if c is not None:
            return AlgebraicNumber(c, complex(0.0, y.near.real), y.evidence)
        bits *= 2
