r"""Translation surfaces of regular polygons, and L-shapes.

Side k of a regular n-gon is the vector :math:`\zeta^k`, ζ = exp(2πi/n).  Coordinates lie in the
real field of 2 cos(2π/lcm(n, 4)), so that every side, length and area is exact.

=======================  =================  ========  =============================================
surface                  n                  genus     zeros of dz, curve
=======================  =================  ========  =============================================
``regular_polygon``      4g                 g         (2g − 2);  y² = x^{2g+1} − x
``regular_polygon``      4g + 2             g         (g − 1, g − 1);  y² = x^{2g+1} − 1
``double_polygon``       2g + 1             g         (2g − 2);  y² = x^{2g+1} − 1
=======================  =================  ========  =============================================

An L-shape is a rectangle with an arm to the right and an arm upwards, opposite sides glued: genus
2, one zero of order 2.  With arms of the length λ − 1 on a unit square,

.. math:: \Pi = \frac{i}{2\lambda - 1}
          \begin{pmatrix} 2\lambda^2 - 2\lambda + 1 & -2\lambda(\lambda - 1) \\
          -2\lambda(\lambda - 1) & 2\lambda^2 - 2\lambda + 1 \end{pmatrix} .

McMullen's *prototypes* of discriminant D = e² + 4bc are the quadruples of integers with b, c > 0,
0 ≤ a < gcd(b, c), c + e < b and gcd(a, b, c, e) = 1.  The square of side λ = (e + √D)/2 on the
parallelogram of (b, 0) and (a, c), opposite sides glued, is a surface on the Weierstrass curve of
discriminant D: its Jacobian has real multiplication by the quadratic order of discriminant D, with
dz as an eigenform.

References
----------
Veech, "Teichmüller curves in moduli space, Eisenstein series and an application to triangular
billiards" (1989).
Silhol, "Genus 2 translation surfaces with an order 4 automorphism" (2006), of L-shapes.
McMullen, "Teichmüller curves in genus two: discriminant and spin" (2005), section 3.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np

from igl_periods.arrays import Complexes
from igl_periods.complexes import (
    DeltaComplex,
    algebraic_number,
    cosine_and_sine,
    exact_number,
)
from igl_periods.errors import ComplexError
from igl_periods.options import checked_integer

_MOST_SIDES = 200


def regular_polygon(n: int) -> DeltaComplex:
    """Glue opposite sides of a regular polygon with unit sides by translations.

    Parameters
    ----------
    n : int
        An even number of sides, from 4 on.

    Raises
    ------
    ComplexError
        If n is odd, less than 4, or more than 200.

    Examples
    --------
    >>> regular_polygon(8)
    DeltaComplex(1 vertex, 9 edges, 6 faces; genus 2)
    """
    n = _checked_sides(n, "even")
    half = n // 2
    sides = [cosine_and_sine(k, n) for k in range(n)]
    pairs = [((0, k), (0, k + half)) for k in range(half)]
    return DeltaComplex.from_polygons([sides], pairs, edges=True)


def double_polygon(n: int) -> DeltaComplex:
    """Glue a regular polygon with unit sides to its opposite, side by side, by translations.

    Parameters
    ----------
    n : int
        An odd number of sides, from 3 on.

    Raises
    ------
    ComplexError
        If n is even, less than 3, or more than 200.

    Examples
    --------
    >>> double_polygon(7).genus
    3
    """
    n = _checked_sides(n, "odd")
    sides = [cosine_and_sine(k, n) for k in range(n)]
    opposite = [(-x, -y) for x, y in sides]
    pairs = [((0, k), (1, k)) for k in range(n)]
    return DeltaComplex.from_polygons([sides, opposite], pairs, edges=True)


def l_shape(right: Any, up: Any = None, *, width: Any = 1, height: Any = 1) -> DeltaComplex:
    """Glue opposite sides of an L, the union of two rectangles at a corner, by translations.

    The L is [0, right] × [0, height] ∪ [0, width] × [0, up]; ``l_shape(λ)`` is L(λ), a unit square
    with two arms of the length λ − 1, and ``l_shape(a, b)`` McMullen's L(a, b).

    Parameters
    ----------
    right, up : number
        As :meth:`DeltaComplex.from_polygons` takes them; ``up`` is as ``right`` by default.
    width, height : number

    Raises
    ------
    ComplexError
        If ``right`` is not larger than ``width``, ``up`` than ``height``, or one is not positive.

    Examples
    --------
    >>> from igl_periods import algebraic_number
    >>> l_shape(algebraic_number([-2, 0, 1], 1.4)).genus
    2
    """
    a, b = right, right if up is None else up
    for long, short, names in ((a, width, "right, width"), (b, height, "up, height")):
        if not float(exact_number(long)) > float(exact_number(short)) > 0.0:
            raise ComplexError(
                f"{names} = {float(exact_number(long)):.6g}, {float(exact_number(short)):.6g}: an "
                "L has arms of positive length, so that the first is larger, and the second "
                "positive."
            )
    w, h = width, height
    vertices = [(0, 0), (w, 0), (a, 0), (a, h), (w, h), (w, b), (0, b), (0, h)]
    pairs = [((0, 0), (0, 5)), ((0, 1), (0, 3)), ((0, 2), (0, 7)), ((0, 4), (0, 6))]
    return DeltaComplex.from_polygons([vertices], pairs)


def l_shape_period_matrix(length: float) -> Complexes:
    """The exact period matrix of L(λ), up to the action of Sp(4, Z); shape (2, 2).

    Raises
    ------
    ComplexError
        Unless λ > 1.
    """
    x = float(exact_number(length))
    if not x > 1.0:
        raise ComplexError(f"lambda = {x:.6g}: L(lambda) has arms of the length lambda - 1 > 0.")
    square, product = 2 * x * x - 2 * x + 1, -2 * x * (x - 1)
    return 1j / (2 * x - 1) * np.array([[square, product], [product, square]])


def weierstrass_prototypes(discriminant: int) -> list[tuple[int, int, int, int]]:
    """McMullen's prototypes (a, b, c, e) of a discriminant.

    Raises
    ------
    ComplexError
        Unless the discriminant is an integer ≡ 0 or 1 mod 4, and at least 5.

    Examples
    --------
    >>> weierstrass_prototypes(5), weierstrass_prototypes(8)
    ([(0, 1, 1, -1)], [(0, 1, 1, -2), (0, 2, 1, 0)])
    """
    D = _checked_discriminant(discriminant)
    found = []
    for e in range(-math.isqrt(D), math.isqrt(D) + 1):
        if (D - e * e) % 4 or D == e * e:
            continue
        product = (D - e * e) // 4
        for b in (b for b in range(1, product + 1) if product % b == 0):
            c = product // b
            if c + e < b:
                common = math.gcd(b, c)
                found += [(a, b, c, e) for a in range(common) if math.gcd(a, common, e) == 1]
    return found


def prototype_surface(a: int, b: int, c: int, e: int) -> DeltaComplex:
    """Glue the surface of a prototype: a square on a parallelogram.

    Raises
    ------
    ComplexError
        If (a, b, c, e) is not a prototype.

    Examples
    --------
    >>> prototype_surface(0, 1, 1, -1).genus
    2
    """
    a, b, c, e = (_integer(name, x) for name, x in zip("abce", (a, b, c, e)))
    D = e * e + 4 * b * c
    if not (b > 0 and c > 0 and (a, b, c, e) in weierstrass_prototypes(D)):
        raise ComplexError(
            f"(a, b, c, e) = ({a}, {b}, {c}, {e}) is not a prototype: b, c > 0, 0 <= a < gcd(b, "
            "c), c + e < b and gcd(a, b, c, e) = 1 are needed. "
            "weierstrass_prototypes(D) lists them."
        )
    root = math.isqrt(D)
    surd = Fraction(root) if root * root == D else algebraic_number([-D, 0, 1], math.sqrt(D))
    x = (surd + e) * Fraction(1, 2)
    square = [(a, c), (x + a, c), (x + a, x + c), (a, x + c)]
    vertices = [(0, 0), (x, 0), (b, 0), (a + b, c), *square[1:], square[0]]
    pairs = [((0, 0), (0, 5)), ((0, 1), (0, 3)), ((0, 2), (0, 7)), ((0, 4), (0, 6))]
    return DeltaComplex.from_polygons([vertices], pairs)


def _checked_sides(n: int, parity: str) -> int:
    n = _integer("n", n)
    least = 4 if parity == "even" else 3
    if not least <= n <= _MOST_SIDES or n % 2 != least % 2:
        other = "double_polygon" if parity == "even" else "regular_polygon"
        raise ComplexError(
            f"n = {n}: an {parity} number of sides from {least} to {_MOST_SIDES} is needed; for "
            f"the others there is {other}."
        )
    return n


def _checked_discriminant(discriminant: int) -> int:
    D = _integer("discriminant", discriminant)
    if D < 5 or D % 4 > 1:
        raise ComplexError(
            f"discriminant = {D}: those of real quadratic orders are 0 or 1 mod 4, from 5 on."
        )
    return D


def _integer(name: str, x: int) -> int:
    try:
        return checked_integer(name, x)
    except ValueError as error:
        raise ComplexError(str(error)) from error
