r"""θ of a period matrix: in balls where Π is known in balls, in floating point otherwise.

The series is summed where Π is given, so that values refer to the user's marking.  Its terms are
those in an ellipsoid of volume proportional to (det Im Π)^{−1/2}: a reduced Π has few.
"""

from __future__ import annotations

from itertools import product
from typing import Any, overload

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes
from igl_periods.options import checked_integer
from igl_periods.siegel import (
    PRECISION,
    PointInBalls,
    ball_matrix,
    balls_of,
    bits_of,
    check_siegel_point,
)

from .characteristics import twice_characteristic
from .series import Jet, theta_series

_MOST_DERIVATIVES = 4


@overload
def theta(
    Pi: PointInBalls, z: Any = 0, characteristic: Any = None, *, derivatives: int = 0
) -> Any: ...
@overload
def theta(
    Pi: ArrayLike, z: ArrayLike = 0, characteristic: Any = None, *, derivatives: int = 0
) -> Complexes: ...
def theta(Pi: Any, z: Any = 0, characteristic: Any = None, *, derivatives: int = 0) -> Any:
    r"""Riemann's theta function with characteristic, or its derivatives by z.

    .. math:: \theta_{a,b}(z, \Pi) = \sum_{n \in \mathbb{Z}^g} \exp \pi i \big( m^T \Pi\, m
              + 2\, m^T (z + \tfrac b2) \big), \qquad m = n + \tfrac a2 .

    Parameters
    ----------
    Pi : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat
        Best reduced: ``ip.siegel_reduce(Pi).matrix``, ``pm.reduced()``.
    z : (g,) array-like of complex or acb, (g, 1) acb_mat, or 0
        A point of C^g.
    characteristic : SpinStructure or pair of g numbers each, optional
        Integers are the a and b of the formula; where one entry is ½ the numbers are a/2 and b/2.
        By default 0.
    derivatives : int
        The order k of the derivatives, 0 to 4.

    Returns
    -------
    complex or acb, or (g,)·k array of complex or nested lists of acb
        The value for k = 0; all ∂_{j_1} … ∂_{j_k} θ otherwise, as an array.  Of a point that is
        known in balls: balls that contain them; acb_mat of shape (g, 1) and (g, g) for k = 1, 2.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.
    ValueError
        If z or the characteristic do not belong to genus g, or the order is none of these.
    EnumerationLimitError
        If Im Π is so small that the series has too many terms; Siegel reduce it.

    Examples
    --------
    >>> complex(theta([[1j]])).real.__round__(9)  # π^{1/4} / Γ(3/4)
    1.086434811
    >>> abs(theta([[1j]], 0.0, ([1], [1]))) < 1e-15
    True
    """
    order = checked_integer("derivatives", derivatives)
    if not 0 <= order <= _MOST_DERIVATIVES:
        raise ValueError(f"derivatives = {order}: orders 0 to {_MOST_DERIVATIVES} are computed")
    matrix, balls = check_siegel_point(Pi), balls_of(Pi)
    g = len(matrix)
    a, b = twice_characteristic(characteristic, g)
    point = _point(z, g)
    if balls is not None:
        with flint.ctx.workprec(bits_of(Pi)):
            jet = theta_series((balls + balls.transpose()) / 2, point, a, b, order)
        return _in_balls(jet, g, order)
    with flint.ctx.workprec(PRECISION):
        symmetric = ball_matrix(0.5 * (matrix + matrix.T), np.zeros(matrix.shape))
        jet = theta_series(symmetric, point, a, b, order)
    values = [complex(jet[tuple(sorted(index))]) for index in product(range(g), repeat=order)]
    return np.array(values).reshape((g,) * order) if order else values[0]


def _point(z: Any, g: int) -> flint.acb_mat:
    """Z as a column of balls."""
    if isinstance(z, flint.acb_mat):
        entries = z.entries()
    elif isinstance(z, (int, float, complex)) and z == 0:
        entries = [flint.acb(0)] * g
    else:
        entries = [_ball(x) for x in (z if isinstance(z, (list, tuple)) else np.ravel(z).tolist())]
    if len(entries) != g:
        raise ValueError(f"z is a point of C^{g}, not {len(entries)} numbers")
    return flint.acb_mat(g, 1, entries)


def _ball(x: Any) -> flint.acb:
    return x if isinstance(x, flint.acb) else flint.acb(x if _is_exact(x) else complex(x))


def _is_exact(x: Any) -> bool:
    return isinstance(x, (int, flint.arb, flint.fmpq, flint.fmpz))


def _in_balls(jet: Jet, g: int, order: int) -> Any:
    """All derivatives in balls, symmetric in their indices."""
    nested = _nested(jet, g, order, ())
    if order == 1:
        return flint.acb_mat([[entry] for entry in nested])
    return flint.acb_mat(nested) if order == 2 else nested


def _nested(jet: Jet, g: int, order: int, index: tuple[int, ...]) -> Any:
    if order == 0:
        return jet[tuple(sorted(index))]
    return [_nested(jet, g, order - 1, (*index, i)) for i in range(g)]
