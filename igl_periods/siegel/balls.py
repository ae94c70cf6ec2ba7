"""Period matrices in ball arithmetic: entries with rigorous radii, for python-flint."""

from __future__ import annotations

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats

from .enclosed_points import PointInBalls, balls_of
from .half_space import check_siegel_point

# What a plain array is taken to be right to, relative to √(Y_ii Y_jj).
ARRAY_ERROR = 1e-8


def to_flint(Pi: ArrayLike | PointInBalls) -> flint.acb_mat:
    """The period matrix as a matrix of complex balls, for python-flint.

    Parameters
    ----------
    Pi : (g, g) array-like, PeriodMatrix or PeriodEnclosure
        The balls of a ``PeriodMatrix`` with a certificate, and those of a ``PeriodEnclosure``,
        contain the period matrix of the polyhedral surface; those of an array are points.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.

    Examples
    --------
    >>> import igl_periods as ip
    >>> ip.to_flint([[0.5 + 1j]])
    [0.500000000000000 + 1.00000000000000j]
    """
    matrix = check_siegel_point(Pi)
    balls = balls_of(Pi)
    if balls is not None:
        return balls
    bounds = getattr(Pi, "entry_bounds", None)
    return ball_matrix(matrix, np.zeros(matrix.shape) if bounds is None else bounds)


def ball_matrix(matrix: Complexes, radius: Floats) -> flint.acb_mat:
    """The matrix of balls with these centres and radii."""
    rows = zip(matrix.tolist(), radius.tolist(), strict=True)
    return flint.acb_mat(
        [
            [
                flint.acb(flint.arb(z.real, r), flint.arb(z.imag, r))
                for z, r in zip(*row, strict=True)
            ]
            for row in rows
        ]
    )
