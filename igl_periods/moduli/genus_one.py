r"""Tori: Klein's modular invariant.

:math:`j(\tau) = 1728\, g_2^3 / (g_2^3 - 27 g_3^2)` determines the torus C / (Z + τZ) up to
isomorphism: j(i) = 1728 for the square, j(e^{2πi/3}) = 0 for the hexagonal one.

References
----------
Serre, "A course in arithmetic" (1973), chapter VII.
"""

from __future__ import annotations

import flint
from numpy.typing import ArrayLike

from igl_periods.siegel import PRECISION

from .theta import of_genus


def j_invariant(Pi: ArrayLike) -> complex:
    """Klein's j of a surface of genus 1, j(i) = 1728 and j(e^{2πi/3}) = 0.

    Raises
    ------
    ValueError
        If Π is not 1 × 1 (NotASiegelPointError if it is no point of the upper half-plane).

    Examples
    --------
    >>> round(j_invariant([[2j]]).real)  # 66³
    287496
    """
    matrix = of_genus(Pi, 1)
    with flint.ctx.workprec(PRECISION):
        return complex(flint.acb(complex(matrix[0, 0])).modular_j())
