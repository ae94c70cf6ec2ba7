"""What a mesh file holds: positions and polygons."""

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
    corners : (sum(degrees),) int
        The corners of all faces, one face after the other.
    degrees : (m,) int
        Number of corners of each face.
    n_welded : int
        Vertices saved by giving STL corners at the same position one vertex.
    warnings : tuple of str
        What is odd about the file, though it could be read.
    """

    V: Floats
    corners: Ints
    degrees: Ints
    n_welded: int = 0
    warnings: tuple[str, ...] = ()


def mesh_of_triangles(
    V: Floats, F: Ints, n_welded: int = 0, warnings: tuple[str, ...] = ()
) -> MeshFile:
    """A file whose faces are triangles."""
    degrees = np.full(len(F), 3, dtype=np.int64)
    return MeshFile(V, F.ravel().astype(np.int64), degrees, n_welded, warnings)


def triangles_of_strip(strip: Ints) -> Ints:
    """The triangles of a strip, every second one turned, without those that only join parts."""
    i = np.arange(max(strip.size - 2, 0))
    F = strip[np.column_stack([i, i + 1 + i % 2, i + 2 - i % 2])]
    return F[(F != np.roll(F, 1, axis=1)).all(axis=1)]


def checked_degrees(degrees: Ints) -> Ints:
    """Refuse faces with fewer than three corners."""
    if (degrees < 3).any():
        f = int(np.argmax(degrees < 3))
        raise MeshError(f"face {f} (counted from 0) has {degrees[f]} corners.")
    return degrees
