r"""Polygons glued along their sides by rotations and translations of the plane.

Side k of a polygon runs from its vertex k to vertex k + 1.  Glued sides run in opposite directions
when both polygons are listed counterclockwise, and have the same length; one polygon is moved onto
the side of the other by the orientation-preserving isometry that this determines.  If it is always
a translation, the surface is a *translation surface* with the form dz; with rotations by π too it
has the quadratic differential dz²; in general it has a cone metric.

Lengths are compared exactly: squared lengths are elements of the field of the coordinates.  Where
coordinates are doubles and squared lengths do not agree exactly, they may differ by 1e-9
(relative), and the surface is the one with the rounded, averaged lengths.  Where they are functions
of the precision, the balls of two glued sides must meet, at every precision that is asked for.

A polygon that is listed clockwise is turned round: its vertex 0 and the numbers of its sides in the
gluing that was handed over stay, its vertices are listed in the other order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from typing import Any

import flint
import numpy as np

from igl_periods.arrays import Floats, Ints, ReadOnlyArrays
from igl_periods.errors import ComplexError

from .exact_lengths import LengthsByKind
from .exact_numbers import (
    DECIDING_BITS,
    ComputedNumber,
    ball_of,
    computed,
    computed_sum,
    in_one_field,
    root_of_number,
    sign_of,
)
from .gluings import components_of
from .number_readers import Point, read_points
from .plane_polygons import PlanePolygon

Side = tuple[int, int]
_GLUED_TOLERANCE = 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class GluedPolygons(ReadOnlyArrays):
    """Polygons in the plane, listed counterclockwise, and the gluing of their sides.

    Attributes
    ----------
    vertices : tuple of tuple of (x, y)
        Exact numbers (:mod:`igl_periods.complexes.exact_numbers`).
    gluing : tuple of ((polygon, side), (polygon, side))
    rounded : bool
        Whether lengths of glued sides agree up to rounding only.
    polygon : (m,) int
        The polygon of each face of the complex.
    corners : (m, 3) int
        The vertices of that polygon at the corners of each face.
    """

    vertices: tuple[tuple[Point, ...], ...]
    gluing: tuple[tuple[Side, Side], ...]
    rounded: bool
    polygon: Ints
    corners: Ints

    def __repr__(self) -> str:
        sizes = ", ".join(str(len(p)) for p in self.vertices[:12])
        more = ", …" if len(self.vertices) > 12 else ""
        return f"GluedPolygons({len(self.vertices)} polygons with {sizes}{more} sides)"

    @property
    def is_exact(self) -> bool:
        """Whether coordinates lie in one field, and glued sides have the same length there."""
        return not self.rounded and in_one_field([c for p in self.vertices for v in p for c in v])

    @cached_property
    def xy(self) -> tuple[Floats, ...]:
        """The vertices in floating point, (d, 2) for each polygon."""
        return tuple(np.array([[float(x), float(y)] for x, y in p]) for p in self.vertices)

    def vector(self, half_edge: int) -> Point:
        """The side of a face as a vector of the plane; of exact coordinates an exact one."""
        f, s = divmod(half_edge, 3)
        polygon, corners = self.vertices[int(self.polygon[f])], self.corners[f].tolist()
        p, q = polygon[corners[s - 2]], polygon[corners[s - 1]]
        return q[0] - p[0], q[1] - p[1]

    def vector_ball(self, half_edge: int, bits: int) -> flint.acb:
        """The side of a face as a vector of the plane, in a ball."""
        p, q = _ends(self, half_edge)
        with flint.ctx.workprec(bits):
            return flint.acb(*(ball_of(b, bits) - ball_of(a, bits) for a, b in zip(p, q)))


def glued_polygons(
    polygons: Iterable[Any], gluing: Iterable[Any], edges: bool
) -> tuple[GluedPolygons, Floats, Ints]:
    """Read polygons and a gluing, check them, and divide the polygons into triangles.

    Returns
    -------
    polygons : GluedPolygons
    lengths : (m, 3) float
    twin : (m, 3) int

    Raises
    ------
    ComplexError
        As :meth:`DeltaComplex.from_polygons`.
    """
    vertices, rounded = _vertices(polygons, edges)
    decided = [[(_decided(x), _decided(y)) for x, y in polygon] for polygon in vertices]
    planes = [PlanePolygon(f"polygon {p}", corners) for p, corners in enumerate(decided)]
    pairs = _checked_pairs(gluing, [len(v) for v in vertices])
    for plane in planes:
        plane.check_simple()
    differ = _check_lengths(planes, pairs, rounded)
    _check_connected(pairs, len(planes))
    for p, plane in enumerate(planes):
        if sign_of(plane.doubled_area()) < 0:
            vertices[p] = [vertices[p][0], *vertices[p][:0:-1]]
            corners = [decided[p][0], *decided[p][:0:-1]]
            planes[p] = PlanePolygon(plane.name, corners)
            pairs = _turned(pairs, p, len(corners))
    triangles = [(p, t) for p, plane in enumerate(planes) for t in plane.triangles()]
    found = GluedPolygons(
        tuple(map(tuple, vertices)),
        tuple(pairs),
        differ,
        np.array([p for p, _ in triangles], dtype=np.int64),
        np.array([t for _, t in triangles], dtype=np.int64),
    )
    return found, _lengths_in_floats(found), _twins(found)


def lengths_of_polygons(polygons: GluedPolygons, edge: Ints) -> LengthsByKind | None:
    """The exact lengths of the edges; None where lengths of glued sides had to be averaged."""
    if polygons.rounded:
        return None
    halves: dict[int, list[int]] = {}
    for h, e in enumerate(edge.ravel().tolist()):
        halves.setdefault(e, []).append(h)
    exact = polygons.is_exact
    kinds: dict[Any, int] = {}
    formulas: list[Callable[[], flint.arb]] = []
    kind = []
    for e in range(len(halves)):
        if exact:
            x, y = polygons.vector(halves[e][0])
            square = x * x + y * y  # type: ignore[operator]
            key, formula = square, root_of_number(square)
        else:
            key = e
            formula = partial(_common_length, *(_ends(polygons, h) for h in halves[e]))
        if key not in kinds:
            kinds[key] = len(formulas)
            formulas.append(formula)
        kind.append(kinds[key])
    return LengthsByKind(np.array(kind, dtype=np.int64), tuple(formulas))


def _vertices(polygons: Iterable[Any], edges: bool) -> tuple[list[list[Point]], bool]:
    """The vertices of all polygons in one kind of numbers, and whether any are doubles."""
    try:
        listed = [list(polygon) for polygon in polygons]
    except TypeError as error:
        raise ComplexError(f"polygons are lists of points: {error}.") from error
    short = [p for p, polygon in enumerate(listed) if len(polygon) < 3]
    if short:
        raise ComplexError(
            f"polygon {short[0]} has {len(listed[short[0]])} corners: a polygon has three at least."
        )
    read = [read_points(polygon) for polygon in listed]
    if not read:
        raise ComplexError("there is no polygon: a surface is glued from one at least.")
    points, rounded = [p for p, _ in read], any(r for _, r in read)
    if not in_one_field([c for polygon in points for z in polygon for c in z]):
        points = [[(computed(x), computed(y)) for x, y in polygon] for polygon in points]
    if edges:
        points = [_from_edges(p, polygon, rounded) for p, polygon in enumerate(points)]
    return points, rounded


def _from_edges(p: int, vectors: list[Point], rounded: bool) -> list[Point]:
    """The vertices of a polygon that starts at 0, from its sides as vectors."""
    of_this_kind = computed if isinstance(vectors[0][0], ComputedNumber) else Fraction
    place: Point = (of_this_kind(Fraction(0)), of_this_kind(Fraction(0)))
    vertices = []
    for vector in vectors:
        vertices.append(place)
        place = _added(place[0], vector[0]), _added(place[1], vector[1])
    x, y = (float(c) for c in place)
    size = max((abs(float(c)) for vector in vectors for c in vector), default=0.0)
    closed = sign_of(_decided(place[0])) == 0 == sign_of(_decided(place[1]))
    if not closed and not (rounded and np.hypot(x, y) <= _GLUED_TOLERANCE * size):
        raise ComplexError(
            f"the sides of polygon {p} add up to ({x:.12g}, {y:.12g}), not to 0: it does not close."
        )
    return vertices


def _added(x: Any, y: Any) -> Any:
    return computed_sum(x, y) if isinstance(y, ComputedNumber) else x + y


def _decided(x: Any) -> Any:
    return x.ball(DECIDING_BITS) if isinstance(x, ComputedNumber) else x


def _checked_pairs(gluing: Iterable[Any], sizes: Sequence[int]) -> list[tuple[Side, Side]]:
    """The pairs of sides, of which each occurs once."""
    try:
        pairs = [tuple((int(p), int(s)) for p, s in pair) for pair in gluing]
        whole = all(len(pair) == 2 for pair in pairs)
    except (TypeError, ValueError):
        whole = False
    if not whole:
        raise ComplexError(
            "a gluing of polygons is a list of pairs ((polygon, side), (polygon, side))."
        )
    uses: dict[Side, int] = {(p, s): 0 for p, d in enumerate(sizes) for s in range(d)}
    for side in (side for pair in pairs for side in pair):
        if side not in uses:
            p, s = side
            known = f"{sizes[p]} sides" if 0 <= p < len(sizes) else f"{len(sizes)} polygons exist"
            raise ComplexError(
                f"the gluing names side {s} of polygon {p}, and there is none ({known}): both are "
                "counted from 0."
            )
        uses[side] += 1
    for one, other in pairs:
        if one == other:
            raise ComplexError(
                f"{_name(one)} is glued to itself. Make its midpoint a vertex, and glue the halves."
            )
    wrong = [side for side, count in uses.items() if count != 1]
    if wrong:
        count = uses[wrong[0]]
        raise ComplexError(
            f"{_name(wrong[0])} is glued {count} times ({len(wrong)} such sides): every side is "
            "glued once, to another side."
        )
    return [(one, other) for one, other in pairs]


def _name(side: Side) -> str:
    return f"side {side[1]} of polygon {side[0]}"


def _turned(pairs: list[tuple[Side, Side]], p: int, d: int) -> list[tuple[Side, Side]]:
    """The pairs when the vertices 0, d − 1, …, 1 of a polygon become 0, 1, …, d − 1."""

    def moved(side: Side) -> Side:
        return (p, d - 1 - side[1]) if side[0] == p else side

    return [(moved(one), moved(other)) for one, other in pairs]


def _check_lengths(
    planes: Sequence[PlanePolygon], pairs: Sequence[tuple[Side, Side]], rounded: bool
) -> bool:
    """Whether lengths of glued sides differ by rounding; ComplexError if by more."""
    differ = False
    for one, other in pairs:
        a, b = _square(planes, one), _square(planes, other)
        if sign_of(a - b) == 0:
            continue
        x, y = float(a) ** 0.5, float(b) ** 0.5
        if not rounded or abs(x - y) > _GLUED_TOLERANCE * max(x, y):
            within = f"to {_GLUED_TOLERANCE:g} (relative)" if rounded else "exactly"
            raise ComplexError(
                f"{_name(one)} has length {x:.15g} and {_name(other)}, which is glued to it, "
                f"{y:.15g}: they must agree {within}."
            )
        differ = True
    return differ


def _square(planes: Sequence[PlanePolygon], side: Side) -> Any:
    corners = planes[side[0]].corners
    p, q = corners[side[1]], corners[(side[1] + 1) % len(corners)]
    x, y = q[0] - p[0], q[1] - p[1]
    return x * x + y * y


def _check_connected(pairs: Sequence[tuple[Side, Side]], n: int) -> None:
    ends = np.array([[one[0], other[0]] for one, other in pairs], dtype=np.int64)
    parts, label = components_of(ends[:, 0], ends[:, 1], n)
    if parts > 1:
        apart = np.flatnonzero(label != label[0])
        raise ComplexError(
            f"the polygons are not glued to one surface but to {parts}: nothing leads from polygon "
            f"0 to polygon {apart[0]}."
        )


def _twins(polygons: GluedPolygons) -> Ints:
    """Which sides of triangles are glued: diagonals inside of polygons, sides by the gluing."""
    at: dict[tuple[int, int, int], int] = {}
    for f, (p, t) in enumerate(zip(polygons.polygon.tolist(), polygons.corners.tolist())):
        for s in range(3):
            at[p, t[s - 2], t[s - 1]] = 3 * f + s
    sizes = [len(v) for v in polygons.vertices]

    def half_edge(side: Side) -> int:
        p, k = side
        return at[p, k, (k + 1) % sizes[p]]

    twin = np.array([at.get((p, b, a), -1) for p, a, b in at], dtype=np.int64)
    found = np.empty_like(twin)
    found[list(at.values())] = twin
    for one, other in polygons.gluing:
        h, t = half_edge(one), half_edge(other)
        found[h], found[t] = t, h
    return found.reshape(-1, 3)


def _lengths_in_floats(polygons: GluedPolygons) -> Floats:
    m = len(polygons.polygon)
    lengths = [_length(*_ends(polygons, h), 128) for h in range(3 * m)]
    return np.array([float(x.mid()) for x in lengths]).reshape(m, 3)


def _ends(polygons: GluedPolygons, half_edge: int) -> tuple[Point, Point]:
    f, s = divmod(half_edge, 3)
    polygon, corners = polygons.vertices[int(polygons.polygon[f])], polygons.corners[f].tolist()
    return polygon[corners[s - 2]], polygon[corners[s - 1]]


def _length(p: Point, q: Point, bits: int) -> flint.arb:
    with flint.ctx.workprec(bits):
        x, y = (ball_of(b, bits) - ball_of(a, bits) for a, b in zip(p, q))
        return (x * x + y * y).sqrt()


def _common_length(*sides: tuple[Point, Point]) -> flint.arb:
    """The length of glued sides at the working precision."""
    lengths = [_length(*side, flint.ctx.prec) for side in sides]
    if not lengths[0].overlaps(lengths[-1]):
        raise ComplexError(
            f"glued sides have different lengths, {lengths[0]} and {lengths[-1]}, as is seen at "
            f"{flint.ctx.prec} bits."
        )
    return lengths[0]
