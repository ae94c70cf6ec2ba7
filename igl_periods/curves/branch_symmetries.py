r"""Möbius transformations that permute the branch points, and coordinates that show them.

A Möbius transformation is determined by the images of three points, so that the finite group of
those that map a set of n points to itself is found by trying n(n − 1)(n − 2) of them.  This is the
group of automorphisms of the hyperelliptic curve modulo its involution.  A rotation of order n has
two fixed points; where these are 0 and ∞ it is x ↦ ζx, and the form of the branch points is

.. math:: x^ε z^{ε'} G(x^n, z^n), \qquad ε, ε' \in \{0, 1\} .

References
----------
Bolza, "On binary sextics with linear transformations into themselves" (1887).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations
from typing import Any

import numpy as np

from igl_periods.arrays import Complexes

from .ball_roots import root
from .binary_forms import Point

# Points this close on the sphere count as the same; branch points that are closer are refused.
_SAME_POINT = 1e-7


@dataclass(frozen=True)
class Rotation:
    """A Möbius transformation that permutes points.

    Attributes
    ----------
    images : tuple of int
        The number of the image of each point.
    order : int
    """

    images: tuple[int, ...]
    order: int

    @property
    def n_fixed(self) -> int:
        """How many of the points stay."""
        return sum(i == k for k, i in enumerate(self.images))


def rotations(points: list[Point]) -> list[Rotation]:
    """All Möbius transformations but 1 that permute the points, of high order first.

    The search is in double precision: it finds candidates, which balls then confirm or exclude.

    Raises
    ------
    ValueError
        If two points coincide in double precision.
    """
    vectors = _unit_vectors(points)
    distances = _chordal(vectors, vectors) + 2.0 * np.eye(len(vectors))
    if distances.min() < 2.0 * _SAME_POINT:
        raise ValueError(
            f"two branch points are {distances.min():.1e} apart on the sphere: the curve is too "
            "close to a singular one"
        )
    source = np.linalg.inv(_frame(*vectors[:3]))
    found = []
    for triple in permutations(range(len(vectors)), 3):
        matrix = _frame(*vectors[list(triple)]) @ source
        images = _permutation(matrix, vectors)
        if images is not None and images != tuple(range(len(vectors))):
            found.append(Rotation(images, _order(images)))
    return sorted(found, key=lambda rotation: (-rotation.order, rotation.images))


def around_fixed_points(points: list[Point], rotation: Rotation) -> list[Point] | None:
    """The points in coordinates in which the fixed points of a rotation are 0 and ∞, in balls.

    None where balls cannot separate the fixed points.
    """
    target = [points[i] for i in rotation.images[:3]]
    (a, b), (c, d) = _product(_ball_frame(*target), _adjugate(_ball_frame(*points[:3])))
    discriminant = (d - a) ** 2 + 4 * b * c
    if discriminant.contains(0):
        return None
    difference = root(discriminant, 2)
    fixed = []
    for eigenvalue in ((a + d + difference) / 2, (a + d - difference) / 2):
        choices = [(b, eigenvalue - a), (eigenvalue - d, c)]
        fixed.append(max(choices, key=lambda v: float(sum(abs(x).lower() for x in v))))
    return [tuple(x * w - z * v for v, w in fixed) for x, z in points]


def _unit_vectors(points: list[Point]) -> Complexes:
    vectors = np.array([[complex(x), complex(z)] for x, z in points])
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


def _chordal(one: Complexes, two: Complexes) -> Any:
    return np.abs(one[:, None, 0] * two[:, 1] - one[:, None, 1] * two[:, 0])


def _frame(p: Complexes, q: Complexes, r: Complexes) -> Complexes:
    """The matrix that takes (1 : 0), (0 : 1), (1 : 1) to three points."""
    s = np.linalg.solve(np.stack([p, q], axis=1), r)
    return np.stack([p * s[0], q * s[1]], axis=1)


def _permutation(matrix: Complexes, vectors: Complexes) -> tuple[int, ...] | None:
    images = vectors @ matrix.T
    images /= np.linalg.norm(images, axis=1, keepdims=True)
    distances = _chordal(images, vectors)
    nearest = distances.argmin(axis=1)
    if distances.min(axis=1).max() > _SAME_POINT or len(set(nearest.tolist())) < len(vectors):
        return None
    return tuple(int(i) for i in nearest)


def _order(images: tuple[int, ...]) -> int:
    power, order = images, 1
    while power != tuple(range(len(images))):
        power, order = tuple(images[i] for i in power), order + 1
    return order


_BallMatrix = tuple[tuple[Any, Any], tuple[Any, Any]]


def _ball_frame(p: Point, q: Point, r: Point) -> _BallMatrix:
    """As :func:`_frame`, in balls and up to a factor."""
    s, t = r[0] * q[1] - r[1] * q[0], p[0] * r[1] - p[1] * r[0]
    return (p[0] * s, q[0] * t), (p[1] * s, q[1] * t)


def _adjugate(m: _BallMatrix) -> _BallMatrix:
    return (m[1][1], -m[0][1]), (-m[1][0], m[0][0])


def _product(m: _BallMatrix, n: _BallMatrix) -> _BallMatrix:
    (a, b), (c, d) = m
    (p, q), (r, s) = n
    return (a * p + b * r, a * q + b * s), (c * p + d * r, c * q + d * s)
