r"""The complex double of a surface that is not closed or not oriented.

Take two copies of every face, the second one with the reversed orientation.  Glue

* two sides whose faces agree in orientation: within either sheet;
* two sides whose faces disagree: each to the other one's copy in the other sheet;
* a side on the boundary: to its own copy.

The result is closed and oriented, whatever the surface was, and exchanging the copies is an
isometry σ of it that reverses the orientation.  The surface is the quotient by σ, its boundary
the fixed points.  Where only a part of the boundary is glued to its copy, the rest is the boundary
of the result.  What that means for the period matrix: :mod:`igl_periods.periods.real_surfaces`.

References
----------
Alling, Greenleaf, "Foundations of the theory of Klein surfaces" (1971), section 1.6.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Bools, Ints, ReadOnlyArrays
from igl_periods.display import arrays_repr
from igl_periods.errors import ComplexError

from .checked_arrays import checked_array
from .delta_complex import DeltaComplex
from .exact_lengths import LengthsAbove
from .gluings import reversing_sides
from .half_edges import forward_half_edges
from .surface_arguments import of_a_surface

# Corner (and side) c of a face is corner (and side) _MIRROR[c] of its copy.
_MIRROR = np.array([0, 2, 1])


@dataclass(frozen=True, eq=False)
class Involution(ReadOnlyArrays):
    """The isometry σ of a double that exchanges the two sheets.

    Attributes
    ----------
    face : (2 m,) int
        Image of each face.
    vertex : (n_vertices,) int
        Image of each vertex.
    half_edge : (6 m,) int
        Image of each half-edge ``3 f + s``; σ takes it to this half-edge run backwards.
    edge, sign : (n_edges,) int, (n_edges,) int8
        Image of each edge, and +1 where σ keeps its direction, -1 where it reverses it.
    """

    __repr__ = arrays_repr

    face: Ints
    vertex: Ints
    half_edge: Ints
    edge: Ints
    sign: NDArray[np.int8]

    def pull_back(self, cochains: csr_array) -> csr_array:
        """The cochains σ*c, with the values ``sign[e] c[edge[e]]``; (k, n_edges) sparse."""
        size = self.edge.size
        matrix = csr_array((self.sign.astype(np.int64), (self.edge, np.arange(size))), (size, size))
        return csr_array(cochains @ matrix)


@of_a_surface
def double(K: DeltaComplex, *, along: ArrayLike | None = None) -> DeltaComplex:
    """The complex double of a surface: closed, oriented, with an orientation-reversing isometry.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`, with or without boundary, orientable
        or not, oriented consistently or not.
    along : (k,) array-like of int, optional
        Half-edges ``3 f + s`` of the boundary, the only ones that are glued to their copies; by
        default all of them.

    Returns
    -------
    DeltaComplex
        With 2 m faces: face f + m is the copy of face f, with corners 0, 2, 1 of f in this
        order.  Vertices have the labels and positions of those they lie over, edges their exact
        lengths.  It is connected iff
        ``K`` is connected and has a boundary or is not orientable; the double of a closed
        orientable surface is that surface and its mirror image, see
        :meth:`DeltaComplex.components`.

    Raises
    ------
    ComplexError
        If ``along`` names what is not a half-edge of the boundary.

    Examples
    --------
    >>> from igl_periods import DeltaComplex, period_matrix
    >>> disk = DeltaComplex.from_lengths([[1, 1, 1]], [[0, 1, 2]])
    >>> double(disk).genus
    0
    """
    copy = _copies(K.n_faces)
    first = np.arange(3 * K.n_faces)
    other = K.twin.ravel()
    reversing = reversing_sides(K.twin, K.sign).ravel()
    twin = np.empty(2 * first.size, dtype=np.int64)
    mirror = copy[first] if along is None else np.where(_mirrors(K, along), copy[first], -1)
    twin[first] = np.where(other < 0, mirror, np.where(reversing, copy[other], other))
    twin[copy[first]] = np.where(twin[first] < 0, -1, copy[twin[first]])
    lengths = np.concatenate([K.lengths, K.lengths[:, _MIRROR]])
    doubled = DeltaComplex.from_gluing(lengths, twin.reshape(-1, 3))
    below = np.empty(doubled.n_vertices, dtype=np.int64)
    below[doubled.corner_vertex] = np.concatenate([K.corner_vertex, K.corner_vertex[:, _MIRROR]])
    return replace(
        doubled,
        labels=K.labels[below],
        positions=None if K.positions is None else K.positions[below],
        mollification=K.mollification,
        cell=None if K.cell is None else K.cell.doubled(),
        exact_lengths=_lengths_above(K, doubled),
    )


def _lengths_above(K: DeltaComplex, doubled: DeltaComplex) -> LengthsAbove | None:
    if K.exact_lengths is None:
        return None
    below = np.empty(doubled.n_edges, dtype=np.int64)
    below[doubled.edge] = np.concatenate([K.edge, K.edge[:, _MIRROR]])
    return LengthsAbove(K.exact_lengths, below)


def _mirrors(K: DeltaComplex, along: ArrayLike) -> Bools:
    """Mask of the half-edges at which the sheets are glued to each other; (3 m,)."""
    chosen = np.atleast_1d(checked_array(along, "along", ComplexError))
    free = K.twin.ravel() < 0
    if chosen.size and chosen.dtype.kind not in "iu":
        raise ComplexError(f"along must be half-edges 3 f + s, integers, not {chosen.dtype}.")
    wrong = [h for h in chosen.tolist() if not (0 <= h < free.size and free[h])]
    if wrong:
        raise ComplexError(f"half-edge {wrong[0]} of along is not a side of the boundary.")
    glued = np.zeros(free.size, dtype=bool)
    glued[chosen.astype(np.int64)] = True
    return glued


def lift(K: DeltaComplex, doubled: DeltaComplex, cochains: csr_array) -> csr_array:
    """Pull cochains of a surface back to its double, where they are invariant under σ.

    Parameters
    ----------
    K, doubled : DeltaComplex
        A surface and its :func:`double`.
    cochains : (k, K.n_edges) sparse
        Closed cochains stay closed.

    Returns
    -------
    (k, doubled.n_edges) sparse
    """
    # A copy of a half-edge runs against it.
    edge = np.concatenate([K.edge, K.edge[:, _MIRROR]]).ravel()
    sign = np.concatenate([K.sign, -K.sign[:, _MIRROR]]).ravel().astype(np.int64)
    forward = forward_half_edges(doubled)
    projection = csr_array(
        (sign[forward], (edge[forward], doubled.edge.ravel()[forward])),
        shape=(K.n_edges, doubled.n_edges),
    )
    return csr_array(cochains @ projection)


def involution(doubled: DeltaComplex) -> Involution:
    """The isometry σ of a double, which exchanges face f with face f + m.

    Raises
    ------
    ComplexError
        If the complex is not what :func:`double` returns, for instance one component of it or
        its Delaunay triangulation.
    """
    m, odd = divmod(doubled.n_faces, 2)
    image = _copies(m) if not odd else np.zeros(0, dtype=np.int64)
    twin, edge, sign = doubled.twin.ravel(), doubled.edge.ravel(), doubled.sign.ravel()
    if odd or np.any(twin < 0) or not np.array_equal(twin[image], image[twin]):
        raise ComplexError(
            f"the complex, of {doubled.n_faces} faces, is not a double: exchanging face f with "
            "face f + m does not respect its gluing. Take the involution of double(K) itself."
        )
    forward = np.empty(doubled.n_edges, dtype=np.int64)
    running = np.flatnonzero(sign > 0)
    forward[edge[running]] = running
    corner = np.arange(twin.size)
    vertex = np.empty(doubled.n_vertices, dtype=np.int64)
    vertex[doubled.corner_vertex.ravel()] = doubled.corner_vertex.ravel()[image[corner]]
    return Involution(
        face=(np.arange(2 * m) + m) % (2 * m),
        vertex=vertex,
        half_edge=image,
        edge=edge[image[forward]],
        sign=(-sign[image[forward]]).astype(np.int8),
    )


def _copies(m: int) -> Ints:
    """The half-edge (or corner) of the other sheet over the same one of the surface; (6 m,)."""
    face, side = np.divmod(np.arange(6 * m), 3)
    return 3 * ((face + m) % (2 * m)) + _MIRROR[side]
