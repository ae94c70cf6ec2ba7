r"""What a triangle mesh is: how its faces meet, and the surfaces that they form.

Faces are glued across the edges that exactly two of them share.  An edge with one face is on the
boundary; an edge with more faces is *non-manifold*, and nothing is glued there.  In what results
the faces at a vertex form one fan or several; a vertex with several is non-manifold too.  Cut at
those edges and vertices, every component is a surface, maybe with boundary, and

.. math:: \chi = V - E + F = 2 - 2 g - b \quad\text{or}\quad 2 - k - b,

b the number of boundary loops, g the genus of an orientable surface, k the number of crosscaps of
one that is not.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import igl
import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.complexes import (
    components_of,
    corner_vertices,
    face_components,
    next_corner,
    orientable_faces,
)
from igl_periods.display import counted

from .seams import WELD, seam_sides, tolerance_of
from .welding import first_equal_row


@dataclass(frozen=True)
class MeshComponent:
    """One surface of a mesh, cut at non-manifold edges and vertices.

    Attributes
    ----------
    triangles : int
    orientable : bool
    genus : int
        The genus, or the number of crosscaps of a surface that is not orientable.
    boundary_loops : int
    """

    triangles: int
    orientable: bool
    genus: int
    boundary_loops: int

    def __str__(self) -> str:
        """In words."""
        crosscaps = f"not orientable, {counted(self.genus, 'crosscap', 'crosscaps')}"
        loops = counted(self.boundary_loops, "boundary loop", "boundary loops")
        return ", ".join(
            [
                f"genus {self.genus}" if self.orientable else crosscaps,
                loops if self.boundary_loops else "closed",
            ]
        )


@dataclass(frozen=True)
class MeshFacts:
    """Counts of everything that decides whether a mesh is a surface.

    Attributes
    ----------
    vertices, triangles : int
    unreferenced_vertices : int
        Vertices that no triangle uses.
    coincident_vertices : int
        Vertices at exactly the position of an earlier one.
    collapsed_triangles : int
        Triangles that use a vertex twice.
    zero_area_triangles : int
        Triangles of area 0, collapsed ones included.
    duplicate_triangles : int
        Triangles with the same three vertices as an earlier one, in any order.
    boundary_edges, nonmanifold_edges : int
        Edges with one triangle, and with more than two.
    nonmanifold_vertices : int
        Vertices whose triangles form more than one fan.
    seam_edges : int
        Boundary edges that lie in pairs, as near as repair welds.
    inconsistent_edges : int
        Edges that their two triangles run through in the same direction.
    components : tuple of MeshComponent
        In the order of their first triangles.
    """

    vertices: int
    triangles: int
    unreferenced_vertices: int
    coincident_vertices: int
    collapsed_triangles: int
    zero_area_triangles: int
    duplicate_triangles: int
    boundary_edges: int
    seam_edges: int
    nonmanifold_edges: int
    nonmanifold_vertices: int
    inconsistent_edges: int
    components: tuple[MeshComponent, ...]

    def __repr__(self) -> str:
        size = f"{self.vertices} vertices, {self.triangles} triangles"
        parts = counted(len(self.components), "component", "components")
        return f"MeshFacts({size}, {parts}, {counted(len(self.defects()), 'defect', 'defects')})"

    @property
    def is_closed_surface(self) -> bool:
        """Whether the mesh is one closed, consistently oriented surface."""
        return not self.defects()

    def defects(self) -> list[str]:
        """What keeps the mesh from being one closed, oriented surface; empty if nothing does."""
        found = [
            (self.collapsed_triangles, "triangle", "triangles", "using a vertex twice"),
            (self.nonmanifold_edges, "edge", "edges", "with more than two triangles"),
            (
                self.nonmanifold_vertices,
                "vertex",
                "vertices",
                "with more than one fan of triangles",
            ),
            (self.inconsistent_edges, "edge", "edges", "across which orientations disagree"),
            (
                self.boundary_edges - self.seam_edges,
                *("edge", "edges", "with one triangle (boundary)"),
            ),
            (
                self.seam_edges,
                *("edge", "edges", "with one triangle, in pairs at the same place (seams)"),
            ),
        ]
        words = [f"{counted(n, one, many)} {what}" for n, one, many, what in found if n]
        if len(self.components) > 1:
            words.append(f"{len(self.components)} components")
        if not all(part.orientable for part in self.components):
            words.append("not orientable")
        return words


def mesh_facts(V: Floats, F: Ints) -> MeshFacts:
    """Count what decides whether a mesh is a surface.

    Parameters
    ----------
    V : (n, 3) float
    F : (m, 3) int

    Examples
    --------
    >>> V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> mesh_facts(V, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])).is_closed_surface
    True
    """
    twin, same, faces_at = glued_in_pairs(F)
    fan, n_fans = corner_vertices(twin, same)
    fan_vertex = np.empty(n_fans, dtype=np.int64)
    fan_vertex[fan] = F
    used = np.unique(F)
    key = edge_keys(F)
    free = np.flatnonzero(faces_at.ravel() == 1)
    one, _, _ = seam_sides(V, F, free, tolerance_of(V, F, WELD))
    return MeshFacts(
        vertices=len(V),
        triangles=len(F),
        unreferenced_vertices=len(V) - used.size,
        coincident_vertices=int(np.count_nonzero(repeats(V))),
        collapsed_triangles=int(np.count_nonzero(collapsed(F))),
        zero_area_triangles=int(np.count_nonzero(igl.doublearea(V, F) == 0.0)),
        duplicate_triangles=int(np.count_nonzero(repeats(np.sort(F, axis=1)))),
        boundary_edges=free.size,
        seam_edges=2 * one.size,
        nonmanifold_edges=np.unique(key[faces_at.ravel() > 2]).size,
        nonmanifold_vertices=int(np.count_nonzero(np.bincount(fan_vertex) > 1)),
        inconsistent_edges=int(np.count_nonzero(same)) // 2,
        components=_components(twin, same, fan),
    )


def repeats(rows: NDArray[Any]) -> Bools:
    """Mask of the rows that equal an earlier one."""
    return first_equal_row(rows) != np.arange(len(rows))


def collapsed(F: Ints) -> Bools:
    """Mask of the triangles that use a vertex twice."""
    return (F == np.roll(F, 1, axis=1)).any(axis=1)


def edge_keys(F: Ints) -> Ints:
    """For each half-edge ``3 f + s`` a number that is the same for the same pair of vertices."""
    tail, head = np.roll(F, -1, 1).ravel(), np.roll(F, 1, 1).ravel()
    return np.minimum(tail, head) * (int(F.max()) + 1) + np.maximum(tail, head)


def glued_in_pairs(F: Ints) -> tuple[Ints, Bools, Ints]:
    """Glue faces across the edges that exactly two of them share.

    Returns
    -------
    twin, same : (m, 3) int, (m, 3) bool
        The gluing, -1 where nothing is glued, and where the two sides run the same way.
    faces_at : (m, 3) int
        Number of faces at the edge of each side.
    """
    _, inverse, count = np.unique(edge_keys(F), return_inverse=True, return_counts=True)
    faces_at = count[inverse.ravel()]
    paired = np.flatnonzero(faces_at == 2)
    one, other = paired[np.argsort(inverse.ravel()[paired], kind="stable")].reshape(-1, 2).T
    twin = np.full(F.size, -1, dtype=np.int64)
    twin[one], twin[other] = other, one
    tail = np.roll(F, -1, 1).ravel()
    same = np.zeros(F.size, dtype=bool)
    same[one] = same[other] = tail[one] == tail[other]
    return twin.reshape(-1, 3), same.reshape(-1, 3), faces_at.reshape(-1, 3)


def _components(twin: Ints, same: Bools, fan: Ints) -> tuple[MeshComponent, ...]:
    n, label = face_components(twin)
    orientable = orientable_faces(twin, same)
    first = np.unique(label, return_index=True)[1]
    triangles = np.bincount(label, minlength=n)
    vertices = np.bincount(label[np.unique(fan, return_index=True)[1] // 3], minlength=n)
    free = np.flatnonzero(twin.ravel() < 0)
    loops = _boundary_loops(free, fan, label, n)
    # Every side is half an edge, but for the free ones.
    edges = (3 * triangles + np.bincount(label[free // 3], minlength=n)) // 2
    missing = 2 - (vertices - edges + triangles) - loops
    return tuple(
        MeshComponent(
            triangles=int(triangles[c]),
            orientable=bool(orientable[f]),
            genus=int(missing[c]) // (2 if orientable[f] else 1),
            boundary_loops=int(loops[c]),
        )
        for f, c in sorted((int(f), c) for c, f in enumerate(first))
    )


def _boundary_loops(free: Ints, fan: Ints, label: Ints, n: int) -> Ints:
    """Number of boundary loops of each component: free sides, joined at their ends."""
    start, end = fan.ravel()[next_corner(free)], fan.ravel()[next_corner(free, 2)]
    _, loop = components_of(start, end, int(fan.max()) + 1)
    _, one_side_of_each = np.unique(loop[start], return_index=True)
    return np.bincount(label[free[one_side_of_each] // 3], minlength=n)
