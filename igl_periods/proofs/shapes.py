r"""Shapes of triangles in balls, from the balls of their sides.

Twice the area of a triangle with the sides a ≥ b ≥ c is, by Kahan's formula,

.. math:: \tfrac12 \sqrt{(a + (b + c))\,(c - (a - b))\,(c + (a - b))\,(a + (b - c))} ,

and the cotangent of the angle opposite the side a, b ≥ c the other two,

.. math:: \frac{c^2 + (b - a)(b + a)}{4 A} .

Both are identities, whatever the order of the sides; the order is what keeps digits.  The
difference a − b is exact in floating point, since b ≥ a/2 in every triangle (Sterbenz); so the
area of a triangle whose sides are exact floating-point numbers is known to a few units in the last
place, however thin it is.

References
----------
Kahan, "Miscalculating area and angles of a needle-like triangle" (2014).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from igl_periods.errors import ComplexError

from .midpoint_radius import UNIT, Balls


def double_areas(lengths: Balls) -> Balls:
    """Twice the area of each triangle, of radius ∞ where it may be degenerate; (m,).

    Parameters
    ----------
    lengths : (m, 3) balls
    """
    l0, l1, l2 = lengths.mid.T
    high, low = np.maximum(l0, l1), np.minimum(l0, l1)
    # All three sides get the largest radius, which then need not be sorted with them.
    r0, r1, r2 = lengths.rad.T
    radius = np.maximum(np.maximum(r0, r1), r2)
    a = Balls(np.maximum(high, l2), radius)
    b = Balls(np.maximum(low, np.minimum(high, l2)), radius)
    c = Balls(np.minimum(low, l2), radius)
    difference = _exact_difference(a, b)
    product = (a + (b + c)) * (c - difference) * ((c + difference) * (a + (b - c)))
    product.rad[~(c - difference).is_positive()] = np.inf
    return product.sqrt().scaled(0.5)


def cotangents(lengths: Balls, double_area: Balls, corner: NDArray[np.int64]) -> Balls:
    """The cotangent of the angle at one corner of each triangle; (m,).

    Parameters
    ----------
    lengths : (m, 3) balls
    double_area : (m,) balls
        :func:`double_areas`.
    corner : (m,) int
    """
    row = np.arange(corner.size)
    a, one, other = (lengths[row, (corner + s) % 3] for s in range(3))
    swapped = one.mid < other.mid
    b = _chosen(swapped, other, one)
    c = _chosen(swapped, one, other)
    return (c * c + (b - a) * (b + a)) / double_area.scaled(2.0)


def foot(base: Balls, near: Balls, far: Balls) -> Balls:
    """Distance along the base from its end at the side ``near`` to the foot of the height."""
    return (base + (near - far) * ((near + far) / base)).scaled(0.5)


def check_known(double_area: Balls) -> None:
    """Raise ComplexError if a triangle may be degenerate, as far as its sides are known."""
    unknown = np.flatnonzero(~double_area.is_positive())
    if unknown.size:
        raise ComplexError(
            f"nothing can be proved about {unknown.size} faces, of which face {unknown[0]} is the "
            "first: rounded side lengths do not say whether they are triangles. Remesh them, or "
            "keep the triangulation as it is (delaunay=False, --no-delaunay)."
        )


def _exact_difference(a: Balls, b: Balls) -> Balls:
    """The difference of sides a ≥ b of a triangle, which is not rounded where 2 b ≥ a."""
    mid = a.mid - b.mid
    rounding = np.where(2.0 * b.mid >= a.mid, 0.0, UNIT * mid)
    return Balls(mid, (a.rad + b.rad + rounding) * (1.0 + 2.0**-48))


def _chosen(condition: NDArray[np.bool_], one: Balls, other: Balls) -> Balls:
    return Balls(np.where(condition, one.mid, other.mid), np.where(condition, one.rad, other.rad))
