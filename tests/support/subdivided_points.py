"""Where points lie after the division of every face into four."""

import numpy as np


def locate(face, barycentric):
    """Where points of a complex lie after :func:`split`.

    Parameters
    ----------
    face : (n,) array-like of int
    barycentric : (n, 3) array-like
        Weights of the corners, adding up to 1.

    Returns
    -------
    face : (n,) int
    barycentric : (n, 3) float
        On the line between two children, either of them.
    """
    weights = np.asarray(barycentric, dtype=np.float64)
    child = np.where(weights.max(axis=1) > 0.5, np.argmax(weights, axis=1), 3)
    at_corner = 2.0 * weights - (np.arange(3) == child[:, None])
    located = np.where(child[:, None] < 3, at_corner, 1.0 - 2.0 * weights)
    return 4 * np.asarray(face, dtype=np.int64) + child, located
