r"""Weierstrass equations of a torus.

A curve with the invariant j ≠ 0, 1728 is, up to a twist, y² = x³ − 3k x + 2k with k = j/(j − 1728);
the substitution x ↦ x/t, with y scaled, takes the coefficients (A, B) to (A t², B t³).  If j is
rational a t is taken for which they are integers and no prime could be divided out.
"""

from __future__ import annotations

from fractions import Fraction

import flint

from igl_periods.recognition import AlgebraicNumber


def weierstrass_coefficients(j: flint.acb) -> tuple[flint.acb, flint.acb]:
    """A and B of a curve y² = x³ + A x + B with this j, in balls; j is neither 0 nor 1728."""
    k = j / (j - 1728)
    return -3 * k, 2 * k


def minimal_coefficients(j: Fraction) -> tuple[int, int]:
    """A and B, integers, of a curve y² = x³ + A x + B with a rational j.

    Examples
    --------
    >>> minimal_coefficients(Fraction(287496))  # j(2i) = 66³
    (-11, 14)
    >>> minimal_coefficients(Fraction(1728)), minimal_coefficients(Fraction(0))
    ((-1, 0), (0, -1))
    """
    if j == 1728:
        return -1, 0
    if j == 0:
        return 0, -1
    k = j / (j - 1728)
    A, B = -3 * k, 2 * k
    t = A.denominator * B.denominator
    a, b = int(A * t**2), int(B * t**3)
    for p, _ in flint.fmpz(a * b).factor():
        while a % int(p) ** 2 == 0 and b % int(p) ** 3 == 0:
            a, b = a // int(p) ** 2, b // int(p) ** 3
    return (a, b) if b > 0 else (a, -b)


def rational(x: AlgebraicNumber | None) -> Fraction | None:
    """The fraction that a recognised number is; None if it is none."""
    if x is None or not x.is_rational:
        return None
    return Fraction(-x.polynomial[0], x.polynomial[1])
