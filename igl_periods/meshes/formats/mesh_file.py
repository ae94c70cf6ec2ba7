"""What a mesh file holds, and its polygons as triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError


@dataclass(frozen=True, eq=False)
class MeshFile:
    """What a file holds.

    Attributes
    ----------
    V : (n, 3) float
    F : (m, 3) int
        Triangles; polygons are replaced by their fans.
    n_faces, n_polygons : int
        Faces in the file, and those of them with more than three corners.
    n_welded : int
        Vertices saved by giving STL corners at the same position one vertex.
    """

    V: Floats
    F: Ints
    n_faces: int
    n_polygons: int
    n_welded: int = 0


def fans(corners: Ints, degrees: Ints) -> Ints:
    """Triangulate polygons, given one after the other: (c_0, c_i, c_{i+1}) for 0 < i < degree-1."""
    first = np.cumsum(degrees) - degrees
    triangles = degrees - 2
    apex = np.repeat(first, triangles)
    i = np.arange(apex.size) - np.repeat(np.cumsum(triangles) - triangles, triangles) + 1
    return corners[np.column_stack([apex, apex + i, apex + i + 1])]


def checked_degrees(degrees: Ints) -> Ints:
    """Refuse faces with fewer than three corners."""
    if (degrees < 3).any():
        f = int(np.argmax(degrees < 3))
        raise MeshError(f"face {f} (counted from 0) has {degrees[f]} corners.")
    return degrees
