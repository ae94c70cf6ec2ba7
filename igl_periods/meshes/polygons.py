r"""Polygons divided into triangles: one rule for the files of all formats.

A polygon is divided by the fan of its first corner wherever that is right: its triangles
:math:`(c_0, c_i, c_{i+1})` all lie on the same side, none is flat, and their angles at
:math:`c_0` add up to less than :math:`2\pi`, so that the polygon is star-shaped from there.  That
holds for every convex polygon without straight corners.  All others, concave or with corners in
the middle of a straight side, are divided in their planes (``outlines``), with triangles of
positive area at every corner.

Corners stay what they are, and every side of a polygon is a side of one triangle: neighbours fit.
Two polygons with three common corners may want the same diagonal.  An edge is known by its ends, so
that it would have four triangles; one of the two gets other diagonals then.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.errors import MeshError

from .outlines import FLAT, divided

# Polygons whose corners leave their plane by more than this part of their size are not planar.
PLANARITY = 1e-6


@dataclass(frozen=True, eq=False)
class Triangulation:
    """Triangles of polygons, and how they came about.

    Attributes
    ----------
    F : (m, 3) int
    fanned, clipped : int
        Polygons (with more than three corners) divided by fans, and in other ways.
    not_planar : int
        Polygons whose corners leave the plane that fits them by more than :data:`PLANARITY` of
        their size: how they are divided changes the surface.
    unevenness : float
        The most by which corners do so, in parts of the size.
    repeated_corners : int
        Corners left out of polygons because they repeat the one before.
    """

    F: Ints
    fanned: int
    clipped: int
    not_planar: int
    unevenness: float
    repeated_corners: int


def triangulated(V: Floats, corners: Ints, degrees: Ints) -> Triangulation:
    """Divide polygons into triangles, in the order of the polygons.

    Parameters
    ----------
    V : (n, 3) float
    corners : (sum(degrees),) int
        The corners of all polygons, one after the other.
    degrees : (m,) int
        At least three.

    Raises
    ------
    MeshError
        If the outline of a polygon crosses itself, or no triangle is left.
    """
    kept, sizes = _without_repeated_corners(corners, degrees)
    spare = corners.size - kept.size
    F, owner = _fans(kept, sizes)
    many = sizes > 3
    if not many.any():
        return Triangulation(F, 0, 0, 0, 0.0, spare)
    low = V[kept].min(axis=0)
    # Areas of the largest coordinates are not infinities so.
    size = float(np.abs(V[kept] / 2 - low / 2).max()) or 1.0
    P = (V / 2 - low / 2) / size
    good, unevenness = _good_fans(P, F, owner, kept, sizes)
    first = np.cumsum(sizes) - sizes
    clipped = np.flatnonzero(many & ~good)
    place = np.searchsorted(owner, np.arange(len(sizes) + 1))
    for f in clipped:
        polygon = kept[first[f] : first[f] + sizes[f]]
        triangles = polygon[divided(P[polygon], int(f), polygon, V)]
        end = place[f] + len(triangles)
        F[place[f] : end], F[end : place[f + 1]] = triangles, -1
    _avoid_crowded_edges(P, F, owner, sizes, kept)
    F = F[F[:, 0] >= 0]
    if len(F) == 0:
        raise MeshError("no polygon has an area: all of them run back along their own sides.")
    return Triangulation(
        F,
        fanned=int(np.count_nonzero(many & good)),
        clipped=clipped.size,
        not_planar=int(np.count_nonzero(many & (unevenness > PLANARITY))),
        unevenness=float(unevenness[many].max()),
        repeated_corners=spare,
    )


def _without_repeated_corners(corners: Ints, degrees: Ints) -> tuple[Ints, Ints]:
    """Polygons without corners that the next one repeats; those of triangles stay."""
    if (degrees == 3).all():
        return corners, degrees
    owner = np.repeat(np.arange(degrees.size), degrees)
    after = np.arange(corners.size) + 1
    last = np.cumsum(degrees) - 1
    after[last] = last - degrees + 1
    repeated = (corners == corners[after]) & (degrees[owner] > 3)
    left = np.bincount(owner[~repeated], minlength=degrees.size)
    # Of those with two corners nothing is left: they stay for others to judge.
    repeated &= left[owner] >= 3
    return corners[~repeated], np.bincount(owner[~repeated], minlength=degrees.size)


def _fans(corners: Ints, degrees: Ints) -> tuple[Ints, Ints]:
    """The triangles (c_0, c_i, c_{i+1}) for 0 < i < degree - 1, and the polygon of each."""
    first = np.cumsum(degrees) - degrees
    triangles = degrees - 2
    apex = np.repeat(first, triangles)
    i = np.arange(apex.size) - np.repeat(np.cumsum(triangles) - triangles, triangles) + 1
    owner = np.repeat(np.arange(degrees.size), triangles)
    return corners[np.column_stack([apex, apex + i, apex + i + 1])], owner


def _good_fans(
    P: Floats, F: Ints, owner: Ints, corners: Ints, degrees: Ints
) -> tuple[Bools, Floats]:
    """Which polygons are star-shaped from their first corners; and how uneven all of them are."""
    m = degrees.size
    a, b, c = P[F[:, 0]], P[F[:, 1]], P[F[:, 2]]
    area = np.cross(b - a, c - a)
    normal: Floats = np.stack([np.bincount(owner, area[:, k], m) for k in range(3)], axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        normal = normal / np.linalg.norm(normal, axis=1)[:, None]
        n = normal[owner]
        height = np.einsum("ij,ij->i", area, n)
        sides = np.linalg.norm(np.stack([b - a, c - b, a - c]), axis=2)
        upright = height > FLAT * sides.prod(axis=0) / sides.max(axis=0)
        along = np.einsum("ij,ij->i", b - a, c - a) - np.einsum(
            "ij,ij,ik,ik->i", b - a, n, c - a, n
        )
        angle = np.bincount(owner, np.arctan2(height, along), m)
    flat = np.bincount(owner, ~upright, m)
    good = (degrees == 3) | ((flat == 0) & (angle < 2 * np.pi))
    return good, _unevenness(P[corners], normal, degrees)


def _unevenness(P: Floats, normal: Floats, degrees: Ints) -> Floats:
    """How far corners leave the plane through their mean, in parts of the size of the polygon."""
    owner = np.repeat(np.arange(degrees.size), degrees)
    mean = np.stack([np.bincount(owner, P[:, k]) for k in range(3)], axis=1) / degrees[:, None]
    offset = P - mean[owner]
    first = np.cumsum(degrees) - degrees
    height = np.abs(np.einsum("ij,ij->i", offset, normal[owner]))
    size = np.maximum.reduceat(np.linalg.norm(offset, axis=1), first)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.nan_to_num(np.maximum.reduceat(height, first) / size)


def _avoid_crowded_edges(P: Floats, F: Ints, owner: Ints, degrees: Ints, corners: Ints) -> None:
    """Divide polygons by other fans, in place, if their diagonals are edges elsewhere too."""
    keys = _edges(F, len(P)).ravel()
    edge, inverse, count = np.unique(keys, return_inverse=True, return_counts=True)
    if count.max() <= 2:
        return
    # Both sides of a diagonal belong to the same polygon.
    _, which, inside = np.unique(
        np.repeat(owner, 3) * edge.size + inverse, return_inverse=True, return_counts=True
    )
    wrong = (inside[which] == 2) & (count[inverse] > 2)
    number = dict(zip(edge[count > 1].tolist(), count[count > 1].tolist()))
    first, place = np.cumsum(degrees) - degrees, np.cumsum(degrees - 2) - (degrees - 2)
    for f in np.unique(np.repeat(owner, 3)[wrong]):
        polygon = corners[first[f] : first[f] + degrees[f]]
        rows = slice(place[f], place[f] + degrees[f] - 2)
        found = _uncrowded_fan(P, polygon, _edges(F[rows], len(P)), number)
        if found is not None:
            F[rows] = found
            for key in _edges(found, len(P)).ravel().tolist():
                number[key] = number.get(key, 0) + 1


def _uncrowded_fan(P: Floats, polygon: Ints, now: Ints, number: dict[int, int]) -> Ints | None:
    """A fan whose diagonals are edges of no other polygon; its old edges are given up if found."""
    others = dict(number)
    for key in now.ravel().tolist():
        others[key] = others.get(key, 1) - 1
    size = np.array([polygon.size])
    for k in range(polygon.size):
        rotated = np.roll(polygon, -k)
        F, owner = _fans(rotated, size)
        diagonals = np.unique(_edges(F[1:, :2], len(P)))
        free = all(others.get(key, 0) == 0 for key in diagonals.tolist())
        if free and _good_fans(P, F, owner, rotated, size)[0][0]:
            number.update(others)
            return F
    return None


def _edges(F: Ints, n: int) -> Ints:
    """A number for each pair of consecutive corners, the same in both directions."""
    if F.shape[1] == 2:
        tail, head = F.T
    else:
        tail, head = F, np.roll(F, -1, axis=1)
    return np.minimum(tail, head) * n + np.maximum(tail, head)
