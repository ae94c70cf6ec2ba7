r"""Intrinsic Delaunay flips that carry cochains along.

An edge is Delaunay iff the angles α and β opposite it satisfy α + β ≤ π, that is
cot α + cot β ≥ 0, that is ρ(e) ≥ 0.  If it is not, the two triangles at it, unfolded, form a
strictly convex quadrilateral, whose other diagonal is Delaunay.  Flipping ends with an intrinsic
Delaunay triangulation of the same surface on the same vertices (Bobenko, Springborn 2007), of the
least Dirichlet energy among all of these (Rippa 1990), hence of the sharpest certificate.

A closed cochain takes on the new diagonal the sum of its values on two sides of the quadrilateral.
So integer cochains, and with them the marking of the period matrix, pass exactly to the flipped
triangulation, whatever multi-edges and loops it gets.  The length of a diagonal follows from those
of the five edges around it, and its rounding goes on into all later ones: lengths are extended
numbers while edges are being flipped (of 64 bits or more where the machine has them).

Flips of edges that share no face commute.  Each round flips an independent set of bad edges at
once, chosen at random but always the same.

References
----------
Fisher, Springborn, Schröder, Bobenko, "An algorithm for the construction of intrinsic Delaunay
triangulations with applications to digital geometry processing" (2007).
Bobenko, Springborn, "A discrete Laplace–Beltrami operator for simplicial surfaces" (2007).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import ComplexError
from igl_periods.run_log import progress

from .delta_complex import DeltaComplex
from .diagonals import other_diagonal
from .flip_rounds import Flips, transport
from .gluings import next_corner
from .half_edges import forward_half_edges
from .triangles import cotangents, length_sensitivity, shapes

# Edges this close to cocircular are left alone: flipped by rounding, they would flip for ever.
_TOLERANCE = 1e-12
_EPS = float(np.finfo(np.float64).eps)
_ULPS = 8 * _EPS
# The rounding of extended numbers, in units of that of doubles.
_FINER = float(np.finfo(np.longdouble).eps) / _EPS
_MOST_ROUNDS = 100_000  # and as many as there are edges
_EDGES_AT_ONCE = 8_192


def intrinsic_delaunay(K: DeltaComplex, cochains: csr_array) -> tuple[DeltaComplex, csr_array]:
    """Flip edges until all are Delaunay: the complex, and the closed cochains carried to it.

    Parameters
    ----------
    K : DeltaComplex
        Closed and oriented.
    cochains : (k, n_edges) sparse int
        Closed.

    Returns
    -------
    K : DeltaComplex
        The same surface and vertices; ``K`` itself if every edge is Delaunay.
    cochains : (k, n_edges) sparse int
        The same cohomology classes.  Edges that are not flipped keep their index, direction and
        values; a flipped edge passes its index on to the new diagonal.

    Raises
    ------
    ComplexError
        If flipping does not end, which only rounding on extreme triangles could cause.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> K = ip.DeltaComplex.from_mesh(V, F)
    >>> L, cochains = ip.intrinsic_delaunay(K, ip.cohomology_basis(K))
    >>> L.n_faces == K.n_faces, cochains.shape == (2, L.n_edges)
    (True, True)
    """
    flipped, rounds = delaunay_flips(K)
    return flipped, transport(cochains, rounds)


def delaunay_flips(K: DeltaComplex) -> tuple[DeltaComplex, list[Flips]]:
    """The intrinsic Delaunay complex, and the rounds of flips that lead to it."""
    cot, half_edge = cotangents(K.lengths).ravel(), forward_half_edges(K)
    suspects = np.flatnonzero(_is_bad(cot[half_edge], cot[K.twin.ravel()[half_edge]]))
    if suspects.size == 0:
        return K, []
    mesh = _FlippableMesh.of(K, cot, half_edge)
    order = np.random.default_rng(0)
    rounds: list[Flips] = []
    while suspects.size:
        if len(rounds) == _MOST_ROUNDS + K.n_edges:
            raise ComplexError(
                f"Delaunay flips did not end in {len(rounds)} rounds: rounding decides about "
                "extreme triangles. Remesh them, or compute without flips (delaunay=False)."
            )
        progress("rounds of flips", len(rounds))
        chosen, waiting = mesh.independent(order.permutation(suspects))
        # Neighbours lie close together in memory when edges are taken in their order, and in
        # portions that the cache holds.
        chosen = _distinct(K.n_edges, chosen)
        portions = [
            mesh.flip(chosen[start : start + _EDGES_AT_ONCE])
            for start in range(0, chosen.size, _EDGES_AT_ONCE)
        ]
        rounds.append(Flips.union([flips for flips, _ in portions]))
        suspects = mesh.bad_edges(_distinct(K.n_edges, waiting, *(near for _, near in portions)))
    flipped = replace(
        K,
        lengths=mesh.length.astype(np.float64)[mesh.edge].reshape(-1, 3),
        twin=mesh.twin.reshape(-1, 3),
        edge=mesh.edge.reshape(-1, 3),
        sign=mesh.sign.reshape(-1, 3),
        corner_vertex=mesh.corner_vertex.reshape(-1, 3),
        distortion=mesh.distortion_when_rounded(),
        exact_lengths=None,
        cell=None,
        polygons=None,
    )
    return flipped, rounds


class _Quadrilaterals(NamedTuple):
    """The half-edges of two faces p A B and q B A: A B, B p, p A, and B A, A q, q B."""

    h: Ints
    bp: Ints
    pa: Ints
    t: Ints
    aq: Ints
    qb: Ints

    @classmethod
    def at(cls, h: Ints, twin: Ints) -> _Quadrilaterals:
        t = twin[h]
        return cls(h, next_corner(h), next_corner(h, 2), t, next_corner(t), next_corner(t, 2))


class _NewFaces(NamedTuple):
    """The faces p A q, above, and q B p, below, that flips will make."""

    edge: Ints
    old: _Quadrilaterals
    diagonal: Floats  # extended numbers
    ulps: Floats  # a bound of its relative error in units of 2⁻⁵⁰
    above: Floats  # cotangents
    below: Floats
    sensitivity_above: Floats
    sensitivity_below: Floats

    def at(self, chosen: NDArray[np.bool_]) -> _NewFaces:
        edge, old, *numbers = self
        old = _Quadrilaterals(*(side[chosen] for side in old))
        return _NewFaces(edge[chosen], old, *(array[chosen] for array in numbers))


@dataclass(eq=False)
class _FlippableMesh:
    """The arrays of a complex, flat by half-edge, while edges are being flipped."""

    length: Floats  # of each edge; extended numbers
    twin: Ints
    edge: Ints
    sign: NDArray[np.int8]
    corner_vertex: Ints
    cotangents: Floats
    half_edge: Ints  # of each edge, the half-edge that runs with it
    distortion: Floats  # of each face, as in the complex
    slot: Ints  # scratch: where a half-edge moves to; the identity between rounds
    owner: Ints  # scratch: which edge claims a face

    @classmethod
    def of(cls, K: DeltaComplex, cot: Floats, half_edge: Ints) -> _FlippableMesh:
        return cls(
            length=cast(Floats, K.lengths.ravel()[half_edge].astype(np.longdouble)),
            twin=K.twin.flatten(),
            edge=K.edge.flatten(),
            sign=K.sign.flatten(),
            corner_vertex=K.corner_vertex.flatten(),
            cotangents=cot,
            half_edge=half_edge,
            distortion=np.zeros(K.n_faces) if K.distortion is None else K.distortion.copy(),
            slot=np.arange(K.twin.size),
            owner=np.empty(K.n_faces, dtype=np.int64),
        )

    def bad_edges(self, edges: Ints) -> Ints:
        """Those of the edges that are not Delaunay."""
        h = self.half_edge[edges]
        t = self.twin[h]
        cot_here, cot_there = self.cotangents[h], self.cotangents[t]
        bad = _is_bad(cot_here, cot_there)
        # Angles that earlier flips have blurred decide nothing; or flips might never end.
        blur_here = self.distortion[h[bad] // 3] * (1.0 + np.abs(cot_here[bad]))
        blur_there = self.distortion[t[bad] // 3] * (1.0 + np.abs(cot_there[bad]))
        bad[bad] = cot_here[bad] + cot_there[bad] < -_EPS * (blur_here + blur_there)
        return edges[bad]

    def independent(self, edges: Ints) -> tuple[Ints, Ints]:
        """Split edges into some that share no face, and the rest."""
        h = self.half_edge[edges]
        faces = np.stack([h // 3, self.twin[h] // 3], axis=1)
        rank = np.arange(edges.size)
        # The last claim on a face holds, so the last edge always keeps both of its faces.
        self.owner[faces.ravel()] = np.repeat(rank, 2)
        free = (self.owner[faces] == rank[:, None]).all(axis=1)
        return edges[free], edges[~free]

    def flip(self, edges: Ints) -> tuple[Flips, Ints]:
        r"""Flip edges that share no face; also returns the edges around them.

        Seen from the half-edge h from A to B, with p opposite in its face and q opposite in the
        other face, the faces p A B and q B A become p A q and q B p::

                   p                        p
                 /   \                    / | \
               A —h—> B        →         A  |  B
                 \   /                    \ | /
                   q                        q
        """
        new = self._better(edges, _Quadrilaterals.at(self.half_edge[edges], self.twin))
        edges, (h, bp, pa, t, aq, qb) = new.edge, new.old
        here, there = h - h % 3, t - t % 3
        p, a, q, b = (self.corner_vertex[corner] for corner in (h, bp, t, aq))
        old = np.concatenate([aq, pa, bp, qb])
        moved = np.concatenate([here, here + 2, there, there + 2])
        around = self.edge[old]
        first, second, third, fourth = around.reshape(4, -1)
        flips = Flips(edges, first, -self.sign[aq], second, -self.sign[pa], third, fourth)

        self._move(old, moved)
        self._place_diagonal(edges, here + 1, there + 1, new.diagonal)
        # The sides of the new faces are A q, q p, p A and B p, p q, q B.
        for face, corners, cot in ((here, (p, a, q), new.above), (there, (q, b, p), new.below)):
            for s in range(3):
                self.corner_vertex[face + s] = corners[s]
                self.cotangents[face + s] = cot[:, s]
        self._distort(here // 3, there // 3, new)
        return flips, around

    def distortion_when_rounded(self) -> Floats:
        """The distortion of each face by the flips so far, and by rounding the lengths to double.

        That is by 2⁻⁵³, an eighth of the unit; lengths that did not change are not rounded.
        """
        rounded = self.length.astype(np.float64)
        half_edge = self.half_edge[rounded != self.length]
        changed = _distinct(self.owner.size, half_edge // 3, self.twin[half_edge] // 3)
        distortion = self.distortion.copy()
        lengths = rounded[self.edge.reshape(-1, 3)[changed]]
        distortion[changed] += 0.125 * length_sensitivity(lengths)
        return distortion

    def _distort(self, here: Ints, there: Ints, new: _NewFaces) -> None:
        """Both new faces inherit what was wrong with the old ones, and the rounded diagonal."""
        before = np.maximum(self.distortion[here], self.distortion[there])
        self.distortion[here] = before + new.ulps * new.sensitivity_above
        self.distortion[there] = before + new.ulps * new.sensitivity_below

    def _better(self, edges: Ints, old: _Quadrilaterals) -> _NewFaces:
        """What flips make of the edges that get better by them.

        Rounding can make a new triangle degenerate, or no better than the old one; then the edge
        stays as it is.
        """
        base, pb, pa, qa, qb = (
            self.length[edges],
            *(self.length[self.edge[side]] for side in (old.bp, old.pa, old.aq, old.qb)),
        )
        diagonal, error = other_diagonal(base, pa, pb, qa, qb)
        above, cot_above, sensitivity_above = shapes(np.stack([qa, diagonal, pa]).T)
        below, cot_below, sensitivity_below = shapes(np.stack([pb, diagonal, qb]).T)
        new = _NewFaces(
            edges,
            old,
            diagonal,
            (_FINER * error).astype(np.float64),
            *(array.astype(np.float64) for array in (cot_above, cot_below)),
            *(array.astype(np.float64) for array in (sensitivity_above, sensitivity_below)),
        )
        after = new.above[:, 1] + new.below[:, 1]
        good = above & below & (after > self.cotangents[old.h] + self.cotangents[old.t])
        return new if good.all() else new.at(good)

    def _move(self, old: Ints, new: Ints) -> None:
        """Move half-edges to new places, with all that belongs to them."""
        self.slot[old] = new
        twin = self.slot[self.twin[old]]
        self.slot[old] = old
        self.sign[new], self.edge[new] = self.sign[old], self.edge[old]
        self.twin[new] = twin
        self.twin[twin] = new
        forward = self.sign[new] > 0
        self.half_edge[self.edge[new[forward]]] = new[forward]

    def _place_diagonal(self, edges: Ints, h: Ints, t: Ints, length: Floats) -> None:
        self.length[edges] = length
        self.edge[h] = self.edge[t] = edges
        self.sign[h], self.sign[t] = 1, -1
        self.twin[h], self.twin[t] = t, h
        self.half_edge[edges] = h


def _distinct(n: int, *indices: Ints) -> Ints:
    """The indices below n that occur, ascending."""
    occurs = np.zeros(n, dtype=bool)
    for some in indices:
        occurs[some] = True
    return np.flatnonzero(occurs)


def _is_bad(cot_here: Floats, cot_there: Floats) -> NDArray[np.bool_]:
    """Whether an edge with these opposite angles is not Delaunay, beyond rounding.

    An edge with the same face on both sides never is: its two angles are of one triangle.
    """
    total = cot_here + cot_there
    bad = total < -_TOLERANCE
    bad[bad] = total[bad] < -cocircularity_allowance(np.abs(cot_here[bad]) + np.abs(cot_there[bad]))
    return bad


def cocircularity_allowance(size: Floats) -> Floats:
    """How far cot α + cot β may be from 0 by rounding, where four vertices lie on one circle.

    Parameters
    ----------
    size : array of float
        The sum of the absolute values of both cotangents.
    """
    return _TOLERANCE + _ULPS * size
