"""The marking in which one matrix is nearest to another."""

import numpy as np
import pytest
from support.modular_words import random_point, random_word

import igl_periods as ip
from igl_periods.surfaces import square_tiled_period_matrix


@pytest.mark.parametrize("g", [1, 2, 3])
def test_the_same_surface_in_another_marking(g):
    rng = np.random.default_rng(g)
    Pi = random_point(g, rng)
    there = ip.siegel_transform(random_word(g, 12, rng, 50), Pi)
    found = ip.nearest_marking(there, Pi)
    assert found.proved and found.distance < 1e-9
    assert np.allclose(ip.siegel_transform(found.gamma, there), Pi, atol=1e-8 * np.abs(Pi).max())


def test_a_surface_close_by():
    """Where one is found within the tolerance, none is nearer: all of a ball were enumerated."""
    Pi = square_tiled_period_matrix("omega_1")
    near = Pi + 0.02 * np.array([[1.0, 0.3j], [0.3j, -0.5]])
    moved = ip.siegel_transform(random_word(2, 12, np.random.default_rng(0), 50), near)
    found = ip.nearest_marking(moved, Pi)
    assert found.proved
    assert found.distance == pytest.approx(ip.moduli_distance(moved, Pi, 0.3), abs=1e-9)


def test_far_surfaces_are_searched():
    """The search does not depend on the marking in which it starts."""
    far, Pi = square_tiled_period_matrix("omega_3"), 1j * np.diag([3.0, 2.0]) + 0.1
    distances = []
    for seed in range(4):
        word = random_word(2, 10, np.random.default_rng(seed), 50)
        found = ip.nearest_marking(ip.siegel_transform(word, far), Pi)
        assert not found.proved
        distances.append(found.distance)
    assert np.ptp(distances) < 1e-8


def test_bad_input():
    with pytest.raises(ValueError, match="different genus"):
        ip.nearest_marking([[1j]], 1j * np.eye(2))
    assert ip.nearest_marking(np.zeros((0, 0)), np.zeros((0, 0))).distance == 0.0
