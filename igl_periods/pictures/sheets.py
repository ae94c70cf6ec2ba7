"""What there is to see of a surface: of a double one sheet, of a periodic surface its cell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, involution
from igl_periods.errors import ComplexError


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
    """

    V: Floats
    F: Ints
    corner: Ints
    source: Ints
    complex: DeltaComplex

    @classmethod
    def of(cls, K: DeltaComplex) -> Sheet:
        """The first sheet of a double, or the whole surface.

        Raises
        ------
        ComplexError
            As :func:`surface_in_space`.
        """
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

    def ends(self, half_edges: Ints) -> tuple[Ints, Ints]:
        """The rows of V from which and to which half-edges of the complex lead."""
        face, s = np.divmod(half_edges, 3)
        return self.corner[face, (s + 1) % 3], self.corner[face, (s + 2) % 3]
