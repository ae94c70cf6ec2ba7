r"""Tori: Klein's modular invariant.

:math:`j(\tau) = 1728\, g_2^3 / (g_2^3 - 27 g_3^2)` determines the torus C / (Z + τZ) up to
isomorphism: j(i) = 1728 for the square, j(e^{2πi/3}) = 0 for the hexagonal one.

References
----------
Serre, "A course in arithmetic" (1973), chapter VII.
"""

from __future__ import annotations

from typing import Protocol, overload

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.siegel import PRECISION, PointInBalls, balls_of, bits_of, siegel_reduce

from .theta import of_genus


class SiegelBalls(Protocol):
    """A point of the Siegel upper half-space that is known in balls, such as a period matrix."""

    def to_flint(self) -> flint.acb_mat:
        """The balls."""


@overload
def j_invariant(Pi: PointInBalls) -> flint.acb: ...
@overload
def j_invariant(Pi: ArrayLike) -> complex: ...
def j_invariant(Pi: ArrayLike | PointInBalls) -> complex | flint.acb:
    """Klein's j of a surface of genus 1, j(i) = 1728 and j(e^{2πi/3}) = 0.

    Parameters
    ----------
    Pi : (1, 1) array-like, PeriodMatrix, PeriodEnclosure or acb_mat

    Returns
    -------
    complex, or acb
        Of a point that is known in balls: a ball that contains j.

    Raises
    ------
    ValueError
        If Π is not 1 × 1 (NotASiegelPointError if it is not a point of the upper half-plane).

    Examples
    --------
    >>> round(j_invariant([[2j]]).real)  # 66³
    287496
    """
    matrix = of_genus(Pi, 1)
    if balls_of(Pi) is not None:
        with flint.ctx.workprec(bits_of(Pi)):
            return siegel_reduce(Pi).matrix[0, 0].modular_j()
    with flint.ctx.workprec(PRECISION):
        return complex(flint.acb(complex(matrix[0, 0])).modular_j())


def certified_j_invariant(pm: SiegelBalls) -> tuple[complex, float] | None:
    """Klein's j and a bound of its error, from the balls of a certified period matrix.

    Parameters
    ----------
    pm : PeriodMatrix
        Of genus 1, best reduced.

    Returns
    -------
    (complex, float) or None
        None if the balls are so large that nothing is known of j.
    """
    with flint.ctx.workprec(PRECISION):
        j = pm.to_flint()[0, 0].modular_j()
        if not j.is_finite():
            return None
        error = float((j.real.rad() + j.imag.rad()).upper())
    z = complex(j)
    # The centre of the ball is rounded to double precision.
    return z, error + 2.0 * float(np.spacing(abs(z)))
