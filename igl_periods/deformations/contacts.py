r"""How near the parts of a surface in space are to each other: distances of its triangles.

The distance of two triangles is that of a corner of one from the other, or of two sides that face
each other across both their interiors.  With the closest points :math:`p = \sum_i b_i x_i` and
:math:`q = \sum_j c_j y_j` it moves by :math:`\langle \tfrac{p - q}{|p - q|},\, \sum_i b_i\, dx_i -
\sum_j c_j\, dy_j \rangle`, the weights being stationary.  The *contact energy*

.. math:: \sum \log^2 \frac{d}{\delta} , \qquad d < \delta ,

over pairs of triangles without a common vertex is 0 where nothing is nearer than δ, differentiable
there, and infinite at a contact.

References
----------
Ericson, "Real-time collision detection" (2005), section 5.1.
Li and others, "Incremental potential contact" (2020), for barriers of distances.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Bools, Floats, Ints

from .crossings import near_pairs

_SIDES = ((0, 1), (1, 2), (2, 0))
# Sides that are parallel to this have their closest points at a corner too.
_PARALLEL = 1e-12


def contact_energy(V: Floats, F: Ints, reach: float) -> tuple[float, Floats]:
    """The contact energy with δ = ``reach``, and its gradient (n, 3).

    Parameters
    ----------
    V, F : (n, 3) float, (m, 3) int
    reach : float
    """
    energy, gradient = 0.0, np.zeros_like(V)
    for i, j in near_pairs(V, F, reach):
        distance, b, c = triangle_distances(V[F[i]], V[F[j]])
        near = distance < reach
        distance = distance[near]
        ends = np.concatenate([F[i], F[j]], axis=1)[near]
        weights = np.concatenate([b, -c], axis=1)[near]
        between = np.einsum("kc,kci->ki", weights, V[ends])
        logarithm = np.log(distance / reach)
        energy += float(logarithm @ logarithm)
        force = (2.0 * logarithm / distance**2)[:, None] * between
        for axis in range(3):
            shares = weights * force[:, axis, None]
            gradient[:, axis] += np.bincount(ends.ravel(), shares.ravel(), len(V))
    return energy, gradient


def triangle_distances(one: Floats, other: Floats) -> tuple[Floats, Floats, Floats]:
    """Distances of triangles (k, 3, 3) that do not meet, and the closest points.

    Returns
    -------
    distance : (k,) float
    b, c : (k, 3) float
        The weights of the corners of either triangle in its closest point.
    """
    k = len(one)
    found = [np.full(k, np.inf), np.zeros((k, 3)), np.zeros((k, 3))]

    def take(b: Floats, c: Floats, valid: Bools) -> None:
        between = np.einsum("kc,kci->ki", b, one) - np.einsum("kc,kci->ki", c, other)
        distance = np.where(valid, np.linalg.norm(between, axis=1), np.inf)
        nearer = distance < found[0]
        for best, candidate in zip(found, (distance, b, c)):
            best[nearer] = candidate[nearer]

    for s in range(3):
        corner = np.broadcast_to(np.eye(3)[s], (k, 3))
        for weights, valid in _nearest_in(other, one[:, s]):
            take(corner, weights, valid)
        for weights, valid in _nearest_in(one, other[:, s]):
            take(weights, corner, valid)
        for side in _SIDES:
            b, c, valid = _facing(one, _SIDES[s], other, side)
            take(b, c, valid)
    return found[0], found[1], found[2]


def _nearest_in(triangle: Floats, point: Floats) -> list[tuple[Floats, Bools]]:
    """Candidates for the nearest points: the foot of the height, where inside, and on the sides."""
    a, b, c = triangle.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    square = np.einsum("ki,ki->k", normal, normal)
    first = np.einsum("ki,ki->k", np.cross(b - point, c - point), normal) / square
    second = np.einsum("ki,ki->k", np.cross(c - point, a - point), normal) / square
    foot = np.stack([first, second, 1.0 - first - second], axis=1)
    candidates: list[tuple[Floats, Bools]] = [(foot, np.asarray((foot >= 0.0).all(axis=1)))]
    for i, j in _SIDES:
        u = triangle[:, j] - triangle[:, i]
        along = np.einsum("ki,ki->k", point - triangle[:, i], u) / np.einsum("ki,ki->k", u, u)
        weights = _on_side((i, j), np.clip(along, 0.0, 1.0))
        candidates.append((weights, np.ones(len(point), dtype=bool)))
    return candidates


def _facing(
    one: Floats, side: tuple[int, int], other: Floats, other_side: tuple[int, int]
) -> tuple[Floats, Floats, Bools]:
    """The closest points of two lines, and whether they are within the sides."""
    u, v = one[:, side[1]] - one[:, side[0]], other[:, other_side[1]] - other[:, other_side[0]]
    w = one[:, side[0]] - other[:, other_side[0]]
    pairs = ((u, u), (u, v), (v, v), (u, w), (v, w))
    uu, uv, vv, uw, vw = (np.einsum("ki,ki->k", x, y) for x, y in pairs)
    determinant = uu * vv - uv * uv
    apart = determinant > _PARALLEL * uu * vv
    determinant = np.where(apart, determinant, 1.0)
    s, t = (uv * vw - vv * uw) / determinant, (uu * vw - uv * uw) / determinant
    valid = apart & (s > 0.0) & (s < 1.0) & (t > 0.0) & (t < 1.0)
    return _on_side(side, s), _on_side(other_side, t), valid


def _on_side(side: tuple[int, int], along: Floats) -> Floats:
    weights = np.zeros((len(along), 3))
    weights[:, side[0]], weights[:, side[1]] = 1.0 - along, along
    return weights
