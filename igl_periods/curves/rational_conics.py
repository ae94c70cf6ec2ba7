r"""Rational points of plane conics, and parametrizations.

A conic over Q is diagonal, a x² + b y² + c z² = 0, in suitable coordinates, with a, b, c
square-free and without common divisors.  By Legendre it has a rational point iff not all signs
agree and −bc, −ca, −ab are squares modulo a, b, c.  Then the (x, y, z) that satisfy the congruences

.. math:: y \equiv t_a z \ (a), \qquad z \equiv t_b x \ (b), \qquad x \equiv t_c y \ (c),
          \qquad t_a^2 \equiv -c/b, \ldots

form a lattice of index |abc| on which the form is divisible by abc; a short vector of it for
|a| x² + |b| y² + |c| z² is a point.

References
----------
Cremona, Rusin, "Efficient solution of rational conics" (2003).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from math import gcd, isqrt, lcm
from typing import TypeAlias

import flint

Rows: TypeAlias = Sequence[Sequence[Fraction]]
Vector: TypeAlias = tuple[Fraction, ...]

# Numbers with more bits are not factored.
_FACTORED_BITS = 240
_COMBINATIONS = 12


class UndecidedConicError(ValueError):
    """Whether the conic has a rational point was not found out."""


def rational_point(conic: Rows) -> Vector | None:
    """A point (x, y, z) ≠ 0 with Σ A_ij x_i x_j = 0; None is a proof that there is none.

    Parameters
    ----------
    conic : (3, 3) nested sequence of Fraction
        Symmetric, of rank 3.

    Raises
    ------
    ValueError
        If the conic is degenerate.
    UndecidedConicError
        If its coefficients are too large to be factored, or no point was found though there is one.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> rational_point([[one, zero, zero], [zero, one, zero], [zero, zero, -one]]) is None
    False
    >>> rational_point([[one, zero, zero], [zero, one, zero], [zero, zero, -3 * one]]) is None
    True
    """
    diagonal, change = _diagonalised(conic)
    if 0 in diagonal:
        raise ValueError("the conic is degenerate: it is a pair of lines")
    (a, b, c), scale = _legendre(diagonal)
    if (a > 0 and b > 0 and c > 0) or (a < 0 and b < 0 and c < 0):
        return None
    roots = [_root_modulo(-c * b, b, a), _root_modulo(-a * c, c, b), _root_modulo(-b * a, a, c)]
    if None in roots:
        return None
    point = _short_zero((a, b, c), [t for t in roots if t is not None])
    scaled = [s * x for s, x in zip(scale, point, strict=True)]
    return tuple(sum((change[i][k] * scaled[k] for k in range(3)), Fraction(0)) for i in range(3))


def parametrization(conic: Rows, point: Vector) -> list[list[Fraction]]:
    """Three binary quadratic forms, the coordinates of all points of the conic.

    Lines through a point P: for a direction D the second point is (D·AD) P − 2 (P·AD) D.
    """
    pivot = next(i for i in range(3) if point[i] != 0)
    one, two = ([Fraction(int(k == i)) for k in range(3)] for i in range(3) if i != pivot)
    q11, q12, q22 = (_bilinear(conic, *pair) for pair in ((one, one), (one, two), (two, two)))
    p1, p2 = _bilinear(conic, point, one), _bilinear(conic, point, two)
    # D = s·one + t·two, lists of coefficients of t², st, s².
    return [
        [
            q22 * point[i] - 2 * p2 * two[i],
            2 * q12 * point[i] - 2 * p1 * two[i] - 2 * p2 * one[i],
            q11 * point[i] - 2 * p1 * one[i],
        ]
        for i in range(3)
    ]


def _bilinear(A: Rows, x: Sequence[Fraction], y: Sequence[Fraction]) -> Fraction:
    return sum((x[i] * A[i][j] * y[j] for i in range(3) for j in range(3)), Fraction(0))


def _diagonalised(conic: Rows) -> tuple[list[Fraction], list[list[Fraction]]]:
    """Diagonal entries and C with Cᵀ A C diagonal, by orthogonalisation."""
    units = [[Fraction(int(i == k)) for i in range(3)] for k in range(3)]
    rest, basis = list(units), []
    while rest:
        candidates = rest + [
            [a + b for a, b in zip(u, v, strict=True)] for u in rest for v in rest if u is not v
        ]
        vector = next((v for v in candidates if _bilinear(conic, v, v) != 0), None)
        if vector is None:
            basis += rest
            break
        basis.append(vector)
        norm = _bilinear(conic, vector, vector)
        moved = []
        for v in rest:
            factor = _bilinear(conic, v, vector) / norm
            moved.append([a - factor * b for a, b in zip(v, vector, strict=True)])
        rest = _independent(moved, len(rest) - 1)
    diagonal = [_bilinear(conic, v, v) for v in basis]
    return diagonal, [[v[i] for v in basis] for i in range(3)]


def _independent(vectors: list[list[Fraction]], rank: int) -> list[list[Fraction]]:
    for chosen in product(range(len(vectors)), repeat=rank):
        if list(chosen) != sorted(set(chosen)):
            continue
        picked = [vectors[i] for i in chosen]
        matrix = (
            flint.fmpq_mat([[flint.fmpq(x.numerator, x.denominator) for x in v] for v in picked])
            if picked
            else None
        )
        if matrix is None or matrix.rank() == rank:
            return picked
    raise ValueError("the conic is degenerate")


def _legendre(diagonal: list[Fraction]) -> tuple[list[int], list[Fraction]]:
    """Square-free, pairwise coprime a, b, c, and factors by which coordinates are multiplied."""
    denominator = lcm(*(x.denominator for x in diagonal))
    values, scale = [], []
    for x in diagonal:
        square, free = _square_part(int(x * denominator))
        values.append(free)
        scale.append(Fraction(1, square))
    common = gcd(*values)
    values = [v // common for v in values]
    changed = True
    while changed:
        changed = False
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            d = gcd(values[i], values[j])
            if d > 1:
                # d divides a and b: with z = d z', divide the equation by d.
                values[i], values[j], values[k] = values[i] // d, values[j] // d, values[k] * d
                scale[k] *= d
                changed = True
    return values, scale


def _square_part(n: int) -> tuple[int, int]:
    """N = s² r with r square-free."""
    s, r = 1, 1 if n > 0 else -1
    for p, e in _factors(abs(n)):
        s, r = s * p ** (e // 2), r * p ** (e % 2)
    return s, r


def _factors(n: int) -> list[tuple[int, int]]:
    smooth = flint.fmpz(n).factor(trial_limit=100_000)
    left = max((int(p) for p, _ in smooth), default=1)
    if left.bit_length() > _FACTORED_BITS and not flint.fmpz(left).is_probable_prime():
        root = isqrt(left)
        if root * root != left:
            raise UndecidedConicError(f"a number of {left.bit_length()} bits is not factored here")
    return [(int(p), int(e)) for p, e in flint.fmpz(n).factor()]


def _root_modulo(value: int, divisor: int, modulus: int) -> int | None:
    """T with t² ≡ value / divisor² modulo a square-free number; None if there is none."""
    n = abs(modulus)
    t, m = 0, 1
    for p, _ in _factors(n):
        if p == 2:
            r = value % 2 * pow(divisor, -1, 2) % 2
        else:
            square = flint.nmod(value, p) / flint.nmod(divisor, p) ** 2
            if int(square) and pow(int(square), (p - 1) // 2, p) != 1:
                return None
            r = _square_root(int(square), p)
        t, m = (t + m * ((r - t) * pow(m, -1, p) % p)) % (m * p), m * p
    return t


def _square_root(value: int, p: int) -> int:
    """Cipolla: a root of a square modulo an odd prime."""
    value %= p
    if value == 0:
        return 0
    if p % 4 == 3:
        return pow(value, (p + 1) // 4, p)
    a = 1
    while pow(a * a - value, (p - 1) // 2, p) != p - 1:
        a += 1
    w = (a * a - value) % p
    x, y, e = (1, 0), (a, 1), (p + 1) // 2
    while e:
        if e & 1:
            x = ((x[0] * y[0] + x[1] * y[1] * w) % p, (x[0] * y[1] + x[1] * y[0]) % p)
        y = ((y[0] * y[0] + y[1] * y[1] * w) % p, 2 * y[0] * y[1] % p)
        e >>= 1
    return x[0]


def _short_zero(form: tuple[int, int, int] | list[int], roots: list[int]) -> tuple[int, int, int]:
    a, b, c = form
    lattice = _congruences((a, b, c), roots)
    weights = [isqrt(abs(x) << 80) + 1 for x in (a, b, c)]
    scaled = [[x * w for x, w in zip(v, weights, strict=True)] for v in lattice]
    reduced = flint.fmpz_mat(scaled).lll().tolist()
    basis = [[int(x) // w for x, w in zip(v, weights, strict=True)] for v in reduced]
    for size in range(1, _COMBINATIONS):
        for n in product(range(-size, size + 1), repeat=3):
            if max(map(abs, n)) < size:
                continue
            x, y, z = (sum(k * v[i] for k, v in zip(n, basis, strict=True)) for i in range(3))
            if a * x * x + b * y * y + c * z * z == 0:
                return x, y, z
    raise UndecidedConicError("the conic has rational points, but no short one was found")


def _congruences(form: tuple[int, int, int], roots: list[int]) -> list[list[int]]:
    """A basis of the lattice y ≡ t_a z (a), z ≡ t_b x (b), x ≡ t_c y (c)."""
    a, b, c = (abs(x) for x in form)
    t, u, v = roots
    n = a * b * c
    # Modulo n the lattice is spanned by the solutions modulo each divisor, and by n Z³.
    rows = [[n * int(i == k) for i in range(3)] for k in range(3)]
    ea, eb, ec = (n // m * pow(n // m, -1, m) if m > 1 else 0 for m in (a, b, c))
    rows += [[ea, 0, 0], [0, ea * t, ea], [0, eb, 0], [eb, 0, eb * u], [0, 0, ec], [ec * v, ec, 0]]
    hermite = flint.fmpz_mat(rows).hnf().tolist()
    return [[int(x) for x in row] for row in hermite[:3]]
