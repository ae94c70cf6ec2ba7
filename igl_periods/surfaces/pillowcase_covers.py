r"""Covers of the pillowcase: half-translation surfaces tiled by squares.

The *pillowcase* is the sphere of two unit squares glued along all four sides: it is flat but for
four points of the angle π.  A cover of degree d that is branched over these points only is given by
four permutations of its sheets: going once around the corner i, counterclockwise, leads from sheet
k to sheet g_i(k).  First g_0, then g_1, g_2 and g_3 lead back: the product is 1.  A cycle of length
l of g_i is a point of the angle lπ, a zero of dz² of the order l − 2.

Sheet k has a front square and a back square.  Corner i of the front lies between its sides i − 1
and i, and its side s is glued to the back square of sheet σ_s(k).  A walk around the corner i
crosses side i − 1 and comes back through side i, so that g_i is σ_{i−1} followed by the inverse of
σ_i.  With σ_3 = 1 this gives σ_0, σ_1 and σ_2, one after the other.

References
----------
Eskin, Okounkov, "Pillowcases and quasimodular forms" (2006).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints
from igl_periods.complexes import DeltaComplex, components_of
from igl_periods.errors import ComplexError

from .permutations import read_permutations
from .square_tiled import placed_squares

# The side of the back square, seen from behind, at each side of the front.
_BACK = (0, 3, 2, 1)


def pillowcase_cover(
    g0: str | ArrayLike,
    g1: str | ArrayLike,
    g2: str | ArrayLike,
    g3: str | ArrayLike | None = None,
    n: int = 1,
) -> DeltaComplex:
    """Glue the cover of the pillowcase with these permutations; 2d squares of side 1.

    Parameters
    ----------
    g0, g1, g2, g3 : str or (d,) array-like of int
        Cycles counted from 1, as ``"(1,2)(3,4)"``, or images counted from 0.  The last one follows
        from the others.
    n : int
        Each square is divided into n × n.

    Raises
    ------
    ComplexError
        If they are not permutations of the same sheets, their product (first g0, then g1, …) is not
        1, the cover is not connected, or ``n < 1``.

    Examples
    --------
    >>> pillowcase_cover("(1,2)", "(1,2)", "(1,2)", "(1,2)").genus
    1
    """
    given = {"g0": g0, "g1": g1, "g2": g2} | ({} if g3 is None else {"g3": g3})
    g = read_permutations(given)
    sheets = np.arange(g[0].size)
    sigma, back = [], sheets
    for permutation in g[:3]:
        # g_i is σ_{i−1}, then σ_i⁻¹: σ_i sends g_i(k) to σ_{i−1}(k).
        to: Ints = np.empty_like(sheets)
        to[permutation] = back
        sigma.append(to)
        back = to
    if g3 is not None and not np.array_equal(g[3], sigma[2]):
        k = int(np.flatnonzero(g[3] != sigma[2])[0])
        raise ComplexError(
            "the product of the permutations is not 1: after g0, g1 and g2 the last one has to "
            f"lead from sheet {k + 1} to {sigma[2][k] + 1}, and g3 leads to {g[3][k] + 1}. "
            "Products are: first g0, then g1, g2, g3."
        )
    sigma.append(sheets)
    parts, _ = components_of(np.tile(sheets, 3), np.concatenate(sigma[:3]), sheets.size)
    if parts > 1:
        raise ComplexError(f"the cover is not connected: its sheets fall into {parts} parts.")
    d = sheets.size
    pairs = [
        ((k, side), (d + int(sigma[side][k]), _BACK[side])) for k in range(d) for side in range(4)
    ]
    places = [(k, row) for row in (0, 1) for k in range(d)]
    return placed_squares(places, pairs, n)
