"""Cochains: integration along a tree."""

import numpy as np

from igl_periods.complexes.cochains import primitive


def test_integration_along_a_tree():
    corner = np.array([[0, 1, 2], [2, 1, 3], [3, 1, 4]])
    f = np.array([0, 5, -2, 7, 100])
    sides = f[np.roll(corner, 1, axis=1)] - f[np.roll(corner, -1, axis=1)]
    assert np.array_equal(primitive(corner, sides), f)
