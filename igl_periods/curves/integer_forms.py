r"""Integer binary forms with small coefficients for the same curve.

y² = f(x, z) and y² = c f(M(x, z)) are isomorphic over the complex numbers for every rational M with
det M ≠ 0.  So for a form with integer coefficients

* for every prime p whose square divides the content or the discriminant: x ↦ p x + r z, where that
  makes f divisible by so high a power of p that it gets smaller;
* x ↦ x + k z, z ↦ z + k x as long as the sum of squares decreases.

This makes the coefficients small; it does not promise the smallest.

References
----------
Cremona, Stoll, "On the reduction theory of binary forms" (2003).
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import gcd, lcm

import flint

from .binary_forms import substituted

# Primes above this are not looked at; larger numbers are not factored.
_LARGEST_PRIME = 2000
_MOST_STEPS = 400


def primitive_form(coefficients: list[Fraction]) -> list[int]:
    """Integer coefficients without a common divisor, the last that is not 0 positive.

    Raises
    ------
    ValueError
        If all are 0.
    """
    denominator = lcm(*(c.denominator for c in coefficients))
    integers = [int(c * denominator) for c in coefficients]
    common = gcd(*integers)
    if common == 0:
        raise ValueError("a form whose coefficients are all 0 has no branch points")
    sign = 1 if next(c for c in reversed(integers) if c) > 0 else -1
    return [sign * c // common for c in integers]


def reduced_form(coefficients: list[Fraction]) -> list[int]:
    """A form with small integer coefficients of an isomorphic curve.

    Examples
    --------
    >>> reduced_form([Fraction(0), Fraction(-16), 0, 0, 0, Fraction(1), 0])  # x⁵ − 16x
    [0, -1, 0, 0, 0, 1, 0]
    """
    form = primitive_form([Fraction(c) for c in coefficients])
    for _ in range(_MOST_STEPS):
        smaller = next((f for f in _neighbours(form) if _size(f) < _size(form)), None)
        if smaller is None:
            break
        form = smaller
    return form


def _neighbours(form: list[int]) -> Iterator[list[int]]:
    for matrix in ([[1, 1], [0, 1]], [[1, -1], [0, 1]], [[1, 0], [1, 1]], [[1, 0], [-1, 1]]):
        yield _moved(form, matrix)
    for p in _primes(form):
        # Over the complex numbers also √p x is a coordinate, if all exponents have one parity.
        exponents = {k % 2 for k, c in enumerate(form) if c}
        if len(exponents) == 1:
            yield _scaled(form, p)
            yield _scaled(form[::-1], p)[::-1]
        yield _moved(form, [[p, 0], [0, 1]])
        yield _moved(form, [[1, 0], [0, p]])
        for r in range(1, min(p, 50)):
            yield _moved(form, [[p, r], [0, 1]])


def _primes(form: list[int]) -> list[int]:
    """Small primes that divide the first or the last coefficients, or the discriminant twice."""
    polynomial = flint.fmpz_poly(form)
    number = abs(int(polynomial.discriminant())) if polynomial.degree() > 0 else 1
    primes = []
    for p in _small_primes():
        if number % (p * p) == 0 if number else form[0] % p == 0 or form[-1] % p == 0:
            primes.append(p)
    return primes


def _small_primes() -> Iterator[int]:
    sieve = [True] * (_LARGEST_PRIME + 1)
    for p in range(2, _LARGEST_PRIME + 1):
        if sieve[p]:
            yield p
            for multiple in range(p * p, _LARGEST_PRIME + 1, p):
                sieve[multiple] = False


def _scaled(form: list[int], p: int) -> list[int]:
    """The form in the coordinate √p x, whose exponents have one parity."""
    first = next(k for k, c in enumerate(form) if c)
    return primitive_form([Fraction(c * p ** ((k - first) // 2)) for k, c in enumerate(form)])


def _moved(form: list[int], matrix: list[list[int]]) -> list[int]:
    moved = substituted([flint.fmpz(c) for c in form], matrix)
    return primitive_form([Fraction(int(c)) for c in moved])


def _size(form: list[int]) -> tuple[int, int]:
    return sum(c * c for c in form), sum(1 for c in form if c)
