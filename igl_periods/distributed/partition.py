r"""A surface divided among ranks, so that each holds a part of it and little more.

Vertices get a new order, and each rank owns a contiguous range of it.  The order comes from
recursive bisection: the level structure of a breadth-first search (reverse Cuthill–McKee) is cut
where it is right for the ranks on both sides, and each half is treated likewise.  So the domain of
a rank is about as wide as it is long, and of the :math:`n/N` vertices of a rank some
:math:`\sqrt{n/N}` lie at its boundary; no positions are needed, which an abstract gluing does not
have.

A face belongs to the rank of the first of its corners in this order.  The part of a rank is the
Δ-complex of its faces, cut open where it meets the others.  Its vertices are those that the rank
owns, followed by the *ghosts*: corners of its faces that another rank owns.  The energy of a form
is the sum of its energies on the parts; so is the Laplacian, which is why no rank has to know the
faces of another one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from igl_periods.arrays import Ints
from igl_periods.complexes import DeltaComplex, half_edge_ends

from .pieces import Piece


@dataclass(frozen=True, eq=False)
class Part:
    """What one rank holds of a surface.

    Attributes
    ----------
    complex : DeltaComplex
        Its faces.  ``labels`` are the numbers of the vertices in the order of the partition,
        first those that the rank owns, ascending.
    cochains : (k, n_edges) sparse int
        The cochains on its edges.
    n_owned : int
        Number of vertices that the rank owns, whether its faces touch them or not.
    """

    complex: DeltaComplex
    cochains: csr_array
    n_owned: int

    @classmethod
    def of(cls, piece: Piece, start: int, end: int) -> Part:
        """The part of the rank that owns the places from ``start`` up to ``end``."""
        K, cochains, _ = piece.opened()
        corners = K.corner_vertex
        owned = (start <= corners) & (corners < end)
        ghosts = np.unique(corners[~owned])
        local = np.where(owned, corners - start, end - start + np.searchsorted(ghosts, corners))
        labels = np.concatenate([np.arange(start, end), ghosts])
        K = replace(K, corner_vertex=local, n_vertices=labels.size, labels=labels)
        return cls(K, cochains, int(end - start))


@dataclass(frozen=True, eq=False)
class Partition:
    """A surface with cochains, and who gets what of it.

    Attributes
    ----------
    complex : DeltaComplex
    cochains_by_edge : (n_edges, k) sparse int
    place : (n_vertices,) int
        Where each vertex stands in the new order.
    first : (n_ranks + 1,) int
        Rank r owns the places from ``first[r]`` up to ``first[r + 1]``.
    faces : (m,) int
        The faces, those of one rank after those of the other.
    first_face : (n_ranks + 1,) int
        The faces of rank r are ``faces[first_face[r] : first_face[r + 1]]``.
    """

    complex: DeltaComplex
    cochains_by_edge: csr_array
    place: Ints
    first: Ints
    faces: Ints
    first_face: Ints

    @classmethod
    def of(cls, K: DeltaComplex, cochains: csr_array, n_ranks: int) -> Partition:
        """Divide a surface and its cochains among ranks."""
        order, first = bisected(K, n_ranks)
        place = np.empty(K.n_vertices, dtype=np.int64)
        place[order] = np.arange(K.n_vertices)
        owner = np.searchsorted(first, place[K.corner_vertex].min(axis=1), side="right") - 1
        faces = np.argsort(owner, kind="stable")
        first_face = np.concatenate([[0], np.cumsum(np.bincount(owner, minlength=n_ranks))])
        return cls(K, cochains.T.tocsr(), place, first, faces, first_face)

    def piece(self, rank: int) -> Piece:
        """The faces of a rank, with the places of their corners."""
        K = self.complex
        faces = self.faces[self.first_face[rank] : self.first_face[rank + 1]]
        edges = np.unique(K.edge[faces])
        return Piece(
            lengths=K.lengths[faces],
            edge=K.edge[faces],
            sign=K.sign[faces],
            vertex=self.place[K.corner_vertex[faces]],
            distortion=np.zeros(faces.size) if K.distortion is None else K.distortion[faces],
            edges=edges,
            by_edge=self.cochains_by_edge[edges],
        )

    def owned(self, rank: int) -> tuple[int, int]:
        """The first of the places that a rank owns, and the first of the next rank."""
        return int(self.first[rank]), int(self.first[rank + 1])

    def share(self, rank: int) -> tuple[Piece, tuple[int, int]]:
        """The faces of a rank, and the places that it owns: what its part is made of."""
        return self.piece(rank), self.owned(rank)


def bisected(K: DeltaComplex, n_ranks: int) -> tuple[Ints, Ints]:
    """An order of the vertices in which ranges of equal size are domains with short boundaries.

    Returns
    -------
    order : (n_vertices,) int
    first : (n_ranks + 1,) int
        Where the range of each rank begins; sizes differ by one at most.
    """
    tail, head = half_edge_ends(K)
    graph = csr_array((np.ones(tail.size, dtype=np.int8), (tail, head)), shape=(K.n_vertices,) * 2)
    first = np.arange(n_ranks + 1) * K.n_vertices // n_ranks
    return _bisected(graph, np.arange(K.n_vertices), first), first


def _bisected(graph: csr_array, vertices: Ints, first: Ints) -> Ints:
    """The vertices of a graph, in order; ``first`` are the places where ranges begin."""
    if vertices.size == 0:
        return vertices
    order = reverse_cuthill_mckee(graph, symmetric_mode=True)
    n_ranks = first.size - 1
    if n_ranks == 1:
        return vertices[order]
    middle = n_ranks // 2
    cut = first[middle] - first[0]
    halves = [(order[:cut], first[: middle + 1]), (order[cut:], first[middle:])]
    return np.concatenate(
        [_bisected(graph[half][:, half], vertices[half], ends) for half, ends in halves]
    )
