r"""Equations y² = f(x) with recognised coefficients for a set of branch points.

The branch points are known in balls, up to Möbius transformations.  Coordinates in which they have
simple coefficients are tried in turn:

* those of a rotation x ↦ ζx that permutes them (:mod:`~igl_periods.curves.branch_symmetries`), with
  a scale that makes two coefficients equal up to sign;
* for a sextic with the involution x ↦ −x, c₃X³ + c₂X² + c₁X + c₀ = 0 with X = x²: with
  s = c₂³/(c₃² c₀), s̄ = c₁³/(c₀² c₃), u = c₁c₂/(c₀c₃), s s̄ = u³, the two fixed points are
  conjugate over the field of s + s̄ and u, and

  .. math:: s^2 x^6 + u^2 s\, x^4 z^2 + u^2 \bar s\, x^2 z^4 + \bar s^2 z^6, \qquad
            x = p + (s - \bar s)\, q, \quad z = p - (s - \bar s)\, q,

  has coefficients in that field;
* one of the branch points at ∞, the sum of the others 0 and the scale as invariants of the
  remaining weights say: right where a branch point is rational.

Of all models whose coefficients are recognised the one with the smallest field, then with the
smallest coefficients is taken.

References
----------
Cardona, Quer, "Field of moduli and field of definition for curves of genus 2" (2005).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import gcd

import flint

from igl_periods.recognition import AlgebraicNumber, Evidence, recognise_number

from .ball_roots import root
from .binary_forms import Form, Point, form_of_points
from .branch_symmetries import Rotation, around_fixed_points, rotations
from .integer_forms import reduced_form
from .weighted_points import absolute_invariants, vanishes

# Conjugacy classes with the same order and fixed points are tried by so many elements.
_REPRESENTATIVES = 3
# Two coefficients ±1.
_SIMPLEST = (1, 4, 2)
# Balls around 0 are taken for 0 up to this size, relative to the largest coefficient.
_VANISHING = 1e-5
ZERO = AlgebraicNumber((0, 1), 0j)


@dataclass(frozen=True)
class RecognisedForm:
    """A binary form whose coefficients are recognised.

    Attributes
    ----------
    balls : tuple of acb
        f_0, …, f_n of Σ f_k x^k.
    numbers : tuple of AlgebraicNumber
    """

    balls: tuple[flint.acb, ...]
    numbers: tuple[AlgebraicNumber, ...]

    @property
    def degree(self) -> int:
        """The largest degree of a coefficient over the rational numbers."""
        return max(x.degree for x in self.numbers)

    @property
    def cost(self) -> tuple[int, int, int]:
        """What is to be small: degree, height, number of terms."""
        height = sum(abs(c) for x in self.numbers for c in x.polynomial if x.polynomial != (0, 1))
        return self.degree, height, sum(x.polynomial != (0, 1) for x in self.numbers)


def model_of_branch_points(points: list[Point], degree: int) -> RecognisedForm | None:
    """The simplest equation that is found; None if no coordinates have recognised coefficients.

    Parameters
    ----------
    points : list of (x, z)
        2g + 2 branch points in balls.
    degree : int
        The largest degree of an algebraic number that is tried.
    """
    best: RecognisedForm | None = None
    for candidates in (_by_rotations(points), _by_points(points)):
        for form in candidates:
            found = recognised_form(form, degree)
            if found is not None and (best is None or found.cost < best.cost):
                best = found
            if best is not None and best.cost <= _SIMPLEST:
                return best
        if best is not None and best.degree == 1:
            return best
    return best


def recognised_form(form: Form, degree: int) -> RecognisedForm | None:
    """The form with its coefficients recognised, integers if all are rational; None otherwise."""
    if not _well_known(form):
        return None
    numbers: list[AlgebraicNumber] = []
    for c in form:
        number = ZERO if vanishes(c) else recognise_number(c, degree=degree)
        if number is None or (number.polynomial == (0, 1) and not c.contains(0)):
            return None
        numbers.append(number)
    if all(x.is_rational for x in numbers):
        fractions = [Fraction(-x.polynomial[0], x.polynomial[1]) for x in numbers]
        return rational_form(fractions, weakest_evidence(numbers))
    return RecognisedForm(tuple(form), tuple(numbers))


def _well_known(form: Form) -> bool:
    """Whether what counts as 0 is small compared with the other coefficients."""
    if not all(c.is_finite() for c in form):
        return False
    sizes = [float(c.abs_lower()) for c in form]
    largest = max(sizes)
    return largest > 0.0 and all(
        size > 0.0 or float(c.abs_upper()) < _VANISHING * largest
        for c, size in zip(form, sizes, strict=True)
    )


def rational_form(fractions: list[Fraction], evidence: Evidence | None) -> RecognisedForm:
    """A form with small integer coefficients of an isomorphic curve."""
    integers = reduced_form(fractions)
    numbers = tuple(AlgebraicNumber((-c, 1), complex(c), evidence) for c in integers)
    return RecognisedForm(tuple(flint.acb(c) for c in integers), numbers)


def weakest_evidence(numbers: Iterable[AlgebraicNumber]) -> Evidence | None:
    """That of the number that has the fewest digits left over."""
    found = [x.evidence for x in numbers if x.evidence is not None]
    return min(found, key=lambda evidence: evidence.left_over, default=None)


def _by_rotations(points: list[Point]) -> Iterator[Form]:
    for rotation in _representatives(rotations(points)):
        moved = around_fixed_points(points, rotation)
        if moved is None:
            continue
        form = [flint.acb(0) if c.contains(0) else c for c in form_of_points(moved)]
        yield from _scaled(form, rotation.order)
        if rotation.order == 2 and len(form) == 7 and not form[0].contains(0):
            yield from _conjugate_fixed_points(form)


def _representatives(found: Iterable[Rotation]) -> Iterator[Rotation]:
    seen: dict[tuple[int, int], int] = {}
    for rotation in found:
        kind = (rotation.order, rotation.n_fixed)
        seen[kind] = seen.get(kind, 0) + 1
        if seen[kind] <= _REPRESENTATIVES:
            yield rotation


def _scaled(form: Form, order: int) -> Iterator[Form]:
    """X ↦ t x with two neighbouring coefficients c_p, c_q equal up to sign, and c_q = 1."""
    places = [k for k, c in enumerate(form) if not c.contains(0)]
    for p, q in pairwise(places):
        gap = (q - p) // gcd(order, q - p)
        # Two terms make xⁿ − 1 and not xⁿ + 1.
        for sign in (-1, 1) if len(places) == 2 else (1, -1):
            ratio = sign * form[p] / form[q]
            for t in _roots(ratio, gap):
                # t stands for a power of the scale: exponents differ by multiples of the order.
                scaled = [
                    c * t ** ((k - p) // gcd(order, q - p)) if k in places else c
                    for k, c in enumerate(form)
                ]
                yield [c / scaled[q] for c in scaled]


def _roots(x: flint.acb, n: int) -> list[flint.acb]:
    first = root(x, n)
    return [first * flint.acb(flint.fmpq(2 * k, n)).exp_pi_i() for k in range(n)]


def _conjugate_fixed_points(form: Form) -> Iterator[Form]:
    c0, c1, c2, c3 = form[0::2]
    if c1.contains(0) or c2.contains(0):
        return
    s, t, u = c2**3 / (c3**2 * c0), c1**3 / (c0**2 * c3), c1 * c2 / (c0 * c3)
    difference = s - t
    if difference.contains(0):
        return
    plus: Form = [flint.acb(1), difference]
    minus: Form = [flint.acb(1), -difference]
    total = [flint.acb(0)] * 7
    for coefficient, power in ((s**2, 6), (u**2 * s, 4), (u**2 * t, 2), (t**2, 0)):
        term = form_of_powers(plus, minus, power)
        total = [a + coefficient * b for a, b in zip(total, term, strict=True)]
    leading = next(c for c in reversed(total) if not c.contains(0))
    yield [c / leading for c in total]


def form_of_powers(plus: Form, minus: Form, power: int) -> Form:
    """plus^power · minus^(6 − power)."""
    product = flint.acb_poly(plus) ** power * flint.acb_poly(minus) ** (6 - power)
    return list(product.coeffs()) + [flint.acb(0)] * (6 - product.degree())


def _by_points(points: list[Point]) -> Iterator[Form]:
    """One branch point at ∞, the sum of the others 0."""
    n = len(points) - 1
    for place, (a, b) in enumerate(points):
        others = [p for k, p in enumerate(points) if k != place]
        # x ↦ (ā x + b̄ z) / (b x − a z) takes (a : b) to ∞ and is well conditioned.
        p, q = a.conjugate(), b.conjugate()
        roots = [(p * x + q * z) / (b * x - a * z) for x, z in others]
        middle = sum(roots, flint.acb(0)) / n
        form = form_of_points([(x - middle, flint.acb(1)) for x in roots])
        weights = list(range(2, n + 1))
        try:
            scaled = absolute_invariants([form[n - k] for k in weights], weights)
        except (ValueError, ZeroDivisionError):
            continue
        yield [*reversed(scaled), flint.acb(0), flint.acb(1), flint.acb(0)]
