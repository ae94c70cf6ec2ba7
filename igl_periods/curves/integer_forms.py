r"""Integer binary forms with small coefficients for the same curve.

y² = f(x, z) and y² = c f(M(x, z)) are isomorphic over the complex numbers for every rational M with
det M ≠ 0.  So of a form with integer coefficients

* *minimised at a prime p*: if a root r modulo p has a multiplicity of more than half the degree,
  f(p x + r z, z) is divisible by so high a power of p that the discriminant gets smaller.  Such
  primes divide all invariants of Igusa and Clebsch of a sextic; of other forms small primes are
  tried.  Where all exponents have one parity, √p x is a coordinate too;
* *reduced by SL₂(Z)*: with the roots θ_j of f(x, 1) and t_j = |f'(θ_j)|^{−2/(n−2)} the form
  Σ t_j |x − θ_j z|² is positive definite and covariant; where it is reduced, f is small.

This makes coefficients small; it does not promise the smallest.

References
----------
Cremona, Stoll, "On the reduction theory of binary forms" (2003).
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from math import gcd, lcm
from typing import Any

import flint

from .binary_forms import igusa_clebsch_of_sextic, substituted

Matrix = list[list[int]]

# Small primes that are always tried, and how large numbers are that are factored.
_LARGEST_PRIME = 1000
_FACTORED_BITS = 200
_MOST_STEPS = 2000
_WORD = 1 << 62
_SLACK = Fraction(10**9 + 1, 10**9)
_TRANSLATIONS: list[Matrix] = [
    [[1, 1], [0, 1]],
    [[1, -1], [0, 1]],
    [[1, 0], [1, 1]],
    [[1, 0], [-1, 1]],
]


def primitive_form(coefficients: list[Fraction] | list[int]) -> list[int]:
    """Integer coefficients without a common divisor, the last that is not 0 positive.

    Raises
    ------
    ValueError
        If all are 0.
    """
    fractions = [Fraction(c) for c in coefficients]
    denominator = lcm(*(c.denominator for c in fractions))
    integers = [int(c * denominator) for c in fractions]
    common = gcd(*integers)
    if common == 0:
        raise ValueError("a form whose coefficients are all 0 has no branch points")
    sign = 1 if next(c for c in reversed(integers) if c) > 0 else -1
    return [sign * c // common for c in integers]


def reduced_form(coefficients: list[Fraction]) -> list[int]:
    """A form with small integer coefficients of an isomorphic curve.

    Examples
    --------
    >>> reduced_form([Fraction(c) for c in (0, -16, 0, 0, 0, 1, 0)])  # x⁵ − 16x
    [0, -1, 0, 0, 0, 1, 0]
    """
    form = primitive_form(coefficients)
    for p in _bad_primes(form):
        form = _minimised(form, p)
    form = _reduced(form)
    for _ in range(_MOST_STEPS):
        smaller = next((f for f in _neighbours(form) if _size(f) < _size(form)), None)
        if smaller is None:
            break
        form = smaller
    return form


def _bad_primes(form: list[int]) -> list[int]:
    """Primes that divide all invariants of a sextic; of other forms small double ones."""
    if len(form) != 7:
        discriminant = int(flint.fmpz_poly(form).discriminant())
        return [p for p in _small_primes() if discriminant % p**2 == 0] if discriminant else []
    invariants = igusa_clebsch_of_sextic([flint.fmpq(c) for c in form])
    number = gcd(*(int(x.p) for x in invariants))
    return _prime_divisors(number) if number else []


def _prime_divisors(n: int) -> list[int]:
    """Prime divisors of a number, of its part that is hard to factor only if it is a power."""
    found, left = [], abs(n)
    for p in _small_primes():
        if left % p == 0:
            found.append(p)
            while left % p == 0:
                left //= p
    for k in range(60, 0, -1):
        root, exact = _integer_root(left, k)
        if exact and root > 1:
            if root.bit_length() <= _FACTORED_BITS or flint.fmpz(root).is_probable_prime():
                found += [int(p) for p, _ in flint.fmpz(root).factor()]
            break
    return found


def _integer_root(n: int, k: int) -> tuple[int, bool]:
    root = int(flint.fmpz(n).root(k))
    return root, root**k == n


def _minimised(form: list[int], p: int) -> list[int]:
    """Substitutions x ↦ p x + r z and z ↦ p z as long as they make the discriminant smaller."""
    degree = len(form) - 1
    for _ in range(_MOST_STEPS):
        for matrix in _multiple_roots(form, p):
            moved = substituted([flint.fmpz(c) for c in form], matrix)
            content = gcd(*(int(c) for c in moved))
            power = 0
            while content % p == 0:
                content, power = content // p, power + 1
            if 2 * power > degree:
                form = primitive_form([int(c) for c in moved])
                break
        else:
            return form
    return form


def _multiple_roots(form: list[int], p: int) -> Iterator[Matrix]:
    """Where modulo p a root has more than half of the degree: ∞, or a finite one."""
    yield [[1, 0], [0, p]]
    polynomial = _modulo(form, p)
    if polynomial is None:
        return
    if polynomial.degree() < 1:
        yield [[p, 0], [0, 1]]
        return
    for factor, multiplicity in polynomial.factor()[1]:
        if factor.degree() == 1 and 2 * multiplicity >= len(form) - 1:
            r = int(-factor[0] / factor[1]) % p
            yield [[p, r if 2 * r < p else r - p], [0, 1]]


def _modulo(form: list[int], p: int) -> Any:
    """The polynomial modulo p; None for large p where python-flint (before 0.7) has none."""
    if p < _WORD:
        return flint.nmod_poly(form, p)
    rings: Any = getattr(flint, "fmpz_mod_poly_ctx", None)
    return None if rings is None else rings(p)(form)


def _reduced(form: list[int]) -> list[int]:
    """By SL₂(Z), to where the covariant positive definite form is reduced."""
    for _ in range(_MOST_STEPS):
        a, b, c = _covariant(form)
        # What is on the boundary to within rounding stays there.
        if abs(b) > a * _SLACK:
            form = _moved(form, [[1, -round(b / (2 * a))], [0, 1]])
            continue
        if a > c * _SLACK:
            form = _moved(form, [[0, 1], [-1, 0]])
            continue
        return form
    return form


def _covariant(form: list[int]) -> tuple[Fraction, Fraction, Fraction]:
    """The form a x² + b x z + c z² = Σ t_j |x − θ_j z|²; a root at ∞ has t |z|²."""
    n = len(form) - 1
    degree = max(k for k, c in enumerate(form) if c)
    bits = 4 * max(abs(c).bit_length() for c in form) + 64
    with flint.ctx.workprec(bits):
        polynomial = flint.fmpz_poly(form[: degree + 1])
        slope = polynomial.derivative()
        a = b = c = flint.arb(0)
        roots: Any = polynomial.complex_roots()
        for theta, _ in roots:
            t = abs(slope(theta)) ** flint.arb(flint.fmpq(-2, n - 2))
            a, b, c = a + t, b - 2 * t * theta.real, c + t * abs(theta) ** 2
        if degree < n:
            # The limit of a root that goes to ∞: t |θ|² of a form with the leading coefficient f_d.
            c += flint.arb(abs(form[degree])) ** flint.arb(flint.fmpq(-2, n - 2))
    return _fraction(a), _fraction(b), _fraction(c)


def _fraction(x: flint.arb) -> Fraction:
    mantissa, exponent = x.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _neighbours(form: list[int]) -> Iterator[list[int]]:
    for matrix in _TRANSLATIONS:
        yield _moved(form, matrix)
    ends = next(c for c in form if c) * next(c for c in reversed(form) if c)
    for p in (q for q in _small_primes() if ends % q == 0):
        # Over the complex numbers also √p x is a coordinate, if all exponents have one parity.
        if len({k % 2 for k, c in enumerate(form) if c}) == 1:
            yield _scaled(form, p)
            yield _scaled(form[::-1], p)[::-1]
        yield _moved(form, [[p, 0], [0, 1]])
        yield _moved(form, [[1, 0], [0, p]])


@cache
def _small_primes() -> tuple[int, ...]:
    return tuple(p for p in range(2, _LARGEST_PRIME) if flint.fmpz(p).is_prime())


def _scaled(form: list[int], p: int) -> list[int]:
    """The form in the coordinate √p x, whose exponents have one parity."""
    first = next(k for k, c in enumerate(form) if c)
    return primitive_form([c * p ** ((k - first) // 2) for k, c in enumerate(form)])


def _moved(form: list[int], matrix: Matrix) -> list[int]:
    moved = substituted([flint.fmpz(c) for c in form], matrix)
    return primitive_form([int(c) for c in moved])


def _size(form: list[int]) -> tuple[int, int]:
    return sum(c * c for c in form), sum(1 for c in form if c)
