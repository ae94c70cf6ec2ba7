r"""Plane domains with polygonal holes, as triangle meshes.

A domain is given by its outer boundary and its holes, each a polygon: corners as complex numbers
z = x + iy or as pairs (x, y), the last one not joined to the first one by a repeated corner or
joined so, run through either way.  A polygon of Shapely is one, too: whatever has an ``exterior``
and ``interiors`` with ``coords``.

The corners of the polygons are the first vertices of the mesh, those of the outer boundary before
those of the holes in their order.  Where triangles would be thin, points are added on sides and in
the interior (:mod:`~igl_periods.surfaces.plane_triangulation`): the surface is flat there, and does
not change.

What is not a domain is refused, with the place: sides that cross or touch, corners at which the
boundary runs back along itself (a slit has two sides, and no mesh in the plane keeps them apart),
holes that are not inside.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.errors import MeshError

from .plane_triangulation import Quality, triangulated, turn

# In parts of the size of the domain: what is not a distance.
_TOUCHING = 1e-9
_LARGEST_ANGLE = 30.0
_PAIRS_AT_ONCE = 2**21


def planar_domain(
    outer: Any, holes: Iterable[Any] = (), *, angle: float = 25.0, area: float | None = None
) -> tuple[Floats, Ints]:
    """Triangulate a plane domain bounded by polygons.

    Parameters
    ----------
    outer : (n,) complex, (n, 2) array-like, or a polygon object
        Corners of the outer boundary, or an object with ``exterior`` and ``interiors`` that have
        ``coords``, as polygons of Shapely do; its interiors come before ``holes``.
    holes : iterable of (n,) complex or (n, 2) array-like
        Corners of the boundaries of the holes.
    angle : float
        The least angle of triangles in degrees, at most 30, except at sharper corners of the
        domain; 0 adds no points.
    area : float, optional
        The largest area of a triangle.

    Returns
    -------
    V : (n, 2) float
        The corners of all polygons in their order, then what was added.
    F : (m, 3) int
        Counterclockwise.

    Raises
    ------
    MeshError
        If a polygon has fewer than three corners or coordinates that are not finite, sides cross or
        touch, the boundary runs back along itself, or a hole is not inside of the domain: with the
        place.
    ValueError
        If ``angle`` or ``area`` are out of range.

    Examples
    --------
    >>> V, F = planar_domain([0, 4, 4 + 4j, 4j], [[1 + 1j, 3 + 1j, 3 + 3j, 1 + 3j]])
    >>> V[:5].tolist()
    [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 1.0]]
    """
    if not 0.0 <= angle <= _LARGEST_ANGLE:
        raise ValueError(
            f"angle = {angle}: triangulations have least angles from 0 to "
            f"{_LARGEST_ANGLE:g} degrees."
        )
    if area is not None and not 0.0 < area < np.inf:
        raise ValueError(f"area = {area}: the largest area of a triangle is positive.")
    polygons = _polygons(outer, holes)
    corners, rings = np.vstack(polygons), _rings(polygons)
    sides = np.vstack([np.stack([ring, np.roll(ring, -1)], axis=1) for ring in rings])
    low = corners.min(axis=0)
    size = float((corners - low).max())
    if size == 0.0:
        raise MeshError(f"all corners are at {_place(corners[0])}: that bounds no domain.")
    # Around the origin and of size 1, where nothing over- or underflows.
    scaled = (corners - low) / size
    _check_boundary(scaled, sides, corners)
    _check_nesting(polygons, scaled)
    largest = np.inf if area is None else area / size**2
    V, F = triangulated(scaled, _to_the_left(scaled, rings), Quality(angle, largest))
    V = low + size * V
    V[: len(corners)] = corners
    return V, F


def _polygons(outer: Any, holes: Iterable[Any]) -> list[Floats]:
    """The corners of all polygons, each without repeated ones; the outer one first."""
    if hasattr(outer, "exterior") and hasattr(outer, "interiors"):
        rings = [outer.exterior.coords, *(ring.coords for ring in outer.interiors), *holes]
    else:
        rings = [outer, *holes]
    names = ["the outer boundary", *(f"hole {k}" for k in range(len(rings) - 1))]
    return [_corners(ring, name) for ring, name in zip(rings, names)]


def _corners(ring: Any, name: str) -> Floats:
    try:
        given = np.asarray(ring if hasattr(ring, "__array__") else list(ring))
    except (TypeError, ValueError) as error:
        raise MeshError(f"{name} is not a list of corners: {error}.") from error
    if given.ndim == 1 and given.dtype.kind in "iufc":
        z = given.astype(np.complex128)
        given = np.stack([z.real, z.imag], axis=1)
    if given.ndim != 2 or given.shape[1] not in (2, 3) or given.dtype.kind not in "iuf":
        raise MeshError(
            f"{name} must be corners as complex numbers (n,) or coordinates (n, 2), not an array "
            f"of shape {given.shape} of {given.dtype}."
        )
    # The third coordinate of polygons in space says how high the plane is.
    xy = given[:, :2].astype(np.float64)
    if not np.isfinite(xy).all():
        bad = int(np.argmin(np.isfinite(xy).all(axis=1)))
        raise MeshError(f"{name} has corners that are not finite; the first is corner {bad}.")
    # Of a closed ring the last corner goes, not the first one.
    xy = xy[(xy != np.roll(xy, -1, axis=0)).any(axis=1)]
    if len(xy) < 3:
        raise MeshError(f"{name} has {len(xy)} different corners: a polygon has three at least.")
    return np.ascontiguousarray(xy)


def _rings(polygons: list[Floats]) -> list[Ints]:
    """The numbers of the corners of each polygon."""
    ends = np.cumsum([len(polygon) for polygon in polygons])
    return np.split(np.arange(ends[-1]), ends[:-1])


def _to_the_left(P: Floats, rings: list[Ints]) -> list[Ints]:
    """The outer polygon counterclockwise, the others clockwise."""
    z = P @ np.array([1.0, 1.0j])
    areas = [np.imag(np.conj(z[ring]) * np.roll(z[ring], -1)).sum() for ring in rings]
    wanted = [k == 0 for k in range(len(rings))]
    return [
        ring if (area > 0) == outer else ring[::-1]
        for ring, area, outer in zip(rings, areas, wanted)
    ]


def _check_boundary(P: Floats, sides: Ints, corners: Floats) -> None:
    """Raise where sides meet anywhere but in the corner that follows on both."""
    after, before = sides[:, 1], np.empty(len(P), dtype=np.int64)
    before[sides[:, 1]] = sides[:, 0]
    u, v = P[after] - P, P[before] - P
    cross = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    shorter = np.minimum(np.linalg.norm(u, axis=1), np.linalg.norm(v, axis=1))
    longer = np.maximum(np.linalg.norm(u, axis=1), np.linalg.norm(v, axis=1))
    # The distance of the end of the shorter side from the longer one.
    spike = (np.einsum("ij,ij->i", u, v) > 0) & (np.abs(cross) <= _TOUCHING * longer)
    if np.any(spike | (shorter <= _TOUCHING)):
        place = corners[int(np.argmax(spike | (shorter <= _TOUCHING)))]
        raise MeshError(
            f"the boundary runs back along itself at {_place(place)}: a slit has two sides at the "
            "same place. Open it to a thin hole, or glue its sides by hand "
            "(DeltaComplex.from_gluing)."
        )
    for i, j in _pairs(P, sides):
        apart = (sides[i, 0] != sides[j, 1]) & (sides[i, 1] != sides[j, 0])
        i, j = i[apart], j[apart]
        a, b, p, q = P[sides[i, 0]], P[sides[i, 1]], P[sides[j, 0]], P[sides[j, 1]]
        ends = np.stack([_distance(a, p, q), _distance(b, p, q),
                         _distance(p, a, b), _distance(q, a, b)])  # fmt: skip
        meets = _cross_properly(a, b, p, q) | (ends.min(axis=0) <= _TOUCHING)
        if meets.any():
            k = int(np.argmax(meets))
            raise MeshError(_meeting(corners, sides[i[k]], sides[j[k]]))


def _meeting(corners: Floats, one: Ints, other: Ints) -> str:
    (a, b), (p, q) = corners[one], corners[other]
    near = [(a, _distance(a, p, q)), (b, _distance(b, p, q)),
            (p, _distance(p, a, b)), (q, _distance(q, a, b))]  # fmt: skip
    place = min(near, key=lambda pair: float(pair[1]))[0]
    if _cross_properly(a, b, p, q):
        u, v = b - a, q - p
        s = ((p - a)[0] * v[1] - (p - a)[1] * v[0]) / (u[0] * v[1] - u[1] * v[0])
        place = a + s * u
    return (
        f"the boundary meets itself at {_place(place)}, where the side from {_place(a)} to "
        f"{_place(b)} meets that from {_place(p)} to {_place(q)}: boundary curves have a distance "
        f"from each other, of more than {_TOUCHING:g} of the size of the domain."
    )


def _pairs(P: Floats, sides: Ints) -> Iterable[tuple[Ints, Ints]]:
    """Pairs of different sides whose shadows on the first axis come close, in portions."""
    ends = P[sides, 0]
    low, high = ends.min(axis=1) - _TOUCHING, ends.max(axis=1) + _TOUCHING
    order = np.argsort(low, kind="stable")
    last = np.searchsorted(low[order], high[order], side="right")
    count = last - np.arange(len(sides)) - 1
    total = np.cumsum(count)
    start = 0
    while start < len(sides):
        before = total[start] - count[start]
        stop = max(int(np.searchsorted(total, before + _PAIRS_AT_ONCE, side="right")), start + 1)
        here = count[start:stop]
        one = np.repeat(np.arange(start, stop), here)
        other = np.arange(one.size) - np.repeat(np.cumsum(here) - here, here) + one + 1
        yield order[one], order[other]
        start = stop


def _cross_properly(a: Floats, b: Floats, p: Floats, q: Floats) -> Bools:
    """Whether two sides have their ends on both sides of each other."""
    one = turn(a, b, p) * turn(a, b, q)
    other = turn(p, q, a) * turn(p, q, b)
    return np.asarray((one < 0) & (other < 0))


def _distance(c: Floats, a: Floats, b: Floats) -> Floats:
    """Distance of points from segments."""
    u = b - a
    t = np.einsum("...j,...j->...", c - a, u) / np.einsum("...j,...j->...", u, u)
    return np.asarray(np.linalg.norm(c - a - np.clip(t, 0.0, 1.0)[..., None] * u, axis=-1))


def _check_nesting(polygons: list[Floats], scaled: Floats) -> None:
    """Raise where a hole is not inside of the domain."""
    ends = np.cumsum([len(polygon) for polygon in polygons])
    rings = np.split(scaled, ends[:-1])
    for k, ring in enumerate(rings[1:]):
        # Boundaries do not meet: one point decides.
        if not _contains(rings[0], ring[0]):
            raise MeshError(
                f"hole {k} is not inside of the outer boundary: its corner "
                f"{_place(polygons[k + 1][0])} is outside."
            )
        for j, other in enumerate(rings[1:]):
            if j != k and _contains(other, ring[0]):
                raise MeshError(
                    f"hole {k} is inside of hole {j}, at {_place(polygons[k + 1][0])}: what lies "
                    "within a hole is no part of the domain."
                )


def _contains(ring: Floats, point: Floats) -> bool:
    """Whether a point is inside: a ray to the right crosses the polygon an odd number of times."""
    a, b = ring, np.roll(ring, -1, axis=0)
    spans = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    a, b = a[spans], b[spans]
    crossing = a[:, 0] + (point[1] - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return bool(np.count_nonzero(crossing > point[0]) % 2)


def _place(point: Floats) -> str:
    return f"({point[0]:.6g}, {point[1]:.6g})"
