r"""Triangulations of the round sphere with prescribed vertices and prescribed sizes.

The convex hull of points on the unit sphere is their Delaunay triangulation.  It is refined by
inserting circumcentres (Chew 1989, Ruppert 1995): of triangles whose circumradius exceeds the size
wanted there, and of triangles whose circumradius exceeds 1.2 times their shortest side, which are
those with an angle below 24.6°.  As there is no boundary, no other rule is needed, and no new
vertex comes nearer to the others than the least of size and shortest side: the refinement ends, and
sizes may vary as they like.

Each round inserts many circumcentres at once, of which no two lie in each other's circles.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from igl_periods.arrays import Floats, Ints

_RADIUS_TO_SIDE = 1.2
_MAX_ROUNDS = 400


def refined_sphere(seeds: Floats, size: Callable[[Floats], Floats]) -> tuple[Floats, Ints]:
    """Triangulate the unit sphere with triangles no larger than wanted.

    Parameters
    ----------
    seeds : (k, 3) float
        Unit vectors that become the first vertices.  The centre of the ball lies inside their hull.
    size : callable
        Takes (n, 3) unit vectors, returns the (n,) largest circumradii there.

    Returns
    -------
    V : (n, 3) float
        The seeds, then the vertices that were inserted.
    F : (m, 3) int
        Normals outward, in a canonical order.
    """
    V = np.array(seeds, dtype=np.float64)
    for _ in range(_MAX_ROUNDS):
        F = outward_hull(V)
        centre, radius, shortest = _circumcircles(V, F)
        excess = np.maximum(radius / size(centre), radius / (_RADIUS_TO_SIDE * shortest))
        bad = np.flatnonzero(excess > 1)
        if not bad.size:
            return V, F
        chosen = _apart(centre[bad], radius[bad], excess[bad])
        V = np.concatenate([V, centre[bad[chosen]]])
    raise AssertionError("Delaunay refinement of a closed surface ends")


def outward_hull(V: Floats) -> Ints:
    """Faces of the convex hull, normals outward, least corner first, in lexicographic order."""
    from scipy.spatial import ConvexHull  # slow to import

    hull = ConvexHull(V)
    F = hull.simplices.astype(np.int64)
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    inward = np.einsum("fd,fd->f", np.cross(b - a, c - a), hull.equations[:, :3]) < 0
    F[inward] = F[inward][:, ::-1]
    first = np.argmin(F, axis=1)[:, None]
    F = np.take_along_axis(F, (first + np.arange(3)) % 3, axis=1)
    return np.asarray(F[np.lexsort(F.T[::-1])])


def _circumcircles(V: Floats, F: Ints) -> tuple[Floats, Floats, Floats]:
    """Circumcentres on the sphere, chordal circumradii, and shortest sides."""
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    normal = np.cross(b - a, c - a)
    centre = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    sides = np.stack([b - c, c - a, a - b], axis=1)
    shortest = np.linalg.norm(sides, axis=2).min(axis=1)
    return centre, np.linalg.norm(centre - a, axis=1), shortest


def _apart(centre: Floats, radius: Floats, priority: Floats) -> Ints:
    """Indices of a maximal set of centres outside each other's circles, most urgent first."""
    from scipy.spatial import cKDTree  # slow to import

    near = cKDTree(centre).query_ball_point(centre, radius * (1 - 1e-9))
    blocked = np.zeros(len(centre), dtype=bool)
    chosen = []
    for i in np.argsort(-priority, kind="stable"):
        if not blocked[i]:
            chosen.append(i)
            blocked[near[i]] = True
    return np.array(chosen)
