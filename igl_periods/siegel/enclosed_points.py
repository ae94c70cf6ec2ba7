r"""Points of the Siegel upper half-space that are known in balls.

A matrix of complex balls stands for all matrices whose entries lie in them, and whatever is
computed from it in ball arithmetic is true of each of these.  Where a function takes a period
matrix it also takes

* a matrix of balls itself, ``flint.acb_mat``;
* an object with such a ``matrix`` and the precision ``bits`` that it was computed with, which can
  change its marking (:class:`EnclosedPoint`), as
  :class:`~igl_periods.enclosures.enclosure.PeriodEnclosure` is.
"""

from __future__ import annotations

from typing import Any, Protocol, TypeAlias

import flint
import numpy as np

from igl_periods.arrays import Complexes, Ints

from .ball_action import moved_balls

PRECISION = 96
# Bits that a computation takes beyond those that are known.
_GUARD_BITS = 32


class EnclosedPoint(Protocol):
    """A point of the Siegel upper half-space that is known in balls."""

    @property
    def bits(self) -> int:
        """The precision that the balls were computed with."""

    @property
    def matrix(self) -> flint.acb_mat:
        """Balls that contain the entries of the exact matrix; (g, g)."""

    def change_basis(self, gamma: Any) -> EnclosedPoint:
        """The same surface in another marking."""


PointInBalls: TypeAlias = flint.acb_mat | EnclosedPoint


def balls_of(Pi: Any) -> flint.acb_mat | None:
    """The balls of a point that is known in balls; None of an array, or what is like one."""
    if isinstance(Pi, flint.acb_mat):
        return Pi
    balls = getattr(Pi, "matrix", None)
    return balls if isinstance(balls, flint.acb_mat) else None


def bits_of(Pi: Any) -> int:
    """A precision that loses nothing of what is known about a point.

    At least ``PRECISION``; of a matrix of balls at least the working precision too, since what is
    exact is known to any number of digits.
    """
    if not isinstance(Pi, flint.acb_mat):
        return max(int(getattr(Pi, "bits", PRECISION)), PRECISION)
    parts = [x for z in Pi.entries() for x in (z.real, z.imag)]
    known = [x.bits() if x.is_exact() else max(x.bits(), x.rel_accuracy_bits()) for x in parts]
    return max(PRECISION, flint.ctx.prec, max(known, default=0) + _GUARD_BITS)


def midpoint(balls: flint.acb_mat) -> Complexes:
    """The midpoints of the balls, rounded to double precision."""
    entries = [complex(z.mid()) for z in balls.entries()]
    return np.array(entries, dtype=np.complex128).reshape(balls.nrows(), balls.ncols())


def in_marking(Pi: Any, gamma: Ints) -> flint.acb_mat:
    """γ · Π in balls, for a γ in Sp(2g, Z): by the point itself if it can, which is sharper.

    Raises
    ------
    NotASiegelPointError
        If the balls are so large that nothing is known of γ · Π.
    """
    if isinstance(Pi, flint.acb_mat):
        return moved_balls(gamma, Pi, bits_of(Pi))
    return Pi.change_basis(gamma).matrix
