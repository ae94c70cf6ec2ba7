r"""Some faces of a surface, in the names of the whole.

A piece is what ranks hand each other.  Its edges have the numbers and the directions that they have
on the surface, and its vertices their places in the order of the partition; so any faces make a
piece, several pieces make one, and how they are glued need not be told: two sides of the same edge
are glued, and a side whose other half is missing is free.  Cochains are closed on each face.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, vstack

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.complexes import DeltaComplex

_BY_FACE = ("lengths", "edge", "sign", "vertex", "distortion")


@dataclass(frozen=True, eq=False)
class Piece:
    """Faces with their sides and corners, and cochains on their edges.

    Attributes
    ----------
    lengths : (m, 3) float
    edge, vertex : (m, 3) int
        The edge of each side and the vertex at each corner.
    sign : (m, 3) int
        +1 where a side runs with its edge, -1 where against it.
    distortion : (m,) float
        As in :class:`~igl_periods.complexes.DeltaComplex`.
    edges : (n_edges,) int
        The edges of the faces, ascending.
    by_edge : (n_edges, k) sparse int
        The cochains on them.
    """

    lengths: Floats
    edge: Ints
    sign: NDArray[np.int8]
    vertex: Ints
    distortion: Floats
    edges: Ints
    by_edge: csr_array

    @property
    def n_faces(self) -> int:
        """Number of triangles."""
        return len(self.edge)

    @classmethod
    def union(cls, pieces: Sequence[Piece]) -> Piece:
        """Pieces that share no face, as one."""
        faces: dict[str, Any] = {
            name: np.concatenate([getattr(piece, name) for piece in pieces]) for name in _BY_FACE
        }
        return cls(**faces, **_values(faces["edge"], pieces))

    def some(self, faces: Ints) -> Piece:
        """Some of the faces as a piece."""
        return Piece(
            lengths=self.lengths[faces],
            edge=self.edge[faces],
            sign=self.sign[faces],
            vertex=self.vertex[faces],
            distortion=self.distortion[faces],
            **_values(self.edge[faces], [self]),
        )

    def replaced(self, faces: Ints, by: Piece) -> Piece:
        """The piece with other faces in the place of some."""
        columns: dict[str, Any] = {}
        for name in _BY_FACE:
            columns[name] = getattr(self, name).copy()
            columns[name][faces] = getattr(by, name)
        # What was flipped has its new values in the new faces.
        return Piece(**columns, **_values(columns["edge"], [by, self]))

    def opened(self) -> tuple[DeltaComplex, csr_array, NDArray[np.int8]]:
        """The piece as a complex with a boundary, whose vertices keep their names.

        Returns
        -------
        K : DeltaComplex
            Edge i is ``edges[i]``.
        cochains : (k, n_edges) sparse int
        turned : (n_edges,) int
            -1 for edges that run the other way in K: of an edge between two pieces either may
            have the side that runs against it, and in a complex the first side runs with it.
        """
        edge = np.searchsorted(self.edges, self.edge)
        order = np.argsort(edge, axis=None, kind="stable")
        sorted_edges = edge.ravel()[order]
        first = order[np.flatnonzero(np.diff(sorted_edges, prepend=-1))]
        turned = self.sign.ravel()[first]
        paired = np.flatnonzero(sorted_edges[1:] == sorted_edges[:-1])
        twin = np.full(edge.size, -1, dtype=np.int64)
        twin[order[paired]], twin[order[paired + 1]] = order[paired + 1], order[paired]
        cochains = self.by_edge.multiply(turned[:, None]).tocsr()
        K = DeltaComplex(
            lengths=self.lengths,
            twin=twin.reshape(-1, 3),
            edge=edge,
            sign=self.sign * turned[edge],
            corner_vertex=self.vertex,
            n_vertices=int(self.vertex.max(initial=-1)) + 1,
            n_edges=self.edges.size,
            labels=np.arange(0),
            distortion=self.distortion,
        )
        return K, csr_array(cochains.T.tocsr()), turned

    def along_the_seams(self, width: int) -> Ints:
        """The faces at sides that are free, and ``width`` rings of their neighbours."""
        edge = np.searchsorted(self.edges, self.edge)
        inner = np.bincount(edge.ravel(), minlength=self.edges.size) == 2
        near: Bools = ~inner
        for _ in range(width):
            near[edge[near[edge].any(axis=1)]] = True
        return np.flatnonzero(near[edge].any(axis=1))


def _values(edge: Ints, pieces: Sequence[Piece]) -> dict[str, Any]:
    """The edges of sides, and the cochains on them: of the first piece that has them."""
    known, first = np.unique(np.concatenate([p.edges for p in pieces]), return_index=True)
    edges = np.unique(edge)
    rows = first[np.searchsorted(known, edges)]
    # Nothing to stack is the common case, and the largest.
    values = vstack([p.by_edge for p in pieces], format="csr") if pieces[1:] else pieces[0].by_edge
    return {"edges": edges, "by_edge": csr_array(values[rows])}
