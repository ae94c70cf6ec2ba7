"""The steps of the reduction move points as their transformations do."""

import numpy as np
import pytest
from support.modular_words import random_point, random_word

from igl_periods.siegel.half_space import siegel_transform
from igl_periods.siegel.reduction_steps import inversion_step, lattice_step


@pytest.mark.parametrize("g", [3, 20, 45])
def test_steps_move_points_as_their_transformations_do(g):
    rng = np.random.default_rng(g)
    Pi = siegel_transform(random_word(g, 100, rng), random_point(g, rng))
    for step in (lattice_step(Pi), inversion_step(Pi, g), inversion_step(Pi, 1)):
        assert not step.idle
        assert np.abs(step.point - siegel_transform(step.gamma, Pi)).max() < 1e-9
    # Quasi-inversions raise det Y, and lattice steps keep it.
    before, lattice, inverted = (
        np.linalg.slogdet(point.imag)[1]
        for point in (Pi, lattice_step(Pi).point, inversion_step(Pi, g).point)
    )
    assert abs(lattice - before) < 1e-9
    assert inverted > before + 1e-6
