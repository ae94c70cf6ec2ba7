"""A chart of Lawson's minimal disc in the unit square, and triangulations of points in it.

The square stands for the rhombus of two equilateral triangles with the common side Q_0 Q_1, in
which the chart is conformal where the angles of the disc are 60° and 120°, and off near the corners
elsewhere.

References
----------
Du, Faber, Gunzburger, "Centroidal Voronoi tessellations" (1999).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.display import arrays_repr

from .disc import SIDES, divided, minimal_disc
from .plateau import Patch, on_sides

Random = np.random.Generator
# Axes of the rhombus: from its corner Q_0, at the origin, to P_0 and to P_1.
_AXES = np.array([[0.5, 0.5 * np.sqrt(3)], [0.5, -0.5 * np.sqrt(3)]])
_CORNERS = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0, 1.0]])  # P_0 P_1 Q_0 Q_1


@dataclass(frozen=True)
class DiscChart:
    """A fine minimal disc over the unit square, which the axes make a rhombus.

    Attributes
    ----------
    grid : (f + 1, f + 1, 4) float
        Points of S³ over the square lattice.
    area : (f + 1, f + 1) float
        Area on the surface around each.
    ends : (4, 2, 4) float
        Ends of the sides.
    angles : (r,) float
        Where the sides are divided: into equal arcs.
    boundary : (4 + 4 r, 2) float
        The corners and the points of the sides in the square.
    """

    __repr__ = arrays_repr

    grid: Floats
    area: Floats
    ends: Floats
    angles: Floats
    boundary: Floats

    @classmethod
    def of(cls, m: int, k: int, segments: int) -> DiscChart:
        """Solve for the disc, with sides to be divided into ``segments`` equal arcs."""
        f = max(40, 4 * segments)
        disc = minimal_disc(m, k, f, "diagonal_q")
        weights, _, _ = divided("diagonal_q", f)
        row, column = (weights[:, :4] @ _CORNERS.astype(np.int64)).T
        grid, area = np.empty((f + 1, f + 1, 4)), np.empty((f + 1, f + 1))
        grid[row, column], area[row, column] = disc.x, _areas(disc)
        angles = np.pi / 2 * np.arange(1, segments) / segments
        own = np.concatenate([[0.0], disc.angles[0], [np.pi / 2]])
        way = np.interp(angles, own, np.arange(f + 1) / f)[:, None]
        sides = [(1 - way) * _CORNERS[a] + way * _CORNERS[2 + b] for a, b in SIDES]
        return cls(grid, area, disc.ends, angles, np.concatenate([_CORNERS, *sides]))

    def random(self, count: int, rng: Random) -> Floats:
        """Places in the square, uniform by area on the surface; (count, 2)."""
        f = len(self.grid) - 1
        share = self.area[1:-1, 1:-1].ravel()
        cell = rng.choice(share.size, size=count, p=share / share.sum())
        place = np.stack(np.divmod(cell, f - 1), axis=1) + 1
        return np.asarray((place + rng.uniform(-0.5, 0.5, (count, 2))) / f)

    def on_surface(self, places: Floats) -> Floats:
        """The points of S³ over places in the square, interpolated on fine triangles; (n, 4)."""
        f = len(self.grid) - 1
        cell = np.minimum((places * f).astype(np.int64), f - 1)
        s, t = (places * f - cell).T
        i, j = cell.T
        # Cells are cut by the diagonal from (i, j) to (i + 1, j + 1).
        below = s >= t
        third = np.where(below[:, None], self.grid[i + 1, j], self.grid[i, j + 1])
        most, least = np.maximum(s, t)[:, None], np.minimum(s, t)[:, None]
        x = (1 - most) * self.grid[i, j] + (most - least) * third + least * self.grid[i + 1, j + 1]
        return np.asarray(x / np.linalg.norm(x, axis=1, keepdims=True))

    def lloyd(self, sites: Floats, iterations: int = 30) -> Floats:
        """Move sites to the centroids of their Voronoi regions; those of the boundary stay."""
        from scipy.spatial import cKDTree  # slow to import

        fixed = self.on_surface(self.boundary)
        f = len(self.grid) - 1
        row, column = np.divmod(np.arange((f + 1) ** 2), f + 1)
        for _ in range(iterations):
            tree = cKDTree(np.concatenate([fixed, self.on_surface(sites)]))
            owner = tree.query(self.grid.reshape(-1, 4))[1] - len(fixed)
            inner = owner >= 0
            share = self.area.ravel()[inner]
            sums = [
                np.bincount(owner[inner], share * c, minlength=len(sites))
                for c in (np.ones(share.size), row[inner] / f, column[inner] / f)
            ]
            owned = sums[0] > 0
            sites = sites.copy()
            sites[owned] = (np.stack(sums[1:], axis=1)[owned].T / sums[0][owned]).T
        return sites

    def patch(self, sites: Floats, stretching: Floats) -> Patch:
        """The disc with vertices at the sites, Delaunay in the stretched rhombus."""
        angles = np.tile(self.angles, (4, 1))
        corners = np.array([self.ends[0, 0], self.ends[2, 0], self.ends[0, 1], self.ends[1, 1]])
        x = np.concatenate([corners, on_sides(self.ends, angles), self.on_surface(sites)])
        faces = _triangulated(np.concatenate([_bulging(self.boundary), sites]), stretching)
        return Patch(x, faces, self.ends, angles, n_corners=4)


def _bulging(boundary: Floats) -> Floats:
    """Points on the sides of the square moved outward a little, so that all are extreme.

    Otherwise rounding decides whether they are corners of flat triangles.
    """
    x, y = np.abs(boundary - 0.5).T
    bulge = 1e-4 * (0.25 - np.minimum(x, y) ** 2)
    outward = np.where((x > y)[:, None], [1, 0], [0, 1]) * np.sign(boundary - 0.5)
    return np.asarray(boundary + outward * bulge[:, None])


def _triangulated(places: Floats, stretching: Floats) -> Ints:
    """Delaunay triangulation in the stretched rhombus, counterclockwise; (m, 3)."""
    from scipy.spatial import Delaunay  # slow to import

    points = places @ _AXES @ stretching
    faces = Delaunay(points).simplices.astype(np.int64)
    u, v = points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]]
    clockwise = u[:, 0] * v[:, 1] < u[:, 1] * v[:, 0]
    faces[clockwise] = faces[clockwise][:, ::-1]
    return faces


def _areas(patch: Patch) -> Floats:
    """A third of the area of the triangles at each vertex; (n,)."""
    corners = patch.x[patch.faces]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    gram = (u * u).sum(axis=1) * (v * v).sum(axis=1) - (u * v).sum(axis=1) ** 2
    total = np.zeros(len(patch.x))
    np.add.at(total, patch.faces, np.sqrt(gram)[:, None] / 6)
    return total
