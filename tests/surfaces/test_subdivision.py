"""Subdivision keeps the surface."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes.weights import cone_angles
from igl_periods.surfaces import subdivide


def test_subdivision_keeps_the_surface():
    twin = np.array([[3, 4, 5], [0, 1, 2]])
    lengths = np.array([[2.0, 2.5, 1.2], [2.0, 2.5, 1.2]])
    whole = ip.DeltaComplex.from_gluing(lengths, twin)
    parts = ip.DeltaComplex.from_gluing(*subdivide(lengths, twin, 5))
    assert parts.n_vertices == 25
    assert cone_angles(parts) == pytest.approx(2 * np.pi)
    tau = [ip.period_matrix(K).reduced().matrix for K in (whole, parts)]
    assert np.abs(tau[0] - tau[1]).max() < 1e-12
