r"""Better shapes: Delaunay flips, and vertices at centres of badly shaped triangles.

The series of :mod:`igl_periods.enclosures.cells` converge at rates that depend on the shape of
the triangles.  So the triangulation is first made intrinsically Delaunay, edge by edge: an edge is
flipped if the cotangents of the two angles opposite it have a negative sum.  The decision is made
in floating point; that the flip is possible is proved in balls
(:meth:`~igl_periods.enclosures.triangulation.Triangulation.flip`).
"""

from __future__ import annotations

from collections import deque

import flint
import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import components_of, cotangents

from .triangulation import Triangulation, following

# Edges this close to cocircular are left alone: flipped by rounding, they would flip for ever.
_TOLERANCE = 1e-9
_FLIPS_AN_EDGE = 50
# Vertices of smaller total angle keep their sharp corners.
_SMALL_TOTAL = 1.3
# Barycentric coordinates of new vertices are at least the first number, and multiples of 1 over the
# second.
_CLOSE, _FINE = 0.06, 2**12
# New vertices, at most, for each triangle there was, and for each octave between the shortest and
# the longest edge: sizes of triangles pass from one to the other in steps.
_NEW_A_FACE, _NEW_AN_OCTAVE = 2, 5
# Cells of so many triangles get a vertex at their centres.
FEWEST = 4


def make_delaunay(surface: Triangulation, suspects: list[int] | None = None) -> None:
    """Flip edges while that makes the triangulation more Delaunay, in place.

    Parameters
    ----------
    surface : Triangulation
    suspects : list of int, optional
        Half-edges to look at; by default all.
    """
    cot = cotangents(surface.lengths_in_floats()).ravel().tolist()
    if suspects is None:
        suspects = [
            h for h, t in enumerate(surface.twin) if h < t and cot[h] + cot[t] < -_TOLERANCE
        ]
    waiting = deque(suspects)
    for _ in range(_FLIPS_AN_EDGE * len(surface.lengths) + len(waiting)):
        if not waiting:
            return
        h = waiting.popleft()
        t = surface.twin[h]
        if cot[h] + cot[t] >= -_TOLERANCE or not surface.flip(h):
            continue
        for face in (h // 3, t // 3):
            sides = range(3 * face, 3 * face + 3)
            lengths = np.array([[float(surface.length(side).mid()) for side in sides]])
            cot[3 * face : 3 * face + 3] = cotangents(lengths)[0].tolist()
        here, there = h - h % 3, t - t % 3
        waiting.extend([here, here + 2, there, there + 2])


def fan(surface: Triangulation, corner: int) -> list[int]:
    """The corners at the vertex of a corner, counterclockwise from it.

    A corner is numbered like the side opposite it.
    """
    corners = [corner]
    while True:
        # The side that arrives at corner k is side k + 1; its twin leaves corner k' = s' + 1.
        twin = surface.twin[following(corners[-1])]
        corner = following(twin)
        if corner == corners[0]:
            return corners
        corners.append(corner)


def improve_shapes(surface: Triangulation, largest_ratio: float) -> int:
    """Put flat vertices into badly shaped triangles, and flip edges; in place.

    A triangle is bad if its circumradius is larger than ``largest_ratio`` times the shortest edge
    at any of its corners, half of which is the size of the star there: beside a small star only
    small faces have series that converge fast.  It gets a vertex at its circumcentre, or where that
    lies outside close to the middle of its longest side, which Delaunay flips then replace.  A
    small angle at a vertex of small total angle is there to stay.

    Returns
    -------
    int
        The number of new vertices.
    """
    lengths = surface.lengths_in_floats()
    octaves = float(np.log2(lengths.max() / lengths.min()))
    most = 20 + int(surface.n_faces * (_NEW_A_FACE + _NEW_AN_OCTAVE * octaves))
    for inserted in range(most):
        lengths = surface.lengths_in_floats()
        angle = _angles(lengths)
        corner_vertex = np.array(surface.corner_vertex).reshape(-1, 3)
        shortest = _shortest_at_vertices(lengths, corner_vertex)[corner_vertex].min(axis=1)
        ratio = lengths.max(axis=1) / (2.0 * np.sin(angle.max(axis=1)) * shortest)
        sharpest = corner_vertex[np.arange(len(angle)), angle.argmin(axis=1)]
        total = np.bincount(surface.corner_vertex, angle.ravel(), surface.n_vertices)
        ratio[total[sharpest] < _SMALL_TOTAL] = 0.0
        worst = int(ratio.argmax())
        if ratio[worst] <= largest_ratio:
            return inserted
        first = len(surface.twin)
        surface.insert(worst, _place(angle[worst], lengths[worst]))
        make_delaunay(surface, [3 * worst, first, first + 3])
    return most


def insert_centres(surface: Triangulation, fewest: int = FEWEST) -> int:
    """Put a vertex at the centre of large regular cells, and flip edges; in place.

    Delaunay triangles at edges that are cocircular make up one cell, a polygon with its corners on
    a circle.  Its triangles are as thin as one likes, and long diagonals pass close to its centre:
    cells of so many triangles or more are divided about a vertex there instead.

    Returns
    -------
    int
        The number of new vertices.
    """
    lengths = surface.lengths_in_floats()
    cot = cotangents(lengths).ravel()
    twin = np.array(surface.twin)
    across = np.flatnonzero((np.arange(twin.size) < twin) & (np.abs(cot + cot[twin]) < _TOLERANCE))
    _, label = components_of(across // 3, twin[across] // 3, surface.n_faces)
    size = np.bincount(label)
    angle = _angles(lengths)
    inserted = 0
    for cell in np.flatnonzero(size >= fewest):
        faces = np.flatnonzero(label == cell)
        # The triangle that contains the centre, or comes closest to it, has the least large angle.
        f = int(faces[angle[faces].max(axis=1).argmin()])
        first = len(surface.twin)
        surface.insert(f, _place(angle[f], lengths[f]))
        make_delaunay(surface, [3 * f, first, first + 3])
        inserted += 1
    return inserted


def _shortest_at_vertices(lengths: Floats, corner_vertex: Ints) -> Floats:
    """The length of the shortest edge at each vertex."""
    shortest = np.full(int(corner_vertex.max()) + 1, np.inf)
    for side in range(3):
        for end in (1, 2):
            np.minimum.at(shortest, corner_vertex[:, (side + end) % 3], lengths[:, side])
    return shortest


def _place(angle: Floats, lengths: Floats) -> tuple[flint.fmpq, flint.fmpq, flint.fmpq]:
    """Barycentric coordinates of a good new vertex of a triangle."""
    weights = np.sin(2.0 * angle)
    weights = weights / weights.sum()
    if weights.min() < _CLOSE:
        longest = int(lengths.argmax())
        weights = np.full(3, 0.5 * (1.0 - _CLOSE))
        weights[longest] = _CLOSE
    a, b = (int(x) for x in np.rint(_FINE * weights[:2]))
    return flint.fmpq(a, _FINE), flint.fmpq(b, _FINE), flint.fmpq(_FINE - a - b, _FINE)


def _angles(lengths: Floats) -> Floats:
    a, b, c = lengths.T
    cosines = [
        (y * y + z * z - x * x) / (2 * y * z) for x, y, z in ((a, b, c), (b, c, a), (c, a, b))
    ]
    return np.asarray(np.arccos(np.clip(np.stack(cosines, axis=1), -1.0, 1.0)))
