"""Curves on a surface in space: smoothed, and thickened to tubes.  For pictures only."""

from __future__ import annotations

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


def smooth_closed_curves(V: Floats, F: Ints, curves: list[Floats]) -> list[tuple[Floats, Floats]]:
    """Smooth closed curves on a surface, without leaving it.

    Points move towards the middle of their neighbours and back to the nearest point of the
    surface, by turns.

    Parameters
    ----------
    V, F : (n, 3) float, (m, 3) int
        The surface.
    curves : list of (k, 3) float
        The corners of closed polygons on it.

    Returns
    -------
    list of ((k', 3) float, (k', 3) float)
        Points at equal distances, and normals of the surface there.
    """
    if not curves:
        return []
    step = _STEP * diagonal(V)
    points = [_resampled(curve, step) for curve in curves]
    sizes = np.array([len(curve) for curve in points])
    start = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    everything = np.concatenate(points)
    index = np.arange(len(everything))
    first = np.repeat(start, sizes)
    within, size = index - first, np.repeat(sizes, sizes)
    before, after = first + (within - 1) % size, first + (within + 1) % size
    tree = igl.AABB()
    tree.init(V, F)
    for _ in range(_SMOOTHINGS):
        middle = 0.5 * everything + 0.25 * (everything[before] + everything[after])
        _, face, everything = tree.squared_distance(V, F, middle)
    normals = _normals(V, F, everything, face)
    ends = np.cumsum(sizes)[:-1]
    return list(zip(np.split(everything, ends), np.split(normals, ends), strict=True))


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


def _resampled(curve: Floats, step: float) -> Floats:
    """Points at about equal distances on a closed polygon."""
    closed = np.concatenate([curve, curve[:1]])
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
