r"""Names of small groups.

A group gets a name if it is isomorphic, as an exact search shows, to one of

* abelian groups, products of cyclic ones C_n;
* S_n, A_n, the quaternion and dicyclic groups Q8, Q16, Dic3, …, the dihedral groups D_n of order
  2n, the semidihedral SD16, …;
* SL(2, p), GL(2, 3), PSL(2, p), PGL(2, p), PSL(2, 8);
* V_n = ⟨x, y | x⁴, yⁿ, (xy)², (x⁻¹y)²⟩ of order 4n, the automorphisms of y² = xⁿ − 1 for even n;
* (Z/4)² ⋊ S₃ of order 96 (Fermat's quartic), the central products of C4 with D4 and with SL(2, 3),
  S3 wr C2;
* semidirect products C_m ⋊ C_k;
* direct products of two of these.

There are many groups that have no name here.

References
----------
Coxeter, Moser, "Generators and relations for discrete groups" (1980).
Bujalance, Gamboa, Gromadzki, "The full automorphism groups of hyperelliptic Riemann surfaces"
(1993), for V_n.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import lru_cache

from .finite_groups import FiniteGroup, are_isomorphic, direct_product, group_of

Builder = Callable[[], FiniteGroup]
_LARGEST_ORDER = 2500
# r, t of order 3 and 2 with (rt)⁷ = 1 on the projective line over the field of 8 elements.
_PSL_2_8 = ((1, 2, 0, 6, 5, 7, 8, 4, 3), (0, 4, 6, 8, 1, 7, 2, 5, 3))
_PRIMES = (3, 5, 7, 11, 13)


def group_name(group: FiniteGroup) -> str | None:
    """The name of a finite group; None if it is none of those that have one here.

    Examples
    --------
    >>> group_name(symmetric(4)), group_name(direct_product(cyclic(2), cyclic(3)))
    ('S4', 'C6')
    """
    if group.order > _LARGEST_ORDER:
        return None
    if group.is_abelian:
        return abelian_name(group)
    for name, build in _candidates(group.order):
        if are_isomorphic(build(), group):
            return name
    return None


def abelian_name(group: FiniteGroup) -> str:
    """An abelian group as C_a x C_b x …, a divides b …: the orders of its elements tell it.

    In the largest cyclic factor the p-parts are the largest ones of each prime; the number of
    elements with x^(p^k) = 1 gives these.
    """
    parts: list[list[int]] = []
    n = group.order
    for p in (p for p in range(2, n + 1) if n % p == 0 and all(p % q for q in range(2, p))):
        killed, k, ranks = [1], 1, []
        while p**k <= n:
            killed.append(int(sum(1 for order in group.orders.tolist() if (p**k) % order == 0)))
            ranks.append(round(math.log(killed[-1] / killed[-2], p)))
            k += 1
        # ranks[k] cyclic factors have an order of at least p^(k + 1).
        parts.append(
            sorted((p ** sum(r > j for r in ranks) for j in range(ranks[0])), reverse=True)
        )
    length = max(map(len, parts), default=0)
    factors = [math.prod(x[j] for x in parts if j < len(x)) for j in range(length)]
    return " x ".join(f"C{c}" for c in reversed(factors)) or "1"


def cyclic(n: int) -> FiniteGroup:
    """The cyclic group C_n."""
    return group_of([1 % n], lambda a, b: (a + b) % n, 0)


def symmetric(n: int) -> FiniteGroup:
    """The symmetric group S_n."""
    cycle, swap = (*range(1, n), 0), (1, 0, *range(2, n))
    return permutation_group(cycle, swap)


def alternating(n: int) -> FiniteGroup:
    """The alternating group A_n, n ≥ 3."""
    three = [(*range(k), k + 1, k + 2, k, *range(k + 3, n)) for k in range(n - 2)]
    return permutation_group(*three)


def permutation_group(*generators: tuple[int, ...]) -> FiniteGroup:
    """The group that permutations generate."""
    neutral = tuple(range(len(generators[0])))
    return group_of(generators, lambda a, b: tuple(a[i] for i in b), neutral)


def semidirect(m: int, k: int, r: int) -> FiniteGroup:
    """C_m ⋊ C_k, y x y⁻¹ = x^r with r^k = 1 modulo m."""
    powers = [pow(r, e, m) for e in range(k)]

    def compose(a: tuple[int, int], b: tuple[int, int]) -> tuple[int, int]:
        return (a[0] + powers[a[1]] * b[0]) % m, (a[1] + b[1]) % k

    return group_of([(1, 0), (0, 1)], compose, (0, 0))


def dicyclic(n: int) -> FiniteGroup:
    """The dicyclic group of order 4n, ⟨x, y | x²ⁿ, y² = xⁿ, y x y⁻¹ = x⁻¹⟩."""

    def compose(a: tuple[int, int], b: tuple[int, int]) -> tuple[int, int]:
        turned = -b[0] if a[1] else b[0]
        return (a[0] + turned + n * (a[1] & b[1])) % (2 * n), a[1] ^ b[1]

    return group_of([(1, 0), (0, 1)], compose, (0, 0))


Matrix = tuple[int, int, int, int]


def linear_group(p: int, *generators: Matrix, projective: bool = False) -> FiniteGroup:
    """The group of 2 × 2 matrices over the field of p elements, modulo scalars if projective."""

    def compose(a: Matrix, b: Matrix) -> Matrix:
        c = (a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3],
             a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3])  # fmt: skip
        scale = pow(next(x for x in c if x % p) % p, -1, p) if projective else 1
        return (c[0] * scale % p, c[1] * scale % p, c[2] * scale % p, c[3] * scale % p)

    return group_of(generators, compose, (1, 0, 0, 1))


_SHEARS: tuple[Matrix, Matrix] = ((1, 1, 0, 1), (1, 0, 1, 1))


def _primitive_root(p: int) -> int:
    return next(r for r in range(2, p) if len({pow(r, e, p) for e in range(p)}) == p - 1)


def hyperelliptic_group(n: int) -> FiniteGroup:
    """V_n: the automorphisms of y² = xⁿ − 1, n even: x → ζᵏ x^s, y → iᵉ y (x^{−n/2} if s = −1)."""

    def compose(b: tuple[int, int, int], a: tuple[int, int, int]) -> tuple[int, int, int]:
        flipped = b[0] == -1
        e = a[2] + b[2] + 2 * a[1] * flipped
        return a[0] * b[0], (b[1] + b[0] * a[1]) % n, e % 4

    return group_of([(1, 1, 0), (-1, 0, 1), (1, 0, 2)], compose, (1, 0, 0))


def fermat_group(n: int = 4) -> FiniteGroup:
    """(Z/n)² ⋊ S₃: permutations of x, y, z and their multiplication with n-th roots of unity."""

    def compose(a: tuple[int, ...], b: tuple[int, ...]) -> tuple[int, ...]:
        images = [a[b[i]] for i in range(3)]
        phases = [b[3 + i] + a[3 + b[i]] for i in range(3)]
        return (*images, *((phase - phases[0]) % n for phase in phases))

    neutral: tuple[int, ...] = (0, 1, 2, 0, 0, 0)
    return group_of([(1, 2, 0, 0, 0, 0), (1, 0, 2, 0, 0, 0), (0, 1, 2, 0, 1, 0)], compose, neutral)


def wreath_of_s3() -> FiniteGroup:
    """S3 wr C2 on 6 points."""
    return permutation_group((1, 2, 0, 3, 4, 5), (1, 0, 2, 3, 4, 5), (3, 4, 5, 0, 1, 2))


def _candidates(order: int) -> Iterator[tuple[str, Builder]]:
    """Named groups of an order that are not abelian, the shortest names first."""
    yield from _indecomposable(order)
    for d in (d for d in range(2, order) if order % d == 0):
        for name, build in [*_indecomposable(order // d), *_dihedral(order // d)]:
            for other, factor in _abelian(d):
                yield f"{name} x {other}", _product(build, factor)
    for d in (d for d in range(6, math.isqrt(order) + 1) if order % d == 0):
        for name, build in [*_indecomposable(order // d), *_dihedral(order // d)]:
            for other, factor in [*_indecomposable(d), *_dihedral(d)]:
                yield f"{name} x {other}", _product(build, factor)
    yield from _dihedral(order)
    if order % 4 == 0 and order // 4 % 2 == 0 and order >= 24:
        n = order // 4
        yield f"V{n}", lambda: hyperelliptic_group(n)
    yield from _metacyclic(order)


def _product(first: Builder, second: Builder) -> Builder:
    return lambda: direct_product(first(), second())


@lru_cache(maxsize=64)
def _indecomposable(order: int) -> tuple[tuple[str, Builder], ...]:
    """Groups with a name of their own, except dihedral ones."""
    named: dict[str, tuple[int, Builder]] = {
        **{f"S{n}": (math.factorial(n), _bound(symmetric, n)) for n in (3, 4, 5, 6)},
        **{f"A{n}": (math.factorial(n) // 2, _bound(alternating, n)) for n in (4, 5, 6)},
        "D4": (8, lambda: semidirect(4, 2, 3)),
        "GL(2,3)": (48, lambda: linear_group(3, *_SHEARS, (2, 0, 0, 1))),
        "C3:D4": (24, lambda: hyperelliptic_group(6)),
        "C4oD4": (16, lambda: linear_group(5, (2, 0, 0, 2), (0, 1, 1, 0), (1, 0, 0, 4))),
        "C4oSL(2,3)": (48, lambda: linear_group(13, *_sl_2_3_over_13(), (5, 0, 0, 5))),
        "C4^2:S3": (96, fermat_group),
        "S3 wr C2": (72, wreath_of_s3),
        "PSL(2,8)": (504, lambda: permutation_group(*_PSL_2_8)),
    }
    for p in _PRIMES:
        size = p * (p * p - 1)
        root = _primitive_root(p)
        named[f"SL(2,{p})"] = size, _bound(linear_group, p, *_SHEARS)
        if p > 5:
            named[f"PSL(2,{p})"] = size // 2, _projective(p, *_SHEARS)
            named[f"PGL(2,{p})"] = size, _projective(p, *_SHEARS, (root, 0, 0, 1))
    if order % 4 == 0 and order >= 8:
        power = order & (order - 1) == 0
        named[f"Q{order}" if power else f"Dic{order // 4}"] = order, _bound(dicyclic, order // 4)
        if power and order >= 16:
            named[f"SD{order}"] = order, _bound(semidirect, order // 2, 2, order // 4 - 1)
    return tuple((name, build) for name, (size, build) in named.items() if size == order)


def _bound(function: Callable[..., FiniteGroup], *arguments: object) -> Builder:
    return lambda: function(*arguments)


def _projective(p: int, *generators: Matrix) -> Builder:
    return lambda: linear_group(p, *generators, projective=True)


def _sl_2_3_over_13() -> tuple[Matrix, Matrix]:
    """Generators of SL(2, 3) over the field of 13 elements, i = 5: i and (1 + i + j + k)/2."""
    half = pow(2, -1, 13)
    quaternion = (1 + 5, 1 + 5, -1 + 5, 1 - 5)
    w = [x * half % 13 for x in quaternion]
    return (5, 0, 0, 8), (w[0], w[1], w[2], w[3])


def _dihedral(order: int) -> list[tuple[str, Builder]]:
    n = order // 2
    if order % 2 or n < 5:
        return []
    return [(f"D{n}", lambda: semidirect(n, 2, n - 1))]


def _abelian(order: int) -> Iterator[tuple[str, Builder]]:
    """Abelian groups of an order with at most three factors."""
    for a in (a for a in range(1, order + 1) if order % a == 0):
        for b in (b for b in range(1, a + 1) if (order // a) % b == 0 and a % b == 0):
            c = order // a // b
            if b % c == 0:
                sizes = [x for x in (c, b, a) if x > 1]
                yield " x ".join(f"C{x}" for x in sizes), _cyclic_product(sizes)


def _cyclic_product(sizes: list[int]) -> Builder:
    def build() -> FiniteGroup:
        group = cyclic(sizes[0])
        for n in sizes[1:]:
            group = direct_product(group, cyclic(n))
        return group

    return build


def _metacyclic(order: int) -> Iterator[tuple[str, Builder]]:
    """C_m ⋊ C_k with all actions; faithful ones have no suffix, the others their r."""
    for m in (m for m in range(order // 2, 2, -1) if order % m == 0):
        k = order // m
        for r in (r for r in range(2, m) if math.gcd(r, m) == 1 and pow(r, k, m) == 1):
            yield f"C{m}:C{k} (r={r})", _bound(semidirect, m, k, r)
