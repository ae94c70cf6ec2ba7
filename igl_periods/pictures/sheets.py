"""Where a surface is drawn: in space, or unfolded in the plane.

A surface with positions lies in space.  One that was glued from polygons lies in the plane, as its
polygons do.  Any other can be cut to a disk and developed by z = ∫ζ, which is an isometry on every
triangle of a flat surface with ζ = dz, and conformal up to the error of discretisation otherwise;
the image may overlap itself.  In the plane a vertex of the surface is drawn several times, and a
closed walk is drawn in pieces.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import igl
import numpy as np

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex, involution
from igl_periods.differentials import Parametrization
from igl_periods.display import arrays_repr
from igl_periods.errors import ComplexError

from .polygon_drawing import laid_out
from .tubes import smooth_closed_curves


@dataclass(frozen=True, eq=False)
class Sheet:
    """What there is to see of a surface: all of it, but of a double the first sheet only.

    Attributes
    ----------
    V, F : (k, 3) float, (m, 3) int
        Points and triangles: the first m faces of the surface.
    vertex : (k,) int
        The vertex of the surface at each point.
    corner : (faces, 3) int
        The point at each corner of all faces; of the second sheet those below them.
    unfolded : bool
        Whether the surface is cut, and lies in the plane.
    """

    __repr__ = arrays_repr

    V: Floats
    F: Ints
    vertex: Ints
    corner: Ints
    unfolded: bool = False

    @classmethod
    def of(cls, K: DeltaComplex) -> Sheet:
        """The surface in space; where it has no positions, the polygons it was glued from.

        Raises
        ------
        ComplexError
            If it has neither, or its positions are in more than 3 dimensions.
        """
        if K.positions is None and K.polygons is not None:
            return cls._of_polygons(K)
        V, F = surface_in_space(K)
        everything = np.arange(len(V))
        try:
            image = involution(K).vertex
        except ComplexError:
            return cls(V, F, everything, F)
        if not np.array_equal(V[image], V):
            return cls(V, F, everything, F)
        first = F[: len(F) // 2]
        seen = np.zeros(len(V), dtype=bool)
        seen[first] = True
        return cls(V, first, everything, np.where(seen, everything, image)[F])

    @classmethod
    def developed(cls, P: Parametrization) -> Sheet:
        """The surface cut to a disk, in the plane of z = ∫ζ."""
        return cls(_in_space(P.uv), P.corner, P.vertex, P.corner, unfolded=True)

    @classmethod
    def _of_polygons(cls, K: DeltaComplex) -> Sheet:
        assert K.polygons is not None
        placed, _ = laid_out([polygon.copy() for polygon in K.polygons.xy])
        first = np.cumsum([0, *map(len, placed)])
        corner = first[K.polygons.polygon][:, None] + K.polygons.corners
        vertex = np.zeros(first[-1], dtype=np.int64)
        vertex[corner] = K.corner_vertex
        z = np.concatenate(placed) @ np.array([1.0, 1j])
        return cls(_in_space(z), corner, vertex, corner, unfolded=True)

    def ends(self, half_edges: Ints) -> tuple[Ints, Ints]:
        """The points at which half-edges start and end."""
        face, side = np.divmod(half_edges, 3)
        return self.corner[face, (side + 1) % 3], self.corner[face, (side + 2) % 3]

    def closed_curves(self, walks: list[Ints]) -> list[list[tuple[Floats, Floats]]]:
        """Closed walks along half-edges as curves: points, and the normals of the surface there.

        In space each is one closed curve, shortened and smoothed; in the plane it is in pieces.
        """
        if self.unfolded:
            return [[self._along(piece) for piece in self._pieces(walk)] for walk in walks]
        closed = smooth_closed_curves(self.V, self.F, [self.V[self.ends(w)[0]] for w in walks])
        return [[curve] for curve in closed]

    def segments(self, half_edges: Ints) -> list[tuple[Floats, Floats]]:
        """Half-edges as straight curves."""
        return [self._along(ends) for ends in np.stack(self.ends(half_edges), axis=1)]

    def _along(self, points: Ints) -> tuple[Floats, Floats]:
        return self.V[points], self.normals[points]

    @cached_property
    def normals(self) -> Floats:
        """Unit normals at the points; (k, 3)."""
        if self.unfolded:
            return np.tile([0.0, 0.0, 1.0], (len(self.V), 1))
        return np.asarray(igl.per_vertex_normals(self.V, self.F))

    def _pieces(self, walk: Ints) -> list[Ints]:
        """The points of a walk, in pieces that hang together in the plane."""
        start, end = self.ends(walk)
        breaks = np.flatnonzero(end[:-1] != start[1:]) + 1
        return [
            np.concatenate([piece, end[last : last + 1]])
            for piece, last in zip(np.split(start, breaks), [*(breaks - 1), len(walk) - 1])
        ]


def surface_in_space(K: DeltaComplex) -> tuple[Floats, Ints]:
    """Positions (n, 3) and faces (m, 3) of a complex, plane ones with z = 0.

    Raises
    ------
    ComplexError
        If the complex has no positions, or they are in more than 3 dimensions.
    """
    if K.positions is None:
        raise ComplexError(
            "the surface has no positions in space, only lengths, so there is nothing to draw. "
            "A surface made of V and F has positions."
        )
    n, dimension = K.positions.shape
    if dimension > 3:
        raise ComplexError(
            f"the surface lies in R^{dimension}: project it to space first (stereographically, "
            "for a surface in S^3)."
        )
    V = np.zeros((n, 3))
    V[:, :dimension] = K.positions
    return V, K.corner_vertex


def _in_space(z: Complexes) -> Floats:
    return np.stack([z.real, z.imag, np.zeros(z.shape)], axis=-1)
