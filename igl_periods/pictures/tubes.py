"""Curves on a surface in space: smoothed, and thickened to tubes.  For pictures only."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import igl
import numpy as np

from igl_periods.arrays import Floats, Ints

# Distance of the points of a smoothed curve, in diagonals of the surface.
_STEP = 0.006
_SMOOTHINGS = 60
_SIDES = 12


def diagonal(V: Floats) -> float:
    """Diagonal of the bounding box of some points."""
    return float(np.linalg.norm(V.max(axis=0) - V.min(axis=0)))


class Periodicity(NamedTuple):
    """What makes curves on a periodic surface closed.

    Attributes
    ----------
    holonomies : sequence of (3,) float
        The translations from the beginning of each curve to its end.
    home : function
        The translations that take points out of the parallelepiped of translations to where they
        are.
    extent : (n, 3) float
        The vertices of one cell.
    """

    holonomies: Sequence[Floats]
    home: Callable[[Floats], Floats]
    extent: Floats


class SmoothCurve(NamedTuple):
    """A curve on a surface: points at about equal distances, and normals there.

    ``face`` are the faces in which the points lie after they were translated by ``-away``.
    """

    points: Floats
    normals: Floats
    face: Ints
    away: Floats


def smooth_closed_curves(
    V: Floats,
    F: Ints,
    curves: Sequence[Floats],
    periodicity: Periodicity | None = None,
) -> list[SmoothCurve]:
    """Smooth closed curves on a surface, without leaving it.

    Points move towards the middle of their neighbours and back to the nearest point of the
    surface, by turns.

    Parameters
    ----------
    V, F : (n, 3) float, (m, 3) int
        The surface; of a periodic one, what is near the parallelepiped of its translations.
    curves : sequence of (k, 3) float
        The corners of polygons on it, closed ones or closed up to a translation.
    periodicity : Periodicity, optional
    """
    if not curves:
        return []
    holonomies, home, extent = periodicity or (np.zeros((len(curves), 3)), np.zeros_like, V)
    steps, size = np.asarray(holonomies), _STEP * diagonal(extent)
    points = [_resampled(curve, step, size) for curve, step in zip(curves, steps)]
    sizes = np.array([len(curve) for curve in points])
    start = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    everything = np.concatenate(points)
    index = np.arange(len(everything))
    first, n = np.repeat(start, sizes), np.repeat(sizes, sizes)
    within = index - first
    before, after = first + (within - 1) % n, first + (within + 1) % n
    step = np.repeat(steps, sizes, axis=0)
    at_start, at_end = step * (within == 0)[:, None], step * (within == n - 1)[:, None]
    tree = igl.AABB()
    tree.init(V, F)
    for _ in range(_SMOOTHINGS):
        neighbours = everything[before] - at_start + everything[after] + at_end
        middle = 0.5 * everything + 0.25 * neighbours
        away = home(middle)
        _, face, nearest = tree.squared_distance(V, F, middle - away)
        everything = nearest + away
    normals = _normals(V, F, nearest, face)
    ends = np.cumsum(sizes)[:-1]
    arrays = (everything, normals, face.ravel(), away)
    parts = (np.split(array, ends) for array in arrays)
    return [SmoothCurve(*part) for part in zip(*parts, strict=True)]


def tube(points: Floats, normals: Floats, radius: float, closed: bool) -> tuple[Floats, Ints]:
    """The tube around a curve on a surface, as a mesh.

    Parameters
    ----------
    points, normals : (k, 3) float
        Of the curve, and of the surface there.
    radius : float
    closed : bool

    Returns
    -------
    V : (12 k, 3) float
    F : (…, 3) int
    """
    if closed:
        along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    else:
        along = np.gradient(points, axis=0)
    across = _unit(np.cross(along, normals).astype(np.float64))
    up = _unit(np.cross(across, along).astype(np.float64))
    angle = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    circle = np.cos(angle)[:, None] * up[:, None] + np.sin(angle)[:, None] * across[:, None]
    V = (points[:, None] + radius * circle).reshape(-1, 3)
    ring = np.arange(len(points) if closed else len(points) - 1)
    i, j = np.meshgrid(ring, np.arange(_SIDES), indexing="ij")
    after, next_to = (i + 1) % len(points), (j + 1) % _SIDES
    a, b = i * _SIDES + j, after * _SIDES + j
    c, d = after * _SIDES + next_to, i * _SIDES + next_to
    return V, np.stack([a, c, b, a, d, c], axis=-1).reshape(-1, 3)


def _resampled(curve: Floats, holonomy: Floats, step: float) -> Floats:
    """Points at about equal distances on a polygon that is closed up to a translation."""
    closed = np.concatenate([curve, curve[:1] + holonomy])
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    count = max(8, int(np.ceil(along[-1] / step)))
    where = along[-1] * np.arange(count) / count
    return np.stack([np.interp(where, along, closed[:, i]) for i in range(3)], axis=1)


def _normals(V: Floats, F: Ints, points: Floats, face: Ints) -> Floats:
    corners = F[face.ravel()]
    weights = igl.barycentric_coordinates(points, *(V[corners[:, s]] for s in range(3)))
    normals = igl.per_vertex_normals(V, F)
    return _unit(np.einsum("ks,ksi->ki", np.clip(weights, 0.0, 1.0), normals[corners]))


def _unit(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0.0)
