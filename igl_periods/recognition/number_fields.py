r"""The number field that some algebraic numbers generate, and the numbers as its elements.

A generator :math:`\theta = x_1 + c_2 x_2 + \dots` is found one number after the other: θ + c x is a
root of the characteristic polynomial of :math:`M_\theta \otimes 1 + c\, 1 \otimes M_x` (companion
matrices), of which one irreducible factor vanishes there.  If its degree is larger than that of θ
the field has grown.  Quadratic fields are written with √d, others with a short integer of Z[θ]
(LLL on the embeddings).

The coefficients of :math:`x = \sum q_k \theta^k` come from an integer relation and are proved:
the minimal polynomial of x vanishes at q modulo that of θ, and balls tell the root.

References
----------
Cohen, "A course in computational algebraic number theory" (1993), sections 4.2 and 4.5.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count

import flint

from .algebraic_numbers import AlgebraicNumber
from .integer_relations import nearest_integer, reduced_relations
from .polynomial_roots import integer_polynomial, isolated_roots, polynomial_text, vanishing_factor
from .radicals import in_radicals, quadratic_parts

LARGEST_FIELD_DEGREE = 24
_FIRST_BITS, _MOST_BITS = 256, 1 << 15
_EMBEDDING_BITS = 256
_MULTIPLES = (1, -1, 2, -2, 3, -3, 5, 7)


@dataclass(frozen=True)
class NumberField:
    """Q(θ), a subfield of the complex numbers.

    Attributes
    ----------
    generator : AlgebraicNumber
        θ; 0 for the rational numbers.

    Examples
    --------
    >>> import igl_periods as ip
    >>> field = ip.NumberField(ip.recognize(1.4142135623730951))
    >>> field.degree
    2
    """

    generator: AlgebraicNumber

    @property
    def degree(self) -> int:
        """The degree over the rational numbers."""
        return self.generator.degree

    @property
    def polynomial(self) -> tuple[int, ...]:
        """The minimal polynomial c_0, …, c_n of the generator."""
        return self.generator.polynomial

    @property
    def is_real(self) -> bool:
        """Whether all its numbers are real."""
        return self.generator.is_real

    def coordinates(self, x: AlgebraicNumber) -> tuple[Fraction, ...]:
        """q_0, …, q_{n−1} with x = Σ q_k θ^k.

        Raises
        ------
        ValueError
            If x is not in the field.
        """
        if x.degree == 1:
            rational = Fraction(-x.polynomial[0], x.polynomial[1])
            return (rational, *[Fraction(0)] * (self.degree - 1))
        if self.degree % x.degree:
            raise ValueError(f"{x} has degree {x.degree}: it is not in a field of {self.degree}")
        bits = _FIRST_BITS
        while bits <= _MOST_BITS:
            found = _coordinates(x, self.generator, bits)
            if found is not None:
                return found
            bits *= 2
        raise ValueError(f"{x} is not in the field {self}")

    def __str__(self) -> str:
        if self.degree == 1:
            return "Q"
        surd = in_radicals(self.generator)
        if surd is not None:
            return f"Q({surd})"
        return f"Q(a), {polynomial_text(self.polynomial, 'a')} = 0"


RATIONALS = NumberField(AlgebraicNumber((0, 1), 0j))
"""The field Q."""


def generated_field(
    numbers: Iterable[AlgebraicNumber], *, largest_degree: int = LARGEST_FIELD_DEGREE
) -> NumberField | None:
    """The field that algebraic numbers generate.

    Returns
    -------
    NumberField or None
        None if its degree is larger than ``largest_degree``.

    Examples
    --------
    >>> root2, root3 = (AlgebraicNumber((-d, 0, 1), d**0.5 + 0j) for d in (2, 3))
    >>> field = generated_field([root2, root3])
    >>> field.degree, str(generated_field([root2]))
    (4, 'Q(√2)')
    """
    theta = RATIONALS.generator
    seen: set[tuple[int, ...]] = set()
    for x in sorted(numbers, key=lambda x: -x.degree):
        if x.degree == 1 or (x.degree == 2 and x.polynomial in seen):
            continue
        seen.add(x.polynomial)
        joined = _joined(theta, x, largest_degree)
        if joined is None:
            return None
        theta = joined
    return NumberField(_simplified(theta))


def _joined(
    theta: AlgebraicNumber, x: AlgebraicNumber, largest_degree: int
) -> AlgebraicNumber | None:
    """A generator of Q(θ, x): θ itself if x is in Q(θ)."""
    if theta.degree == 1:
        return x if x.degree <= largest_degree else None
    sums = [_sum(theta, x, c) for c in _MULTIPLES[:3]]
    best = max(sums, key=lambda s: s.degree)
    if best.degree == theta.degree:
        return theta
    return best if best.degree <= largest_degree else None


def _sum(theta: AlgebraicNumber, x: AlgebraicNumber, c: int) -> AlgebraicNumber:
    """θ + c x, by the characteristic polynomial of the sum of companion matrices."""
    A, B = (_companion(p.polynomial) for p in (theta, x))
    n, m = len(A), len(B)
    rows = [
        [
            (A[i][k] if j == l else Fraction(0)) + c * (B[j][l] if i == k else Fraction(0))
            for k in range(n)
            for l in range(m)  # noqa: E741
        ]
        for i in range(n)
        for j in range(m)
    ]
    matrix = flint.fmpq_mat([[_fmpq(q) for q in row] for row in rows])
    characteristic = flint.fmpz_poly([int(k) for k in matrix.charpoly().numer().coeffs()])
    for step in count(1):
        bits = _EMBEDDING_BITS * step
        with flint.ctx.workprec(bits):
            ball = theta.ball(bits) + c * x.ball(bits)
            polynomial = vanishing_factor(characteristic, ball)
        if polynomial is not None:
            return AlgebraicNumber(polynomial, complex(ball.mid()))
    raise AssertionError("not reached")


def _companion(polynomial: Sequence[int]) -> list[list[Fraction]]:
    n = len(polynomial) - 1
    rows = [[Fraction(int(i == j + 1)) for j in range(n)] for i in range(n)]
    for i in range(n):
        rows[i][n - 1] = Fraction(-polynomial[i], polynomial[n])
    return rows


def _coordinates(
    x: AlgebraicNumber, theta: AlgebraicNumber, bits: int
) -> tuple[Fraction, ...] | None:
    """The coordinates that an integer relation shows at a precision, if they are right."""
    n = theta.degree
    with flint.ctx.workprec(bits + _EMBEDDING_BITS):
        t, z = theta.ball(bits + _EMBEDDING_BITS), x.ball(bits + _EMBEDDING_BITS)
        powers = [*(t**k for k in range(n)), z]
        relation = reduced_relations([[p.real, p.imag] for p in powers], bits)[0]
        if relation[n] == 0:
            return None
        found = tuple(Fraction(-c, relation[n]) for c in relation[:n])
        value = sum((_fmpq(q) * t**k for k, q in enumerate(found)), flint.acb(0))
        if not value.overlaps(z):
            return None
    return found if _vanishes(x.polynomial, found, theta.polynomial) else None


def _vanishes(p: Sequence[int], q: Sequence[Fraction], modulus: Sequence[int]) -> bool:
    """Whether p(q(X)) = 0 modulo a polynomial."""
    m = flint.fmpq_poly(list(modulus))
    inner = flint.fmpq_poly([_fmpq(c) for c in q])
    value = flint.fmpq_poly([0])
    for c in reversed(p):
        value = (value * inner + c) % m
    return not value


def _simplified(theta: AlgebraicNumber) -> AlgebraicNumber:
    """A generator of the same field with a smaller minimal polynomial."""
    if theta.degree == 1:
        return RATIONALS.generator
    if theta.degree == 2:
        _, _, d = quadratic_parts(theta.polynomial)
        root = flint.acb(d).sqrt()
        return AlgebraicNumber((-d, 0, 1), complex(root.mid()))
    candidates = [theta, *_short_integers(theta)]
    return min(candidates, key=lambda a: (a.polynomial[-1] != 1, a.height, abs(a.near)))


def _short_integers(theta: AlgebraicNumber) -> list[AlgebraicNumber]:
    """Generators among the short elements of Z[aθ], a the leading coefficient."""
    n, a = theta.degree, theta.polynomial[-1]
    scaled = integer_polynomial(
        [c * Fraction(a) ** (n - 1 - k) for k, c in enumerate(theta.polynomial)]
    )
    with flint.ctx.workprec(2 * _EMBEDDING_BITS):
        roots = isolated_roots(scaled, 2 * _EMBEDDING_BITS)
        rows = [
            [nearest_integer(y, _EMBEDDING_BITS) for r in roots for y in ((r**k).real, (r**k).imag)]
            for k in range(n)
        ]
        _, change = flint.fmpz_mat(rows).lll(True)
        own = theta.ball(2 * _EMBEDDING_BITS) * a
        found = []
        for row in change.tolist():
            element = _element([int(c) for c in row], scaled, own)
            if element is not None and element.degree == n:
                found.append(element)
    return found


def _element(
    coefficients: Sequence[int], modulus: Sequence[int], root: flint.acb
) -> AlgebraicNumber | None:
    """Σ c_k θ^k, by the characteristic polynomial of its multiplication."""
    n = len(modulus) - 1
    companion = flint.fmpq_mat([[_fmpq(q) for q in row] for row in _companion(modulus)])
    matrix, power = (
        flint.fmpq_mat(n, n),
        flint.fmpq_mat(n, n, [i == j for i in range(n) for j in range(n)]),
    )
    value = flint.acb(0)
    for k, c in enumerate(coefficients):
        matrix, power, value = matrix + power * c, power * companion, value + c * root**k
    characteristic = flint.fmpz_poly([int(c) for c in matrix.charpoly().numer().coeffs()])
    polynomial = vanishing_factor(characteristic, value)
    return None if polynomial is None else AlgebraicNumber(polynomial, complex(value.mid()))


def _fmpq(q: Fraction) -> flint.fmpq:
    return flint.fmpq(q.numerator, q.denominator)
