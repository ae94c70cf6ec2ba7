"""Sets of points on the sphere up to Möbius transformations."""

from itertools import permutations

import numpy as np


def moebius_distance(points: np.ndarray, targets: np.ndarray) -> float:
    """Largest chordal distance of the targets from the image of the points, at best.

    Both are six points of the sphere, ∞ allowed; three of the points are taken to any three of
    the targets, and each of the others is compared with its nearest target.
    """
    best = np.inf
    ends = np.array([_homogeneous(z) for z in targets])
    given = np.array([_homogeneous(z) for z in points])
    coordinates = given @ np.linalg.inv(_frame(given[:3]))
    for three in permutations(range(6), 3):
        images = coordinates @ _frame(ends[list(three)])
        images /= np.linalg.norm(images, axis=1, keepdims=True)
        chord = np.abs(images[:, [0]] * ends[:, 1] - images[:, [1]] * ends[:, 0])
        best = min(best, max(chord.min(axis=0).max(), chord.min(axis=1).max()))
    return float(best)


def _homogeneous(z: complex) -> np.ndarray:
    point = np.array([1.0, 0.0]) if np.isinf(z) else np.array([z, 1.0])
    return point / np.linalg.norm(point)


def _frame(three: np.ndarray) -> np.ndarray:
    """Rows u, v spanning C² with u, v, u + v proportional to the three points."""
    s, t = np.linalg.solve(three[:2].T, three[2])
    return np.array([s * three[0], t * three[1]])
