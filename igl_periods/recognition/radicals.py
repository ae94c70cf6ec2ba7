r"""Algebraic numbers written with roots, where that is short.

* Rational and quadratic numbers: :math:`a + b\sqrt d`, always.
* Quartic numbers x over a quadratic field: x and one of its conjugates are the roots of
  :math:`X^2 - sX + p` with s, p in :math:`Q(\sqrt d)`, so that :math:`x = s/2 ± \sqrt{s^2/4 - p}`.
  With :math:`u^2 - v^2 d = w^2` the nested root is :math:`\sqrt{u + v\sqrt d} = \sqrt{(u+w)/2} ±
  \sqrt{(u-w)/2}`: biquadratic numbers.
* :math:`x = c + \sqrt[m]{y}` with y rational or quadratic: the minimal polynomial, shifted so that
  its roots have the sum 0, is one in :math:`X^m`.

Each form is proved to be a root of the polynomial, in rational arithmetic, and its ball tells which
root it is.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import product
from math import comb, gcd

import flint

from .algebraic_numbers import AlgebraicNumber, recognise_number
from .polynomial_roots import integer_polynomial, isolated_roots
from .surds import Root, Surd, square_part, square_root, surd

_BITS = 256
_SIGNS = (Fraction(1), Fraction(-1))


def in_radicals(x: AlgebraicNumber) -> Surd | None:
    """Write an algebraic number with roots.

    Returns
    -------
    Surd or None
        None if it has none of the forms that are tried.

    Examples
    --------
    >>> print(in_radicals(AlgebraicNumber((-1, -4, 1), 4.2 + 0j)))
    2 + √5
    >>> print(in_radicals(AlgebraicNumber((1, 0, -10, 0, 1), 3.146 + 0j)))
    √2 + √3
    """
    if x.degree <= 2:
        return _matching(x, _roots_of_quadratic(x.polynomial))
    forms = [*_over_a_quadratic_field(x), *_pure_roots(x)]
    return _matching(x, sorted(forms, key=_complexity))


def quadratic_parts(polynomial: tuple[int, ...]) -> tuple[Fraction, Fraction, int]:
    """The roots a ± b√d of a rational or quadratic polynomial; d is square-free, or 0."""
    if len(polynomial) == 2:
        return Fraction(-polynomial[0], polynomial[1]), Fraction(0), 0
    c, b, a = polynomial
    s, d = square_part(b * b - 4 * a * c)
    return Fraction(-b, 2 * a), Fraction(s, 2 * a), d


def _roots_of_quadratic(polynomial: tuple[int, ...]) -> list[Surd]:
    a, b, d = quadratic_parts(polynomial)
    return [surd(a, (sign * b, d)) for sign in _SIGNS]


def _matching(x: AlgebraicNumber, forms: list[Surd]) -> Surd | None:
    """The first form that is the root that is meant; all are roots of the polynomial."""
    root = x.ball(_BITS)
    others = [r for r in isolated_roots(x.polynomial, _BITS) if not r.overlaps(root)]
    for form in forms:
        ball = form.ball(_BITS)
        if ball.overlaps(root) and not any(ball.overlaps(other) for other in others):
            return form
    return None


def _complexity(x: Surd) -> tuple[int, int]:
    """Roots in roots, where one above a square root counts twice; then the length as text."""
    depths = [1 + (root.index > 2) + _complexity(root.radicand)[0] for root in x.terms]
    depth = max(depths, default=0)
    return depth, len(str(x))


def _over_a_quadratic_field(x: AlgebraicNumber) -> Iterator[Surd]:
    """s/2 ± √(s²/4 − p) for the ways to pair x with a conjugate over a quadratic field."""
    if x.degree != 4:
        return
    root = x.ball(_BITS)
    for other in isolated_roots(x.polynomial, _BITS):
        if other.overlaps(root):
            continue
        with flint.ctx.workprec(_BITS):
            pair = [recognise_number(z, degree=2) for z in (root + other, root * other)]
        if pair[0] is None or pair[1] is None:
            continue
        yield from _of_sum_and_product(x.polynomial, pair[0], pair[1])


def _of_sum_and_product(
    polynomial: tuple[int, ...], sum_: AlgebraicNumber, product_: AlgebraicNumber
) -> Iterator[Surd]:
    a, b, d = quadratic_parts(sum_.polynomial)
    e, f, d2 = quadratic_parts(product_.polynomial)
    if d and d2 and d != d2:
        return
    d = d or d2
    for sb, sf in product(_SIGNS, repeat=2):
        if _product_of_conjugates(a, sb * b, e, sf * f, d) != polynomial:
            continue
        # (a + b√d)²/4 − (e + f√d) = u + v√d
        u, v = (a * a + b * b * d) / 4 - e, sb * a * b / 2 - sf * f
        for nested in _nested_roots(u, v, d):
            yield _sum(surd(a / 2, (sb * b / 2, d)), nested)


def _product_of_conjugates(
    a: Fraction, b: Fraction, e: Fraction, f: Fraction, d: int
) -> tuple[int, ...]:
    """(X² − sX + p) times its conjugate, s = a + b√d, p = e + f√d."""
    linear = -2 * (a * e - b * f * d)
    return integer_polynomial(
        [e * e - f * f * d, linear, a * a - b * b * d + 2 * e, -2 * a, Fraction(1)]
    )


def _nested_roots(u: Fraction, v: Fraction, d: int) -> Iterator[Surd]:
    """± √(u + v√d), without a nested root if there is such a form."""
    w, one = square_root(u * u - v * v * d)
    if one in (0, 1):
        halves = [square_root((u + w) / 2), square_root((u - w) / 2)]
        for sign, other in product(_SIGNS, repeat=2):
            yield surd(Fraction(0), *((s * c, r) for s, (c, r) in zip((sign, other), halves)))
        return
    for sign in _SIGNS:
        yield Surd(Fraction(0), (_scaled_root(sign, u, v, d, 2),))


def _scaled_root(sign: Fraction, u: Fraction, v: Fraction, d: int, m: int) -> Root:
    """±(u + v√d)^{1/m} with integers below the root, and no m-th power among them."""
    denominator = u.denominator * v.denominator // gcd(u.denominator, v.denominator)
    U, V = (int(q * denominator**m) for q in (u, v))
    factor = 1
    for prime, exponent in flint.fmpz(gcd(U, V)).factor():
        factor *= int(prime) ** (exponent // m)
    inner = surd(Fraction(U // factor**m), (Fraction(V // factor**m), d))
    return Root(sign * Fraction(factor, denominator), inner, m)


def _sum(x: Surd, y: Surd) -> Surd:
    """The sum x + y, with equal square roots collected."""
    plain, nested = [], []
    for root in (*x.terms, *y.terms):
        if root.index == 2 and not root.radicand.terms:
            plain.append((root.coefficient, int(root.radicand.rational)))
        else:
            nested.append(root)
    joined = surd(x.rational + y.rational, *plain)
    return Surd(joined.rational, joined.terms + tuple(nested))


def _pure_roots(x: AlgebraicNumber) -> Iterator[Surd]:
    """Sums c ± y^{1/m} for a y of degree 1 or 2."""
    n = x.degree
    c = Fraction(-x.polynomial[-2], n * x.polynomial[-1])
    shifted = _shifted(x.polynomial, c)
    m = gcd(*(k for k, coefficient in enumerate(shifted) if coefficient and k))
    if m < 2 or n // m > 2:
        return
    a, b, d = quadratic_parts(integer_polynomial(shifted[::m]))
    for sign, inner in product(_SIGNS, repeat=2):
        yield _sum(Surd(c), Surd(Fraction(0), (_scaled_root(sign, a, inner * b, d, m),)))
        if m % 2:
            negative = _scaled_root(sign, -a, -inner * b, d, m)
            yield _sum(Surd(c), Surd(Fraction(0), (negative,)))


def _shifted(polynomial: tuple[int, ...], c: Fraction) -> list[Fraction]:
    """The coefficients of P(X + c)."""
    n = len(polynomial)
    return [
        sum((polynomial[k] * comb(k, j) * c ** (k - j) for k in range(j, n)), Fraction(0))
        for j in range(n)
    ]
