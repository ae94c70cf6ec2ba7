"""Unit squares glued along their sides, and regular grids.

Sides of a square are counted 0 bottom, 1 right, 2 top, 3 left.  Every square is cut into n × n
smaller ones and these into two triangles each.  The diagonals have weight 0.
"""

from __future__ import annotations

import operator
from collections.abc import Iterable, Sequence

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import ComplexError

from .gluings import MOST_TRIANGLES


def squares(gluing: Iterable[Sequence[Sequence[int]]], n: int) -> tuple[Floats, Ints]:
    """Unit squares glued as told, each divided into n × n squares of two right triangles.

    Parameters
    ----------
    gluing : iterable of ((square, side), (square, side))
        Sides are 0 bottom, 1 right, 2 top, 3 left; glued sides run in opposite directions.
    n : int

    Returns
    -------
    lengths : (2 n² N, 3) float
    twin : (2 n² N, 3) int

    Raises
    ------
    ComplexError
        If ``n < 1``, there would be more than 1e8 triangles, or a side does not exist, is glued
        twice, to itself, or not at all.
    """
    n = _checked_subdivision(n)
    side_twin = _glued_sides(gluing)
    n_squares = len(side_twin) // 4
    if 2 * n_squares * n * n > MOST_TRIANGLES:
        raise ComplexError(
            f"{n_squares} squares divided into {n} x {n} squares have {2 * n_squares * n * n:.3g} "
            f"triangles, and up to {MOST_TRIANGLES:.3g} are made."
        )
    # Cell (k, i, j): column i, row j of square k.  Its diagonal runs from bottom left to top
    # right; the lower triangle has corners (bottom left, bottom right, top right), the upper one
    # (bottom left, top right, top left).
    k, i, j = np.meshgrid(np.arange(n_squares), np.arange(n), np.arange(n), indexing="ij")
    lower = 2 * ((k * n + i) * n + j)
    upper = lower + 1
    bottom, right, top, left = 3 * lower + 2, 3 * lower, 3 * upper, 3 * upper + 1
    twin = np.empty(6 * n_squares * n * n, dtype=np.int64)
    _glue(twin, 3 * lower + 1, 3 * upper + 2)
    _glue(twin, right[:, :-1, :], left[:, 1:, :])
    _glue(twin, top[:, :, :-1], bottom[:, :, 1:])
    # The small sides along each side of each square, counterclockwise: shape (4 N, n).
    sides = np.stack(
        [bottom[:, :, 0], right[:, -1, :], top[:, ::-1, -1], left[:, 0, ::-1]], axis=1
    ).reshape(-1, n)
    _glue(twin, sides, sides[side_twin, ::-1])
    lengths = np.empty((2 * n_squares * n * n, 3))
    lengths[0::2], lengths[1::2] = (1.0, np.sqrt(2.0), 1.0), (1.0, 1.0, np.sqrt(2.0))
    return lengths / n, twin.reshape(-1, 3)


def _checked_subdivision(n: int) -> int:
    try:
        number = operator.index(n)
    except TypeError:
        number = 0
    if number < 1 or isinstance(n, bool):
        raise ComplexError(f"n = {n!r}: each square is divided into n x n squares, n >= 1.")
    return number


def _glue(twin: Ints, one: Ints, other: Ints) -> None:
    twin[one], twin[other] = other, one


def _glued_sides(gluing: Iterable[Sequence[Sequence[int]]]) -> Ints:
    """The involution of the sides ``4 square + side``."""
    try:
        pairs = np.asarray([np.asarray(pair) for pair in gluing])
    except (ValueError, TypeError):
        pairs = np.zeros(0)
    if pairs.ndim != 3 or pairs.shape[1:] != (2, 2) or not np.issubdtype(pairs.dtype, np.integer):
        raise ComplexError(
            "a gluing of squares is a list of pairs ((square, side), (square, side))."
        )
    square, side = pairs[..., 0], pairs[..., 1]
    if square.min() < 0 or side.min() < 0 or side.max() > 3:
        raise ComplexError(
            "squares are numbered from 0, and sides are 0 bottom, 1 right, 2 top, 3 left."
        )
    if square.max() >= 2 * square.size:
        raise ComplexError(
            f"square {square.max()} is named, but {square.size} glued sides are those of "
            f"{square.size // 4} squares."
        )
    sides = 4 * square + side
    count = np.bincount(sides.ravel(), minlength=4 * (int(square.max()) + 1))
    wrong = np.flatnonzero(count != 1)
    if wrong.size:
        s = int(wrong[0])
        raise ComplexError(
            f"side {s % 4} of square {s // 4} is glued {count[s]} times ({wrong.size} such sides); "
            "every side of every square is glued once, and to another side."
        )
    side_twin = np.empty(count.size, dtype=np.int64)
    side_twin[sides[:, 0]], side_twin[sides[:, 1]] = sides[:, 1], sides[:, 0]
    return side_twin


def periodic_grid(n: int, m: int) -> Ints:
    """Triangulate a periodic n × m grid of vertices ``i m + j``; shape (2 n m, 3).

    The triangles of a cell are (i, j), (i + 1, j), (i, j + 1) and (i + 1, j), (i + 1, j + 1),
    (i, j + 1).
    """
    vertex = np.arange(n * m).reshape(n, m)
    right, up = np.roll(vertex, -1, 0), np.roll(vertex, -1, 1)
    across = np.roll(right, -1, 1)
    return np.stack([vertex, right, up, right, across, up], axis=-1).reshape(-1, 3)
