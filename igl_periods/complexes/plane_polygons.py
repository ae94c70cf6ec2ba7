r"""Polygons in the plane, decided exactly: orientation, crossings, triangles.

Everything rests on the sign of the determinant of three points,

.. math:: [p, q, r] = (q - p) \times (r - p),

which double precision settles where the points are far from a line, and exact arithmetic otherwise
(balls that contain 0 count as 0).  Corners may be straight: marked points on a side are vertices of
the surface.

A polygon is divided by cutting off ears.  An *ear* is a corner with a positive triangle that
contains no other corner, not even on its boundary; what is left is a polygon of the same kind, and
there always is an ear, since every such polygon has a triangulation by all of its corners.  Of the
ears the one with the shortest new side is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.errors import ComplexError

from .exact_numbers import sign_of

# Determinants above this part of the squared size are positive also without rounding.
_CERTAIN = 1e-12
_MOST_CORNERS = 2000


@dataclass(frozen=True, eq=False)
class PlanePolygon:
    """A closed polygon with exact coordinates: rational, algebraic, or balls.

    Attributes
    ----------
    name : str
        For messages.
    corners : sequence of (x, y)
    """

    name: str
    corners: Sequence[tuple[Any, Any]]

    @cached_property
    def xy(self) -> Floats:
        """The corners in floating point, seen from the first one; (d, 2)."""
        # Far from the origin the difference has to be taken before rounding.
        x0, y0 = self.corners[0]
        return np.array([[float(x - x0), float(y - y0)] for x, y in self.corners])

    @cached_property
    def _margin(self) -> float:
        return _CERTAIN * float(np.abs(self.xy).max() ** 2)

    def orientation(self, i: int, j: int, k: int) -> int:
        """The sign of the determinant of three corners."""
        (px, py), (qx, qy), (rx, ry) = self.xy[[i, j, k]].tolist()
        value = (qx - px) * (ry - py) - (qy - py) * (rx - px)
        if abs(value) > self._margin:
            return 1 if value > 0 else -1
        p, q, r = (self.corners[c] for c in (i, j, k))
        return sign_of((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    def is_between(self, i: int, j: int, k: int) -> bool:
        """Whether corner k, on the line of i and j, lies between them, ends included."""
        p, q, r = (self.corners[c] for c in (i, j, k))
        return sign_of((r[0] - p[0]) * (r[0] - q[0]) + (r[1] - p[1]) * (r[1] - q[1])) <= 0

    def doubled_area(self) -> Any:
        """Twice the area, positive if the corners are listed counterclockwise."""
        total: Any = 0
        for (ax, ay), (bx, by) in zip(self.corners, [*self.corners[1:], self.corners[0]]):
            total = total + ax * by - ay * bx
        return total

    def check_simple(self) -> None:
        """Raise ComplexError unless the sides meet in common corners only."""
        d = len(self.corners)
        if d < 3:
            raise ComplexError(f"{self.name} has {d} corners: a polygon has three at least.")
        if d > _MOST_CORNERS:
            raise ComplexError(f"{self.name} has {d} corners; up to {_MOST_CORNERS} are taken.")
        for i in range(d):
            before, after = (i - 1) % d, (i + 1) % d
            p, q = self.corners[i], self.corners[after]
            if sign_of(p[0] - q[0]) == 0 and sign_of(p[1] - q[1]) == 0:
                raise ComplexError(
                    f"side {i} of {self.name} has no length: corners {i} and {after} are the same "
                    f"point {self._place(i)}."
                )
            if self.orientation(before, i, after) == 0 and not self.is_between(before, after, i):
                raise ComplexError(
                    f"{self.name} runs back along its own side at corner {i}, {self._place(i)}."
                )
        for i, j in self._close_sides():
            if j - i > 1 and j - i < d - 1 and self._meet(i, j):
                raise ComplexError(
                    f"{self.name} crosses or touches itself: side {i} from {self._place(i)} to "
                    f"{self._place((i + 1) % d)} meets side {j} from {self._place(j)} to "
                    f"{self._place((j + 1) % d)}. Are its corners in order?"
                )

    def triangles(self) -> list[tuple[int, int, int]]:
        """Positive triangles of all corners of a simple polygon listed counterclockwise.

        Each is (before, ear, after); the last one is what is left.
        """
        left = list(range(len(self.corners)))
        found = []
        while len(left) > 3:
            ears = sorted(range(len(left)), key=lambda i: self._cut(left, i))
            place = next((i for i in ears if self._is_ear(left, i)), None)
            if place is None:
                raise ComplexError(
                    f"{self.name} cannot be divided into triangles: its corners are not known "
                    "well enough."
                )
            found.append((left[place - 1], left[place], left[(place + 1) % len(left)]))
            del left[place]
        return [*found, (left[0], left[1], left[2])]

    def _cut(self, left: list[int], i: int) -> float:
        ends = self.xy[[left[i - 1], left[(i + 1) % len(left)]]]
        return float(np.round(np.hypot(*(ends[1] - ends[0])), 12))

    def _is_ear(self, left: list[int], i: int) -> bool:
        a, b, c = left[i - 1], left[i], left[(i + 1) % len(left)]
        if self.orientation(a, b, c) <= 0:
            return False
        return not any(
            self.orientation(a, b, k) >= 0
            and self.orientation(b, c, k) >= 0
            and self.orientation(c, a, k) >= 0
            for k in left
            if k not in (a, b, c)
        )

    def _close_sides(self) -> list[tuple[int, int]]:
        """Pairs of sides whose boxes meet, as far as double precision tells."""
        a, b = self.xy, np.roll(self.xy, -1, axis=0)
        low, high = np.minimum(a, b), np.maximum(a, b)
        gap = 1e-9 * float(np.abs(self.xy).max())
        meet = (low[:, None] <= high[None] + gap).all(axis=2)
        pairs = np.argwhere(np.triu(meet & meet.T, 1))
        return [(int(i), int(j)) for i, j in pairs]

    def _meet(self, i: int, j: int) -> bool:
        d = len(self.corners)
        a, b, p, q = i, (i + 1) % d, j, (j + 1) % d
        sides = [
            self.orientation(a, b, p),
            self.orientation(a, b, q),
            self.orientation(p, q, a),
            self.orientation(p, q, b),
        ]
        if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
            return True
        ends = ((a, b, p), (a, b, q), (p, q, a), (p, q, b))
        return any(s == 0 and self.is_between(*e) for s, e in zip(sides, ends))

    def _place(self, i: int) -> str:
        x, y = self.corners[i]
        return f"({float(x):.6g}, {float(y):.6g})"
