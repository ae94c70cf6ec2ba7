r"""Triangulations of plane domains: constrained Delaunay, and refined until no angle is small.

The domain is divided by the Manifold library, and its diagonals are flipped until the angles α, β
opposite each inner edge have α + β ≤ π: the *constrained Delaunay* triangulation.  Then points are
added by Ruppert's rules, many at a time:

* a side is *encroached* if the corner opposite it lies inside of the circle that has it as a
  diameter; it is cut in the middle;
* a triangle is *poor* if its least angle is too small, R / l > 1 / (2 sin α), R its circumradius
  and l its shortest side, or if it is too large: the centre of its circumcircle becomes a point, or
  if that would encroach sides, or lies beyond one, these are cut instead.

Where two sides meet at a sharp corner, cuts would call for one another without end.  Sides there
are cut at distances from the corner that are powers of two, and a triangle whose shortest side
joins such cuts of the two sides at the same distance stays as it is.

References
----------
Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional mesh generation" (1995).
Miller, Pav, Walkington, "When and why Delaunay refinement algorithms work" (2005).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.errors import MeshError

_ROUNDING = 1e-12
_MOST_ROUNDS = 400
_SHARP = 0.5  # the cosine of 60 degrees
_SAME = 1e-6


class Quality(NamedTuple):
    """What triangles are to be: the least angle in degrees, and the largest area."""

    angle: float
    area: float


class PlaneMesh(NamedTuple):
    """A triangulation of a plane domain on its way.

    Attributes
    ----------
    P : (n, 2) float
    F : (m, 3) int
        Counterclockwise.
    twin : (m, 3) int
        The half-edge ``3 f + s`` on the other side of that opposite corner s; -1 on the boundary.
    """

    P: Floats
    F: Ints
    twin: Ints

    @classmethod
    def of(cls, P: Floats, F: Ints) -> PlaneMesh:
        """With the neighbours of every face."""
        tail, head = np.roll(F, -1, axis=1).ravel(), np.roll(F, 1, axis=1).ravel()
        key = np.minimum(tail, head) * len(P) + np.maximum(tail, head)
        order = np.argsort(key, kind="stable")
        pairs = np.flatnonzero(key[order][1:] == key[order][:-1])
        twin = np.full(F.size, -1, dtype=np.int64)
        twin[order[pairs]], twin[order[pairs + 1]] = order[pairs + 1], order[pairs]
        return cls(P, F, twin.reshape(-1, 3))

    def ends(self, half_edges: Ints) -> tuple[Ints, Ints]:
        """The vertices from which and to which sides lead."""
        face, s = np.divmod(half_edges, 3)
        return self.F[face, (s + 1) % 3], self.F[face, (s + 2) % 3]


def triangulated(P: Floats, rings: list[Ints], quality: Quality) -> tuple[Floats, Ints]:
    """Triangulate a plane domain.

    Parameters
    ----------
    P : (n, 2) float
        Of size about 1.
    rings : list of (k,) int
        The corners of the boundary curves, with the domain on the left; they do not meet.
    quality : Quality
        An angle of 0 and an infinite area add no points.

    Returns
    -------
    V : (n', 2) float
        P, and what was added.
    F : (m, 3) int
    """
    from manifold3d import triangulate

    corners = np.concatenate(rings)
    found = triangulate([np.ascontiguousarray(P[ring]) for ring in rings], 0.0, False)
    F = corners[np.asarray(found, dtype=np.int64).reshape(-1, 3)]
    # Euler: a ring more is a bridge more, of two triangles.
    if len(F) != corners.size + 2 * len(rings) - 4 or np.unique(F).size != corners.size:
        raise MeshError(f"a domain of {corners.size} corners cannot be triangulated.")
    mesh = constrained_delaunay(PlaneMesh.of(P, F))
    if quality.angle > 0.0 or np.isfinite(quality.area):
        mesh = _refined(mesh, rings, quality)
    return mesh.P, mesh.F


def constrained_delaunay(mesh: PlaneMesh) -> PlaneMesh:
    """Flip inner edges until the angles opposite to each add up to 180 degrees at most."""
    # Every flip lowers the Dirichlet energies, so that they end; in a fan one calls for the next.
    for _ in range(_MOST_ROUNDS + 4 * len(mesh.F)):
        illegal = _illegal(mesh)
        if illegal.size == 0:
            break
        mesh = _flipped(mesh, _without_common_faces(mesh, illegal))
    return mesh


def _illegal(mesh: PlaneMesh) -> Ints:
    """One side of each inner edge with α + β > π, those that are furthest from it first."""
    side = np.flatnonzero(mesh.twin.ravel() > np.arange(mesh.twin.size))
    other = mesh.twin.ravel()[side]
    cross, dot = _opposite(mesh, side)
    cross_there, dot_there = _opposite(mesh, other)
    sine = cross * dot_there + cross_there * dot
    scale = np.hypot(cross, dot) * np.hypot(cross_there, dot_there)
    order = np.argsort(sine / scale, kind="stable")
    illegal = order[(sine < -_ROUNDING * scale)[order]]
    side, other = side[illegal], other[illegal]
    return side[_is_convex(mesh, side, other)]


def _opposite(mesh: PlaneMesh, side: Ints) -> tuple[Floats, Floats]:
    """Cross and scalar product of the vectors from the opposite corner to the ends of sides."""
    face, s = np.divmod(side, 3)
    apex = mesh.P[mesh.F[face, s]]
    u, v = (mesh.P[end] - apex for end in mesh.ends(side))
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], np.einsum("ij,ij->i", u, v)


def _is_convex(mesh: PlaneMesh, side: Ints, other: Ints) -> Bools:
    """Whether both triangles on the other diagonal are counterclockwise."""
    a, b = (mesh.P[end] for end in mesh.ends(side))
    c, d = (mesh.P[mesh.F[h // 3, h % 3]] for h in (side, other))
    return np.asarray((turn(c, a, d) > 0) & (turn(d, b, c) > 0))


def _without_common_faces(mesh: PlaneMesh, side: Ints) -> Ints:
    """Edges of which no two have a face in common: each is the first one at both of its faces."""
    rank = np.arange(side.size)
    faces = np.stack([side // 3, mesh.twin.ravel()[side] // 3])
    first = np.full(len(mesh.F), side.size, dtype=np.int64)
    np.minimum.at(first, faces, np.broadcast_to(rank, faces.shape))
    return side[(first[faces] == rank).all(axis=0)]


def _flipped(mesh: PlaneMesh, side: Ints) -> PlaneMesh:
    other = mesh.twin.ravel()[side]
    a, b = mesh.ends(side)
    c, d = mesh.F[side // 3, side % 3], mesh.F[other // 3, other % 3]
    F = mesh.F.copy()
    F[side // 3] = np.stack([c, a, d], axis=1)
    F[other // 3] = np.stack([d, b, c], axis=1)
    return PlaneMesh.of(mesh.P, F)


class _Boundary(NamedTuple):
    """Where the points on the boundary lie.

    Attributes
    ----------
    side : (n,) int
        The side of a polygon, known by the corner at its beginning, within which a point was added;
        -1 for corners and inner points.
    after : (k,) int
        The corner at the end of each side.
    sharp : (k,) bool
        Whether the angle at a corner is below 60 degrees.
    """

    side: Ints
    after: Ints
    sharp: Bools


def _refined(mesh: PlaneMesh, rings: list[Ints], quality: Quality) -> PlaneMesh:
    boundary = _boundary(mesh.P, rings)
    for _ in range(_MOST_ROUNDS):
        cuts = _encroached(mesh)
        points = np.zeros((0, 2))
        if cuts.size == 0:
            points, where, cuts = _centres(mesh, boundary, quality)
        if cuts.size:
            mesh, boundary = _cut(mesh, boundary, cuts)
        elif len(points):
            mesh = _inserted(mesh, points, where)
            added = np.full(len(mesh.P) - boundary.side.size, -1, dtype=np.int64)
            boundary = boundary._replace(side=np.concatenate([boundary.side, added]))
        else:
            break
        mesh = constrained_delaunay(mesh)
    return mesh


def _boundary(P: Floats, rings: list[Ints]) -> _Boundary:
    after, sharp = np.empty(len(P), dtype=np.int64), np.zeros(len(P), dtype=bool)
    for ring in rings:
        after[ring] = np.roll(ring, -1)
        u, v = P[np.roll(ring, -1)] - P[ring], P[np.roll(ring, 1)] - P[ring]
        cosine = np.einsum("ij,ij->i", u, v) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1)
        sharp[ring] = (cosine > _SHARP) & (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] > 0)
    return _Boundary(np.full(len(P), -1, dtype=np.int64), after, sharp)


def _encroached(mesh: PlaneMesh) -> Ints:
    """The free sides whose opposite corner sees them under more than 90 degrees."""
    side = np.flatnonzero(mesh.twin.ravel() < 0)
    cross, dot = _opposite(mesh, side)
    return side[dot < -_ROUNDING * cross]


def _centres(mesh: PlaneMesh, boundary: _Boundary, quality: Quality) -> tuple[Floats, Ints, Ints]:
    """Points to be added in the circumcentres of poor triangles, or sides to be cut instead.

    Returns
    -------
    points : (k, 2) float
    where : (k,) int
        The face that each of them lies in.
    cuts : (c,) int
    """
    face, centre, radius = _poor(mesh, boundary, quality)
    where, beyond = _walked(mesh, face, centre)
    cuts = [beyond[beyond >= 0]]
    inside = beyond < 0
    face, centre, radius, where = face[inside], centre[inside], radius[inside], where[inside]
    point, side = _encroaching(mesh, centre)
    cuts.append(side)
    found = np.unique(np.concatenate(cuts))
    keep = np.ones(len(face), dtype=bool)
    keep[point] = False
    apart = _apart(centre[keep], 0.5 * radius[keep], where[keep])
    return centre[keep][apart], where[keep][apart], found


def _encroaching(mesh: PlaneMesh, points: Floats) -> tuple[Ints, Ints]:
    """Points that lie in the circle around a free side, and the side, pair by pair."""
    from scipy.spatial import cKDTree  # slow to import

    none = np.zeros(0, dtype=np.int64)
    if len(points) == 0:
        return none, none
    side = np.flatnonzero(mesh.twin.ravel() < 0)
    a, b = (mesh.P[end] for end in mesh.ends(side))
    near = cKDTree(points).query_ball_point(0.5 * (a + b), 0.5 * np.linalg.norm(b - a, axis=1))
    which = np.repeat(np.arange(side.size), [len(found) for found in near])
    point = np.array([k for found in near for k in found], dtype=np.int64)
    # A centre may lie on a side; those that look away, behind a hole, are not seen.
    seen = turn(a[which], b[which], points[point]) > -_ROUNDING
    return point[seen], side[which[seen]]


def _poor(mesh: PlaneMesh, boundary: _Boundary, quality: Quality) -> tuple[Ints, Floats, Floats]:
    """Poor triangles, the worst first, their circumcentres and -radii."""
    a, b, c = (mesh.P[mesh.F[:, k]] for k in range(3))
    double = turn(a, b, c)
    sides = np.stack([c - b, a - c, b - a], axis=1)
    squares = np.einsum("fsi,fsi->fs", sides, sides)
    lengths = np.sqrt(squares)
    radius = lengths.prod(axis=1) / (2 * double)
    shortest = lengths.min(axis=1)
    poor = double / 2 > quality.area
    if quality.angle > 0.0:
        thin = radius / shortest > 1 / (2 * np.sin(np.radians(quality.angle)))
        poor |= thin & ~_at_sharp_corners(mesh, boundary, np.argmin(lengths, axis=1))
    face = np.flatnonzero(poor)
    face = face[np.argsort(-radius[face], kind="stable")]
    u, v = (b - a)[face], (c - a)[face]
    square_u, square_v = squares[face, 2, None], squares[face, 1, None]
    normal = square_u * v - square_v * u
    offset = np.stack([normal[:, 1], -normal[:, 0]], axis=1) / (2 * double[face, None])
    return face, a[face] + offset, radius[face]


def _at_sharp_corners(mesh: PlaneMesh, boundary: _Boundary, s: Ints) -> Bools:
    """Whether the ends of a side of each face are cuts at the same distance from a sharp corner."""
    row = np.arange(len(s))
    ends = mesh.F[row, (s + 1) % 3], mesh.F[row, (s + 2) % 3]
    one, other = (boundary.side[end] for end in ends)
    found = np.zeros(len(s), dtype=bool)
    for first, second in ((one, other), (other, one)):
        # The side that ends at the corner, and the one that begins there.
        k = np.flatnonzero((first >= 0) & (second >= 0))
        k = k[boundary.after[first[k]] == second[k]]
        corner = mesh.P[second[k]]
        p, q = (np.linalg.norm(mesh.P[end[k]] - corner, axis=1) for end in ends)
        found[k] |= boundary.sharp[second[k]] & (np.abs(p - q) < _SAME * p)
    return found


def _walked(mesh: PlaneMesh, face: Ints, target: Floats) -> tuple[Ints, Ints]:
    """From faces straight to the faces that contain points, or to the free side that is in between.

    Returns
    -------
    face : (k,) int
    beyond : (k,) int
        The free side behind which the point lies; -1 where it was reached.
    """
    face, beyond = face.copy(), np.full(len(face), -1, dtype=np.int64)
    start = mesh.P[mesh.F[face]].mean(axis=1)
    came = np.full(len(face), -1, dtype=np.int64)
    active = np.arange(len(face))
    for _ in range(len(mesh.F) + 1):
        if active.size == 0:
            break
        corners = mesh.P[mesh.F[face[active]]]
        p, q = start[active, None], target[active, None]
        a, b = np.roll(corners, -1, axis=1), np.roll(corners, 1, axis=1)
        # Sides that have the target on their other side, and are met by the way to it.
        out = turn(a, b, q) < 0
        ahead = out & (turn(p, q, a) <= 0) & (turn(p, q, b) >= 0)
        side = 3 * face[active, None] + np.arange(3)
        ahead &= side != came[active, None]
        leaving = ahead.any(axis=1)
        active, side = active[leaving], side[leaving, np.argmax(ahead[leaving], axis=1)]
        after = mesh.twin.ravel()[side]
        stopped = after < 0
        beyond[active[stopped]] = side[stopped]
        active, after = active[~stopped], after[~stopped]
        face[active], came[active] = after // 3, after
    return face, beyond


def _apart(points: Floats, radius: Floats, where: Ints) -> Ints:
    """Points, in their order, none of which is within the radius of another or in the same face."""
    from scipy.spatial import cKDTree  # slow to import

    if len(points) == 0:
        return np.zeros(0, dtype=np.int64)
    near = cKDTree(points).query_ball_point(points, radius)
    taken = np.zeros(len(points), dtype=bool)
    faces: set[int] = set()
    for k, others in enumerate(near):
        if where[k] not in faces and not taken[others].any():
            taken[k] = True
            faces.add(int(where[k]))
    return np.flatnonzero(taken)


def _cut(mesh: PlaneMesh, boundary: _Boundary, side: Ints) -> tuple[PlaneMesh, _Boundary]:
    """Cut free sides: those of different faces, each at the middle or at a power of two."""
    side = side[np.unique(side // 3, return_index=True)[1]]
    a, b = mesh.ends(side)
    new = len(mesh.P) + np.arange(side.size)
    face, s = np.divmod(side, 3)
    P = np.vstack([mesh.P, _cutting_points(mesh.P, boundary, a, b)])
    F = np.vstack([mesh.F, mesh.F[face]])
    F[face, (s + 2) % 3] = new
    F[len(mesh.F) + np.arange(side.size), (s + 1) % 3] = new
    on = np.where(boundary.side[a] >= 0, boundary.side[a], a)
    return PlaneMesh.of(P, F), boundary._replace(side=np.concatenate([boundary.side, on]))


def _cutting_points(P: Floats, boundary: _Boundary, a: Ints, b: Ints) -> Floats:
    vector = P[b] - P[a]
    length = np.linalg.norm(vector, axis=1)
    n = boundary.sharp.size
    at_a, at_b = ((end < n) & boundary.sharp[np.minimum(end, n - 1)] for end in (a, b))
    # Between a third and two thirds of the length there is one power of two.
    power = 2.0 ** np.floor(np.log2(length * 2 / 3)) / length
    part = np.where(at_a & ~at_b, power, np.where(at_b & ~at_a, 1 - power, 0.5))
    return np.asarray(P[a] + part[:, None] * vector)


def _inserted(mesh: PlaneMesh, points: Floats, where: Ints) -> PlaneMesh:
    """Join points to the corners of the faces that they lie in."""
    new = len(mesh.P) + np.arange(len(points))
    a, b, c = mesh.F[where].T
    F = np.vstack([mesh.F, np.stack([b, c, new], axis=1), np.stack([c, a, new], axis=1)])
    F[where] = np.stack([a, b, new], axis=1)
    return PlaneMesh.of(np.vstack([mesh.P, points]), F)


def turn(a: Floats, b: Floats, c: Floats) -> Floats:
    """Twice the area of a, b, c, positive if they are counterclockwise."""
    u, v = b - a, c - a
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])
