r"""The other diagonal of a quadrilateral of two triangles, and what rounding does to it.

Triangles A B p and B A q lie on either side of their common side, the base.  Unfolded into the
plane, p and q are as far apart as

.. math:: \sqrt{(f_p - f_q)^2 + (h_p + h_q)^2},

with h the heights on the base and f the feet of the heights, counted from an end of the base.
From the nearer end both feet are short where p and q lie close to it, and keep their digits.

u is the rounding of the numbers in use: 2⁻⁵³ for doubles, less for extended numbers.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats

from .triangles import double_areas


def other_diagonal(
    base: Floats, pa: Floats, pb: Floats, qa: Floats, qb: Floats
) -> tuple[Floats, Floats]:
    """The distance of p and q, and a bound of its relative error in units of 8 u.

    Kahan's areas are right to 5.5 u, hence the sum of both heights to 7.5 u of itself; both feet
    together to 8 u (near p + near q), by :func:`foot`, and their difference is rounded; so is the
    root, to 2 u at most.  That makes 9.5 u + 8 u (near p + near q) / distance: the feet can cancel,
    where the sides are long and the distance is short.

    Parameters
    ----------
    base, pa, pb, qa, qb : (m,) float
        Lengths of the sides; doubles or extended numbers.
    """
    height = (
        double_areas(np.stack([base, pa, pb]).T) + double_areas(np.stack([base, qa, qb]).T)
    ) / base
    from_a, from_b = pa + qa, pb + qb
    near_a = from_a < from_b
    near_p, far_p = np.where(near_a, pa, pb), np.where(near_a, pb, pa)
    near_q, far_q = np.where(near_a, qa, qb), np.where(near_a, qb, qa)
    distance = np.hypot(foot(base, near_p, far_p) - foot(base, near_q, far_q), height)
    return distance, 1.25 * (1.0 + np.minimum(from_a, from_b) / distance)


def foot(base: Floats, near: Floats, far: Floats) -> Floats:
    r"""Distance along the base from its near end to the foot of the height, right to 8 u · near.

    It is ½ (base² + near² − far²) / base, at most near, and has to be computed without larger
    numbers.  Where near ≤ base it is half of

    .. math:: near \cdot \frac{near}{base} + (base - far) \cdot \frac{base + far}{base} .

    The first term is at most near, and right to 2u of itself; the second, by the triangle
    inequality |base − far| ≤ near, at most 3 near, and right to 4u of itself; the sum, at most
    2 near, is rounded once more: ½ (2 + 12 + 2) u · near = 8 u · near.  Where base < near, it is
    half of

    .. math:: base + (near - far) \cdot \frac{near + far}{base},

    with a second term, of |near − far| ≤ base, of 2 near + base ≤ 3 near at most, right to 4u of
    itself, and a sum of 2 near at most: ½ (12 + 2) u · near = 7 u · near.  (In the other case
    either formula is off by u times the square of the longer side over the shorter.)
    """
    long = near > base
    first = np.where(long, base, near * (near / base))
    end = np.where(long, near, base)
    return np.asarray(0.5 * (first + (end - far) * ((end + far) / base)))
