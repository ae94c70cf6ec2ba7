r"""One polygon, concave or with straight corners: its plane, its outline, its triangles.

The plane is that of Newell's normal :math:`\frac12\sum c_i\times c_{i+1}`, the vector area, or
where that vanishes the one of least squares.  There the polygon is divided by the Manifold library,
which keeps every corner: other triangulations of the plane drop corners in the middle of a straight
side, where the neighbours have vertices.

Two sides *cross* if each has its ends on both sides of the other.  If they meet in space too, the
polygon bounds nothing and is refused; corners may touch sides, as where a hole is joined to the
outer boundary by a slit.  Sides may also pass one another at a distance, in a polygon that is far
from any plane.  Then the triangles of least total area are taken.

References
----------
Barequet, Sharir, "Filling gaps in the boundary of a polyhedron" (1995), of the least area.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

# Sine of the angle below which a corner is straight.
FLAT = 1e-6
# In parts of the size of a polygon: what is no touching but a crossing, and what meets in space.
_TOUCHING, _MEETING = 1e-6, 1e-3
_FEWEST_RANK = 1e-12
_MOST_PAIRS = 10**8
_MOST_CORNERS_IN_SPACE = 200


def divided(P: Floats, face: int, corners: Ints, V: Floats) -> Ints:
    """Triangles of a polygon as numbers of its corners.

    There are d - 2 of them, or fewer where the outline touches itself in a corner.

    Parameters
    ----------
    P : (d, 3) float
        The corners, scaled at will.
    face : int
        The number of the polygon, for messages.
    corners : (d,) int
        Which vertices its corners are.
    V : (n, 3) float
        Where they are in the file.

    Raises
    ------
    MeshError
        If the outline crosses itself, or runs along a side twice.
    """
    sides = np.column_stack([corners, np.roll(corners, -1)])
    if len(np.unique(sides, axis=0)) < len(sides):
        raise _crosses(face, corners, V, 0)
    fan = np.column_stack([np.zeros(len(P) - 2, np.int64), *_next_two(len(P))])
    offset = P - P.mean(axis=0)
    size = float(np.linalg.norm(offset, axis=1).max())
    if size == 0.0:
        return fan
    flat = _in_its_plane(offset / size)
    if flat is None:
        return fan
    xy, height = flat[:, :2], flat[:, 2]
    crossing = _crossing(xy, height)
    if crossing is None:
        F = _clipped(xy)
        if _areas(xy, F).min() >= -(FLAT**2):
            # Between two corners at the same vertex there are triangles without area.
            return F[(corners[F] != corners[np.roll(F, 1, axis=1)]).all(axis=1)]
        # Crossing in a corner, or along a side.
        crossing = (int(F[_areas(xy, F).argmin(), 1]), float(np.abs(height).max()))
    corner, gap = crossing
    if gap > _MEETING:
        return _of_least_area(offset / size, face)
    raise _crosses(face, corners, V, corner)


def _crosses(face: int, corners: Ints, V: Floats, corner: int) -> MeshError:
    x, y, z = V[corners[corner]]
    return MeshError(
        f"the outline of face {face} (counted from 0, {corners.size} corners) crosses itself at "
        f"the side that begins at ({x:.6g}, {y:.6g}, {z:.6g}): it bounds no piece of a surface."
    )


def _next_two(d: int) -> tuple[Ints, Ints]:
    i = np.arange(1, d - 1)
    return i, i + 1


def _in_its_plane(P: Floats) -> Floats | None:
    """Coordinates along the plane of a polygon and across it; None for corners on a line."""
    _, singular, axes = np.linalg.svd(P, full_matrices=False)
    if singular[1] <= _FEWEST_RANK * singular[0]:
        return None
    newell = np.cross(P, np.roll(P, -1, axis=0)).sum(axis=0) / 2
    length = float(np.linalg.norm(newell))
    normal = newell / length if length > FLAT else axes[2]
    along = axes[0] - (axes[0] @ normal) * normal
    if np.linalg.norm(along) < 0.5:
        along = axes[1] - (axes[1] @ normal) * normal
    along /= np.linalg.norm(along)
    # Of a thin polygon the area says nothing about the sign of the fitted normal, but what is left.
    sign = 1.0 if normal @ newell >= 0.0 else -1.0
    return P @ np.column_stack([along, np.cross(sign * normal, along), sign * normal])


def _crossing(xy: Floats, height: Floats) -> tuple[int, float] | None:
    """The side that crosses another one closest in space, and how close; None if none does."""
    pairs = _pairs_of_sides(xy)
    if pairs is None:
        return None
    d = len(xy)
    i, j = pairs
    a, b, p, q = xy[i], xy[(i + 1) % d], xy[j], xy[(j + 1) % d]
    u, v = b - a, q - p
    length_u, length_v = np.linalg.norm(u, axis=1), np.linalg.norm(v, axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        pu, qu = _cross(u, p - a) / length_u, _cross(u, q - a) / length_u
        av, bv = _cross(v, a - p) / length_v, _cross(v, b - p) / length_v
        least = np.abs(np.stack([pu, qu, av, bv])).min(axis=0)
        crosses = (pu * qu < 0) & (av * bv < 0) & (least > _TOUCHING)
        s, t = av / (av - bv), pu / (pu - qu)
    if not crosses.any():
        return None
    i, j, s, t = i[crosses], j[crosses], s[crosses], t[crosses]
    on_one = height[i] + s * (height[(i + 1) % d] - height[i])
    on_other = height[j] + t * (height[(j + 1) % d] - height[j])
    gap = np.abs(on_one - on_other)
    return int(i[gap.argmin()]), float(gap.min())


def _pairs_of_sides(xy: Floats) -> tuple[Ints, Ints] | None:
    """Sides that are not neighbours, and whose shadows on the first axis overlap."""
    d = len(xy)
    ends = np.stack([xy[:, 0], np.roll(xy[:, 0], -1)])
    low, high = ends.min(axis=0), ends.max(axis=0)
    order = np.argsort(low, kind="stable")
    last = np.searchsorted(low[order], high[order], side="right")
    count = last - np.arange(d) - 1
    if count.sum() > _MOST_PAIRS:
        raise MeshError(
            f"a concave polygon of {d} corners is too large to be divided: triangulate it first."
        )
    one = np.repeat(np.arange(d), count)
    other = np.arange(one.size) - np.repeat(np.cumsum(count) - count, count) + one + 1
    i, j = order[one], order[other]
    apart = (np.abs(i - j) > 1) & (np.abs(i - j) < d - 1)
    return (i[apart], j[apart]) if apart.any() else None


def _clipped(xy: Floats) -> Ints:
    from manifold3d import triangulate

    # Its shortcut for convex polygons makes flat triangles of straight corners.
    clipped = triangulate([np.ascontiguousarray(xy)], FLAT, allow_convex=False)
    F = np.asarray(clipped, dtype=np.int64).reshape(-1, 3)
    if len(F) != len(xy) - 2 or np.unique(F).size != len(xy):
        raise MeshError(f"a polygon of {len(xy)} corners cannot be divided: triangulate it first.")
    return F


def _of_least_area(P: Floats, face: int) -> Ints:
    """The triangles of least total area, by dynamic programming over the chains of corners."""
    d = len(P)
    if d > _MOST_CORNERS_IN_SPACE:
        raise MeshError(
            f"face {face} (counted from 0) has {d} corners and is far from planar: triangulate it "
            "first."
        )
    least = np.zeros((d, d))
    middle = np.zeros((d, d), dtype=np.int64)
    for span in range(2, d):
        for i in range(d - span):
            k = np.arange(i + 1, i + span)
            area = np.linalg.norm(np.cross(P[k] - P[i], P[i + span] - P[i]), axis=1)
            total = least[i, k] + least[k, i + span] + area
            least[i, i + span] = total.min()
            middle[i, i + span] = k[total.argmin()]
    F: list[tuple[int, int, int]] = []
    waiting = [(0, d - 1)]
    while waiting:
        i, j = waiting.pop()
        if j - i > 1:
            between = int(middle[i, j])
            F.append((i, between, j))
            waiting += [(between, j), (i, between)]
    return np.array(F, dtype=np.int64)


def _areas(xy: Floats, F: Ints) -> Floats:
    a, b, c = xy[F[:, 0]], xy[F[:, 1]], xy[F[:, 2]]
    return _cross(b - a, c - a)


def _cross(u: Floats, v: Floats) -> Floats:
    return np.asarray(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
