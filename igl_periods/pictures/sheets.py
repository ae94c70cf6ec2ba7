"""What there is to see of a surface, and where: in space, or unfolded in the plane.

Of a double that is one sheet, of a periodic surface its cell.  A surface without positions that was
glued from polygons lies in the plane, as its polygons do.  Any other can be cut to a disk and
developed by z = ∫ζ, which is an isometry on every triangle of a flat surface with ζ = dz, and
conformal up to the error of discretisation otherwise; the image may overlap itself.  In the plane a
vertex of the surface is drawn several times, and a closed walk in pieces.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, involution
from igl_periods.differentials import Parametrization
from igl_periods.errors import ComplexError

from .polygon_drawing import laid_out


def surface_in_space(K: DeltaComplex) -> tuple[Floats, Ints]:
    """Positions (n, 3) and faces (m, 3) of a complex, plane ones with z = 0.

    They are the vertices of the complex and its faces; of the quotient of a periodic surface those
    of its cell.

    Raises
    ------
    ComplexError
        If the complex has no positions, or they are in more than 3 dimensions.
    """
    if K.cell is not None:
        points = K.cell.corners.reshape(3 * K.n_faces, -1)
        positions, F = np.unique(points, axis=0, return_inverse=True)
        return _in_space(positions), F.reshape(-1, 3)
    if K.positions is None:
        raise ComplexError(
            "the surface has no positions in space, only lengths, so there is nothing to draw. "
            "A surface made of V and F has positions."
        )
    return _in_space(K.positions), K.corner_vertex


def _in_space(positions: Floats) -> Floats:
    n, dimension = positions.shape
    if dimension > 3:
        raise ComplexError(
            f"the surface lies in R^{dimension}: project it to space first (stereographically, "
            "for a surface in S^3)."
        )
    V = np.zeros((n, 3))
    V[:, :dimension] = positions
    return V


@dataclass(frozen=True, eq=False)
class Sheet:
    """What there is to see of a surface: all of it, but of a double the first sheet only.

    The second sheet lies in the same place.

    Attributes
    ----------
    V, F : (n, 3) float, (m, 3) int
    corner : (m', 3) int
        The row of V at each corner of all faces of the complex, those of the second sheet too.
    source : (n,) int
        The vertex of the complex at each row of V.
    complex : DeltaComplex
    unfolded : bool
        Whether the surface is cut, and lies in the plane.
    """

    V: Floats
    F: Ints
    corner: Ints
    source: Ints
    complex: DeltaComplex
    unfolded: bool = False

    @classmethod
    def of(cls, K: DeltaComplex) -> Sheet:
        """The first sheet of a double, or the whole surface; or the polygons it was glued from.

        Raises
        ------
        ComplexError
            As :func:`surface_in_space`, unless there are polygons.
        """
        if K.cell is None and K.positions is None and K.polygons is not None:
            return cls._of_polygons(K)
        V, F = surface_in_space(K)
        source = np.empty(len(V), dtype=np.int64)
        source[F] = K.corner_vertex
        m = K.n_faces // 2
        try:
            image = involution(K).half_edge.reshape(-1, 3)
        except ComplexError:
            return cls(V, F, F, source, K)
        # Corners have the numbers of the sides opposite to them.
        below = F.ravel()[image[m:]]
        if not np.array_equal(V[below], V[F[m:]]):
            return cls(V, F, F, source, K)
        return cls(V, F[:m], np.concatenate([F[:m], below]), source, K)

    @classmethod
    def developed(cls, P: Parametrization) -> Sheet:
        """The surface cut to a disk, in the plane of z = ∫ζ."""
        V = _in_space(np.stack([P.uv.real, P.uv.imag], axis=1))
        return cls(V, P.corner, P.corner, P.vertex, P.complex, unfolded=True)

    @classmethod
    def _of_polygons(cls, K: DeltaComplex) -> Sheet:
        assert K.polygons is not None
        placed, _ = laid_out([polygon.copy() for polygon in K.polygons.xy])
        first = np.cumsum([0, *map(len, placed)])
        corner = first[K.polygons.polygon][:, None] + K.polygons.corners
        source = np.zeros(first[-1], dtype=np.int64)
        source[corner] = K.corner_vertex
        return cls(_in_space(np.concatenate(placed)), corner, corner, source, K, unfolded=True)

    def ends(self, half_edges: Ints) -> tuple[Ints, Ints]:
        """The rows of V from which and to which half-edges of the complex lead."""
        face, s = np.divmod(half_edges, 3)
        return self.corner[face, (s + 1) % 3], self.corner[face, (s + 2) % 3]

    def pieces(self, walk: Ints) -> list[Ints]:
        """The rows of V that a walk along half-edges passes, in pieces that hang together."""
        start, end = self.ends(walk)
        breaks = np.flatnonzero(end[:-1] != start[1:]) + 1
        return [
            np.concatenate([piece, end[last : last + 1]])
            for piece, last in zip(np.split(start, breaks), [*(breaks - 1), len(walk) - 1])
        ]
