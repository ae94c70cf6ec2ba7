r"""How the lengths after flips, and divisions of faces, depend on the lengths before.

Four points p, q, A, B of the plane have one affine dependency, :math:`\sum_i a_i x_i = 0` with
:math:`\sum_i a_i = 0`, and their six distances move such that

.. math:: \sum_{i<j} a_i a_j\, l_{ij}\, dl_{ij} = 0

(the products :math:`a_i a_j` are the self-stress of the complete graph).  Where the diagonal pq
takes the place of the edge AB of a strictly convex quadrilateral, :math:`a_p = |ABq|`,
:math:`a_q = |ABp|`, :math:`a_A = -|Bpq|` and :math:`a_B = -|Apq|`, areas of triangles.  So the new
length is a smooth function of the five old ones, of degree 1, with the derivatives

.. math:: \frac{\partial l_{pq}}{\partial l_{pA}} = \frac{|Bpq|}{|ABp|} \frac{l_{pA}}{l_{pq}},
          \qquad
          \frac{\partial l_{pq}}{\partial l_{AB}} = -\frac{|Bpq|\,|Apq|}{|ABp|\,|ABq|}
          \frac{l_{AB}}{l_{pq}} .

The three edges from the barycentre of a face to its corners are two thirds of its medians,
:math:`9\, d_a^2 = 2 b^2 + 2 c^2 - a^2`.  That the barycentre goes on to be one is a choice of how
points of the surface move, on which nothing depends that belongs to the metric.

Flips of one round share no face, so no flipped edge is a side of another quadrilateral: a round is
one sparse step.  Forward, derivatives of lengths go through the rounds in their order; backward,
gradients go through their transposes in the opposite order.

**Kinks.**  Which edges are flipped is constant near lengths at which no quadrilateral is
cocircular.  Where one is, two triangulations are Delaunay, and give the same energies: at every
u at the vertices those of the two pairs of triangles differ by a multiple of
:math:`\rho(e)\, (\sum_i a_i u_i)^2`.  So energies are continuous there, and their derivatives jump
by :math:`\partial\rho(e)\, (\sum_i a_i u_i)^2`, which is small of fourth order in the size of the
triangles, where u is smooth.  What is computed is the derivative of the triangulation at hand.

References
----------
Bobenko, Springborn, "A discrete Laplace–Beltrami operator for simplicial surfaces" (2007).
Connelly, Guest, "Frameworks, tensegrities, and symmetry" (2022), for self-stresses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.display import arrays_repr

from .barycentre_insertion import Barycentres, barycentre_distances
from .delta_complex import DeltaComplex
from .flip_rounds import Flips
from .moved_lengths import edge_lengths
from .triangles import apexes, double_areas


@dataclass(frozen=True, eq=False)
class FlipDerivative:
    """The derivative of one round of flips, or of one round of barycentres.

    Attributes
    ----------
    edge : (k,) int
        The edges that are flipped, or the new ones.
    sides : (k, 5) or (k, 3) int
        Edges on whose lengths theirs depend: the flipped edge itself, then the four sides of its
        quadrilateral; or the sides of the face.
    partial : (k, 5) or (k, 3) float
        The derivatives.
    n_edges : int
        How many edges there are afterwards.
    """

    edge: Ints
    sides: Ints
    partial: Floats
    n_edges: int

    __repr__ = arrays_repr


def flip_derivatives(K: DeltaComplex, moves: Sequence[Flips | Barycentres]) -> list[FlipDerivative]:
    """The derivatives of all rounds, at the lengths of the complex before the first one."""
    lengths = edge_lengths(K)
    derivatives = []
    for move in moves:
        if isinstance(move, Flips):
            edge = move.edge
            sides = np.stack([edge, move.second, move.third, move.first, move.fourth], axis=1)
            lengths[edge], partial = _diagonals(lengths[sides])
        else:
            edge, sides = move.edge, np.repeat(move.sides, 3, axis=0)
            medians, partial = _medians(lengths[move.sides])
            lengths = np.concatenate([lengths, medians])
        derivatives.append(FlipDerivative(edge, sides, partial, lengths.size))
    return derivatives


def push_forward(rounds: list[FlipDerivative], by_length: Floats) -> Floats:
    """Derivatives of the lengths after all rounds, from those before; (…, n_edges)."""
    moved = by_length.copy()
    for step in rounds:
        moved = _resized(moved, step.n_edges)
        moved[..., step.edge] = np.sum(step.partial * moved[..., step.sides], axis=-1)
    return moved


def pull_back(rounds: list[FlipDerivative], gradient: Floats, n_edges: int) -> Floats:
    """The gradient by the n_edges lengths before, from that by the lengths after; (…, n_edges)."""
    pulled = gradient.copy()
    for step in reversed(rounds):
        for row in pulled.reshape(-1, pulled.shape[-1]):
            share = row[step.edge, None] * step.partial
            row[step.edge] = 0.0
            # A side may be met twice, by two quadrilaterals or by one.
            np.add.at(row, step.sides, share)
    return pulled[..., :n_edges]


def _resized(moved: Floats, n_edges: int) -> Floats:
    """With room for new edges."""
    missing = n_edges - moved.shape[-1]
    if missing == 0:
        return moved
    return np.concatenate([moved, np.zeros((*moved.shape[:-1], missing))], axis=-1)


def _medians(lengths: Floats) -> tuple[Floats, Floats]:
    """Distances of the barycentres from the corners of triangles (r, 3), and their derivatives.

    Returns
    -------
    distance : (3 r,) float
    partial : (3 r, 3) float
    """
    distance = barycentre_distances(lengths)
    factors = np.full((3, 3), 2.0) - 3.0 * np.eye(3)
    partial = factors * lengths[:, None, :] / (9.0 * distance[:, :, None])
    return distance.ravel(), partial.reshape(-1, 3)


def _diagonals(lengths: Floats) -> tuple[Floats, Floats]:
    """The other diagonals of quadrilaterals, and their derivatives.

    Parameters
    ----------
    lengths : (k, 5) float
        AB, pA, Bp, Aq, qB.

    Returns
    -------
    diagonal : (k,) float
    partial : (k, 5) float
    """
    ab, pa, bp, aq, qb = lengths.T
    above, below = np.stack([bp, pa, ab], axis=1), np.stack([qb, aq, ab], axis=1)
    (foot_p, height_p), (foot_q, height_q) = apexes(above), apexes(below)
    pq = np.hypot((foot_p - foot_q) * ab, height_p + height_q)
    abp, abq = ab * height_p, ab * height_q
    apq, bpq = (double_areas(np.stack([pq, *two], axis=1)) for two in ((pa, aq), (bp, qb)))
    to_a, to_b = bpq / pq, apq / pq
    sides = [to_a * pa / abp, to_b * bp / abp, to_a * aq / abq, to_b * qb / abq]
    return pq, np.stack([-to_a * apq * ab / (abp * abq), *sides], axis=1)
