r"""Triangles in the plane, from their side lengths in balls.

A triangle with a base of length c and sides a, b at its two ends has its third corner over the
point x of the base, at the height y:

.. math:: x = \frac{c^2 + (a - b)(a + b)}{2c}, \qquad y = \frac{2A}{c}, \qquad
          16 A^2 = (a + b + c)(-a + b + c)(a - b + c)(a + b - c).

Heron's product keeps the digits of y where the triangle is thin: the balls of the lengths enter
once, and differences of equal lengths are exact.
"""

from __future__ import annotations

import flint

from igl_periods.errors import ComplexError

Arb = flint.arb


def foot_and_height(base: Arb, at_start: Arb, at_end: Arb) -> tuple[Arb, Arb]:
    """Coordinates of the third corner: the start of the base at 0, its end on the positive axis.

    Raises
    ------
    ComplexError
        If it is not certain that there is such a triangle.
    """
    x = (base + (at_start - at_end) * (at_start + at_end) / base) / 2
    product = (
        (at_start + at_end + base)
        * (at_end + base - at_start)
        * (at_start + base - at_end)
        * (at_start + at_end - base)
    )
    if not product > 0:
        raise ComplexError(
            f"sides of lengths {float(base):.6g}, {float(at_start):.6g} and {float(at_end):.6g} "
            "form no triangle, or one so flat that its area is not known to be positive. Remesh "
            "the surface; lengths that are exact may be given with exact_lengths."
        )
    return x, product.sqrt() / (2 * base)
