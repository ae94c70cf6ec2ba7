"""What keeps a surface away from itself."""

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

from igl_periods.complexes import DeltaComplex
from igl_periods.deformations.repulsion import Repulsion

V, F = noisy_torus(12, 9, 0.1, 0)
ENERGY = Repulsion.of(DeltaComplex.from_mesh(V, F))
RNG = np.random.default_rng(0)


def test_the_gradient_is_the_limit_of_differences():
    moved = V + 0.02 * RNG.normal(size=V.shape)
    dV, h = RNG.normal(size=V.shape), 1e-6
    difference = (ENERGY(moved + h * dV)[0] - ENERGY(moved - h * dV)[0]) / (2 * h)
    assert np.sum(ENERGY(moved)[1] * dV) == pytest.approx(difference, rel=1e-6)


def test_similarities_change_nothing():
    turn = np.linalg.qr(RNG.normal(size=(3, 3)))[0]
    assert ENERGY(3.0 * V @ turn + 1.0)[0] == pytest.approx(ENERGY(V)[0], rel=1e-9)
    gradient = ENERGY(V)[1]
    assert np.abs(gradient.sum(axis=0)).max() < 1e-9 * np.abs(gradient).max()


def test_it_grows_as_parts_meet():
    """A tube that is pinched from both sides."""
    energies = [ENERGY(V * [1.0, 1.0, t])[0] for t in (1.0, 0.5, 0.25, 0.1)]
    assert (np.diff(energies) > 0.5).all()
