r"""A triangulation in balls, and the moves that keep the surface and carry cochains along.

The surface is glued from triangles with lengths in balls; the two halves of an edge share one
ball.  Two moves change the triangulation and not the surface:

* a *flip* replaces an edge by the other diagonal of the two triangles at it, unfolded, if these
  form a strictly convex quadrilateral, which is decided in balls;
* an *insertion* puts a vertex of angle 2π at a point with rational barycentric coordinates.

Which moves are made is decided in floating point, and costs no truth.  A closed integer cochain
takes on a new edge the value that its sum around a triangle demands: the marking passes exactly.

Half-edges are those of :class:`~igl_periods.DeltaComplex`: ``h = 3 f + s`` is side s of face f,
from corner s + 1 to corner s + 2.
"""

from __future__ import annotations

from dataclasses import dataclass

import flint
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.complexes import DeltaComplex

from .planes import foot_and_height

Arb = flint.arb


@dataclass(eq=False)
class Triangulation:
    """Triangles with lengths in balls, and integer cochains on their edges.

    Attributes
    ----------
    twin, edge, sign : list of int
        Of each half-edge, as in a complex.
    corner_vertex : list of int
        The vertex at each corner.
    lengths : list of arb
        Of each edge.
    cochains : list of tuple of int
        The values of all cochains on each edge.
    n_vertices : int
    """

    twin: list[int]
    edge: list[int]
    sign: list[int]
    corner_vertex: list[int]
    lengths: list[Arb]
    cochains: list[tuple[int, ...]]
    n_vertices: int

    @classmethod
    def of(cls, K: DeltaComplex, lengths: list[Arb], cochains: csr_array) -> Triangulation:
        """A complex with these lengths and cochains, (k, n_edges) sparse int."""
        return cls(
            twin=K.twin.ravel().tolist(),
            edge=K.edge.ravel().tolist(),
            sign=K.sign.ravel().tolist(),
            corner_vertex=K.corner_vertex.ravel().tolist(),
            lengths=list(lengths),
            cochains=[tuple(row) for row in cochains.T.toarray().tolist()],
            n_vertices=K.n_vertices,
        )

    @property
    def n_faces(self) -> int:
        """Number of triangles."""
        return len(self.twin) // 3

    @property
    def n_cochains(self) -> int:
        """Number of cochains."""
        return len(self.cochains[0])

    def length(self, h: int) -> Arb:
        """The length of a half-edge."""
        return self.lengths[self.edge[h]]

    def value(self, h: int) -> tuple[int, ...]:
        """The values of the cochains along a half-edge."""
        values = self.cochains[self.edge[h]]
        return values if self.sign[h] > 0 else tuple(-x for x in values)

    def lengths_in_floats(self) -> NDArray[np.float64]:
        """Side lengths in floating point; (m, 3)."""
        by_edge = np.array([float(length.mid()) for length in self.lengths])
        return by_edge[np.array(self.edge).reshape(-1, 3)]

    def flip(self, h: int) -> bool:
        r"""Flip the edge of a half-edge, and say whether that was possible.

        Seen from h, which runs from A to B, with p opposite in its face and q opposite in the
        other one, the faces p A B and q B A become p A q and q B p::

                   p                        p
                 /   \                    / | \
               A —h—> B        →         A  |  B
                 \   /                    \ | /
                   q                        q
        """
        t = self.twin[h]
        if h // 3 == t // 3:
            return False
        bp, pa, aq, qb = (
            following(h),
            following(following(h)),
            following(t),
            following(following(t)),
        )
        diagonal = self._diagonal(h, pa, bp, aq, qb)
        if diagonal is None:
            return False
        value = tuple(-x - y for x, y in zip(self.value(aq), self.value(pa)))
        p, a, q, b = (self.corner_vertex[corner] for corner in (h, bp, t, aq))
        edge, here, there = self.edge[h], h - h % 3, t - t % 3
        self._move([aq, pa, bp, qb], [here, here + 2, there, there + 2])
        self._glue(here + 1, there + 1, edge)
        self.corner_vertex[here : here + 3] = p, a, q
        self.corner_vertex[there : there + 3] = q, b, p
        self.lengths[edge], self.cochains[edge] = diagonal, value
        return True

    def insert(self, f: int, weights: tuple[flint.fmpq, flint.fmpq, flint.fmpq]) -> None:
        """Put a vertex into face f, at the point with these barycentric coordinates, all positive.

        Face f becomes m 1 2, and two more faces m 2 0 and m 0 1 are appended.
        """
        sides = [3 * f + s for s in range(3)]
        values = [self.value(h) for h in sides]
        distances = self._distances(f, weights)
        corners, m = self.corner_vertex[3 * f : 3 * f + 3], self.n_vertices
        n = 3 * self.n_faces
        new = [3 * f, n, n + 3]
        first_edge = len(self.lengths)
        for column in (self.twin, self.edge, self.sign, self.corner_vertex):
            column.extend([0] * 6)
        self._move(sides, new)
        zero = tuple(0 for _ in values[0])
        # Along m → corner: 0 at corner 0, and what lies between at the others.
        self.cochains += [zero, values[2], tuple(-x for x in values[1])]
        self.lengths += distances
        for i, here in enumerate(new):
            # Side 0 of part i is side i, from corner i + 1 to i + 2; side 2 leads from m to i + 1.
            self.corner_vertex[here : here + 3] = m, corners[i - 2], corners[i - 1]
            self._glue(here + 2, new[i - 1] + 1, first_edge + (i + 1) % 3)
        self.n_vertices += 1

    def _diagonal(self, h: int, pa: int, bp: int, aq: int, qb: int) -> Arb | None:
        """Distance of p and q in the plane of both faces, or None if they do not see each other."""
        base = self.length(h)
        x_p, y_p = foot_and_height(base, self.length(pa), self.length(bp))
        x_q, y_q = foot_and_height(base, self.length(aq), self.length(qb))
        crossing, height = x_p * y_q + x_q * y_p, y_p + y_q
        if not (crossing > 0 and crossing < base * height):
            return None
        across = x_p - x_q
        return (across * across + height * height).sqrt()

    def _distances(self, f: int, weights: tuple[flint.fmpq, flint.fmpq, flint.fmpq]) -> list[Arb]:
        """Distances of a point of a face from its corners."""
        squares = [side * side for side in map(self.length, range(3 * f, 3 * f + 3))]
        u, v, w = (flint.arb(x) for x in weights)
        moment = v * w * squares[0] + w * u * squares[1] + u * v * squares[2]
        return [
            (v * squares[2] + w * squares[1] - moment).sqrt(),
            (u * squares[2] + w * squares[0] - moment).sqrt(),
            (u * squares[1] + v * squares[0] - moment).sqrt(),
        ]

    def _move(self, old: list[int], new: list[int]) -> None:
        """Move half-edges to new places, with all that belongs to them."""
        place = dict(zip(old, new))
        rows = [(self.twin[h], self.edge[h], self.sign[h]) for h in old]
        for h, (twin, edge, sign) in zip(new, rows):
            twin = place.get(twin, twin)
            self.twin[h], self.edge[h], self.sign[h] = twin, edge, sign
            self.twin[twin] = h

    def _glue(self, forward: int, backward: int, edge: int) -> None:
        self.twin[forward], self.twin[backward] = backward, forward
        self.edge[forward] = self.edge[backward] = edge
        self.sign[forward], self.sign[backward] = 1, -1


def following(h: int) -> int:
    """The half-edge after h around its face."""
    return h - 2 if h % 3 == 2 else h + 1
