r"""Translation surfaces of billiards in rational triangles, by unfolding.

The reflections in the sides of a triangle with the angles aπ/n, bπ/n, cπ/n, n = a + b + c and
gcd(a, b, c) = 1, generate, up to translations, a dihedral group of order 2n.  The triangles gT, g
in that group, are glued: side s of gT to side s of g r_s T, r_s the reflection in side s of T.
That is a translation surface with the genus

.. math:: g = 1 + \tfrac12 \bigl( n - \gcd(a, n) - \gcd(b, n) - \gcd(c, n) \bigr)

and, over the corner of the angle aπ/n, gcd(a, n) points of the angle 2π a / gcd(a, n).

References
----------
Katok, Zemlyakov, "Topological transitivity of billiards in polygons" (1975).
Veech, "Teichmüller curves in moduli space, Eisenstein series and an application to triangular
billiards" (1989): the triangle (1, 1, n − 2) unfolds to regular n-gons.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from igl_periods.complexes import DeltaComplex, FieldElement, cosine_and_sine
from igl_periods.errors import ComplexError
from igl_periods.options import checked_integer

_LARGEST = 200
Vector = tuple[Any, Any]


def triangle_unfolding(a: int, b: int, c: int) -> DeltaComplex:
    """Unfold the triangle with angles in the ratio a : b : c; 2 (a + b + c) triangles.

    Parameters
    ----------
    a, b, c : int
        Positive.  Common factors are divided out.

    Raises
    ------
    ComplexError
        If they are not positive integers, or add up to more than 200.

    Examples
    --------
    >>> triangle_unfolding(1, 3, 4), triangle_unfolding(1, 1, 3).genus
    (DeltaComplex(6 vertices, 24 edges, 16 faces; genus 2), 2)
    """
    a, b, c = _checked_angles(a, b, c)
    n = a + b + c
    # Sides opposite the corners are as sines; corner 0 at 0, corner 1 on the axis.
    cosine, _ = cosine_and_sine(a, 2 * n)
    sine: list[FieldElement] = [cosine_and_sine(k, 2 * n)[1] for k in (a, b, c)]
    zero = Fraction(0)
    corners: list[Vector] = [(zero, zero), (sine[2], zero), (sine[1] * cosine, sine[1] * sine[0])]
    triangles = []
    for k in range(n):
        rotation = cosine_and_sine(2 * k, 2 * n)
        triangles.append([_times(rotation, z) for z in corners])
        triangles.append([_times(rotation, (x, -y)) for x, y in corners])
    # Side k of a polygon leads from corner k to k + 1.  Reflected in the side with the direction
    # φ, the triangle r(ψ) T becomes r(ψ + 2φ) of its mirror image in the axis.
    turns = [0, n - b, a]
    pairs = [
        ((2 * k, s), (2 * ((k + turn) % n) + 1, s))
        for k in range(n)
        for s, turn in enumerate(turns)
    ]
    return DeltaComplex.from_polygons(triangles, pairs)


def _times(z: Vector, w: Vector) -> Vector:
    return z[0] * w[0] - z[1] * w[1], z[0] * w[1] + z[1] * w[0]


def _checked_angles(*angles: int) -> tuple[int, int, int]:
    try:
        a, b, c = (checked_integer(name, x) for name, x in zip("abc", angles))
    except ValueError as error:
        raise ComplexError(str(error)) from error
    if min(a, b, c) < 1:
        raise ComplexError(f"the angles {a} : {b} : {c} are not positive.")
    common = math.gcd(a, b, c)
    a, b, c = a // common, b // common, c // common
    if a + b + c > _LARGEST:
        raise ComplexError(
            f"a + b + c = {a + b + c}: triangles up to {_LARGEST} are unfolded, twice as many of "
            "them are glued."
        )
    return a, b, c
