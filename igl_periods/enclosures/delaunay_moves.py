r"""Better shapes: Delaunay flips, and vertices at centres of badly shaped triangles.

The series of :mod:`igl_periods.enclosures.cells` converge at rates that depend on the shape of
the triangles.  So the triangulation is first made intrinsically Delaunay, edge by edge: an edge is
flipped if the cotangents of the two angles opposite it have a negative sum.  The decision is made
in floating point; that the flip is possible is proved in balls
(:meth:`~igl_periods.enclosures.triangulation.Triangulation.flip`).
"""

from __future__ import annotations

from collections import deque

import numpy as np

from igl_periods.complexes import cotangents

from .triangulation import Triangulation, following

# Edges this close to cocircular are left alone: flipped by rounding, they would flip for ever.
_TOLERANCE = 1e-9
_FLIPS_AN_EDGE = 50


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
        suspects = [h for h, t in enumerate(surface.twin) if h < t and cot[h] + cot[t] < -_TOLERANCE]
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
