"""What a deformation says of itself."""

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import DeltaComplex

K = DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.02, 1))


def test_certified_distances_hold():
    """The exact matrix of the surface, to 1e-9, is within the certified distance of the target."""
    target = ip.siegel_exponential(ip.period_matrix(K).matrix, [[0.1 + 0.2j]])
    found = ip.lengths_with(K, target, keep_marking=True)
    exact = ip.period_matrix(found.complex, degree=10)
    assert exact.bound < 1e-6
    assert ip.siegel_distance(exact.matrix, target) < found.certified_distance
    sharper = ip.lengths_with(K, target, keep_marking=True, degree=6)
    assert sharper.certified_distance < 1e-2 * found.certified_distance


def test_what_is_reached_is_kept_together():
    target = ip.siegel_exponential(ip.period_matrix(K).matrix, [[0.1 + 0.2j]])
    found = ip.deform_to(K, None, target)
    assert found.reached and np.array_equal(found.vertices, found.complex.positions)
    assert found.distance == ip.siegel_distance(found.period_matrix.matrix, found.target)
    assert np.array_equal(found.gamma, np.eye(2))
    assert repr(found).startswith("Deformation: target reached, Siegel distance ")


def test_what_is_not_reached_says_why():
    with pytest.warns(ip.DeformationWarning, match="the target is not reached: stopped after 1 st"):
        found = ip.lengths_with(K, [[0.01j]], max_steps=1, keep_marking=True)
    assert not found.reached and found.verdict
