"""Euclidean triangles known by their side lengths: area, cotangents, angles, mollification.

All functions take ``lengths`` of shape (m, 3), the side opposite each corner, and are accurate
for triangles as thin as their floating-point lengths can describe.  The one thing that matters
there is to take differences of lengths *before* anything is squared or added, since differences
of nearby floating-point numbers are exact.

References
----------
Kahan, "Miscalculating area and angles of a needle-like triangle" (2014).
Sharp, Crane, "A Laplacian for nonmanifold triangle meshes" (2020), section 4.5, for intrinsic
mollification.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats
from igl_periods.errors import ComplexError

# A slack below this fraction of the longest side is lost in the rounding of the lengths.
_SMALLEST_SLACK = 5e-15
# The slack that mollification leaves, and the most it may add, in units of the mean length.
_MOLLIFIED_SLACK = 1e-13
_LARGEST_MOLLIFICATION = 1e-6
# Triangles handled at once: what is computed in between stays in the cache.
_AT_ONCE = 16_384


def _in_blocks(
    function: Callable[[Floats], NDArray[Any]],
) -> Callable[[Floats], NDArray[Any]]:
    """The same function of rows, evaluated on blocks of them."""

    @wraps(function)
    def evaluated(lengths: Floats) -> NDArray[Any]:
        first = function(lengths[:_AT_ONCE])
        if len(lengths) <= _AT_ONCE:
            return first
        values = np.empty((len(lengths), *first.shape[1:]), dtype=first.dtype)
        values[:_AT_ONCE] = first
        for start in range(_AT_ONCE, len(lengths), _AT_ONCE):
            block = slice(start, start + _AT_ONCE)
            values[block] = function(lengths[block])
        return values

    return evaluated


@_in_blocks
def double_areas(lengths: Floats) -> Floats:
    """Twice the area of each triangle, by Kahan's formula; 0 where it is degenerate.  (m,)."""
    return _double_areas(*_descending(lengths))


@_in_blocks
def cotangents(lengths: Floats) -> Floats:
    """Cotangents of the angles, ``[f, s]`` at corner ``s``; shape (m, 3).

    Equal to ``2 * igl.cotmatrix_entries(lengths)`` up to rounding.  Computed as
    ``(c² + (b − a)(b + a)) / 4A``, where a is the side opposite the angle and b ≥ c are the other
    two: with the squares taken first, the right angles of a needle drown in rounding, and
    Delaunay flips must not be decided by rounding.
    """
    return _cotangents(lengths, double_areas(lengths))


def apexes(lengths: Floats) -> tuple[Floats, Floats]:
    """Corner 2 of triangles as side 2 sees it, which runs from 0 to 1; two arrays of shape (m,).

    Returns
    -------
    foot, height : (m,) float
        Where the foot of the height lies on side 2, from 0 to 1 if it is inside, and the height.
    """
    l0, l1, l2 = lengths.T
    # Differences of lengths first: that keeps digits on thin triangles.
    return 0.5 * (1.0 + ((l1 - l0) / l2) * ((l1 + l0) / l2)), double_areas(lengths) / l2


@_in_blocks
def angles(lengths: Floats) -> Floats:
    """Angles in radians, ``[f, s]`` at corner ``s``; shape (m, 3)."""
    return np.arctan2(1.0, cotangents(lengths))


@_in_blocks
def slacks(lengths: Floats) -> Floats:
    """The slack b + c − a ≥ 0 of the triangle inequality, a the longest side; shape (m,)."""
    a, b, c = _descending(lengths)
    return c - (a - b)


@_in_blocks
def is_strict(lengths: Floats) -> NDArray[np.bool_]:
    """Whether the triangle inequality holds with more slack than rounding can hide; shape (m,)."""
    return _is_strict(*_descending(lengths))


@_in_blocks
def length_sensitivity(lengths: Floats) -> Floats:
    """The relative change of metric of each triangle per relative change of its sides; (m,)."""
    return _length_sensitivity(lengths, double_areas(lengths))


def shapes(lengths: Floats) -> tuple[NDArray[np.bool_], Floats, Floats]:
    """:func:`is_strict`, :func:`cotangents` and :func:`length_sensitivity`, from one area.

    Where a triangle is not strict, the other two may be anything.
    """
    descending = _descending(lengths)
    area = _double_areas(*descending)
    with np.errstate(divide="ignore", invalid="ignore"):
        cot, sensitivity = _cotangents(lengths, area), _length_sensitivity(lengths, area)
    return _is_strict(*descending), cot, sensitivity


def mollify(lengths: Floats) -> tuple[Floats, float]:
    """Add one small length to all sides, so that every triangle inequality is strict.

    Nothing is added where every slack exceeds 5e-15 of the longest side of its triangle.
    Otherwise slacks of 1e-13 of the mean length, and of 1e-14 of the longest side, are aimed at.

    Returns
    -------
    lengths : (m, 3) float
    delta : float
        The length that was added.

    Raises
    ------
    ComplexError
        If more than 1e-6 of the mean length would be needed.
    """
    if is_strict(lengths).all():
        return lengths, 0.0
    slack, mean = slacks(lengths), float(lengths.mean())
    wanted = np.maximum(_MOLLIFIED_SLACK * mean, 2.0 * _SMALLEST_SLACK * lengths.max(axis=1))
    worst = int(np.argmax(wanted - slack))
    delta = float(wanted[worst] - slack[worst])
    # The sums are rounded, so the least that should do may have to be doubled.
    while 0.0 < delta <= _LARGEST_MOLLIFICATION * mean and not is_strict(lengths + delta).all():
        delta *= 2.0
    if not 0.0 < delta <= _LARGEST_MOLLIFICATION * mean:
        raise ComplexError(
            f"face {worst} is degenerate: its sides {_in_words(lengths[worst])} miss the strict "
            f"triangle inequality by {max(0.0, -slack[worst]):.3g}, where the mean length is "
            f"{mean:.3g}, and at most {_LARGEST_MOLLIFICATION:g} of that is mended by "
            "mollification. Are these the lengths of one surface, the coordinates not all equal?"
        )
    return lengths + delta, delta


def _in_words(sides: Floats) -> str:
    return ", ".join(f"{side:.6g}" for side in sides)


def _double_areas(a: Floats, b: Floats, c: Floats) -> Floats:
    product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))
    return np.asarray(0.5 * np.sqrt(np.maximum(product, 0.0)))


def _cotangents(lengths: Floats, double_area: Floats) -> Floats:
    quadruple_area = 2.0 * double_area
    cot = np.empty_like(lengths)
    for s in range(3):
        a, l1, l2 = lengths[:, s], lengths[:, s - 2], lengths[:, s - 1]
        b, c = np.maximum(l1, l2), np.minimum(l1, l2)
        cot[:, s] = (c * c + (b - a) * (b + a)) / quadruple_area
    return cot


def _is_strict(a: Floats, b: Floats, c: Floats) -> NDArray[np.bool_]:
    return np.asarray(c - (a - b) > _SMALLEST_SLACK * a)


def _length_sensitivity(lengths: Floats, double_area: Floats) -> Floats:
    l0, l1, l2 = lengths.T
    return np.asarray(2.0 * (l0 * l1 * l2) * (l0 + l1 + l2) / double_area**2)


def _descending(lengths: Floats) -> tuple[Floats, Floats, Floats]:
    l0, l1, l2 = lengths.T
    high, low = np.maximum(l0, l1), np.minimum(l0, l1)
    return np.maximum(high, l2), np.maximum(low, np.minimum(high, l2)), np.minimum(low, l2)
