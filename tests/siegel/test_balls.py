"""Balls around period matrices hold the exact ones."""

from itertools import product

import numpy as np
from support.modular_words import random_point

import igl_periods as ip
from igl_periods.moduli.equivalence import symplectic_isomorphisms
from igl_periods.siegel.balls import to_flint
from igl_periods.siegel.half_space import siegel_transform
from igl_periods.surfaces import flat_torus, square_tiled_period_matrix, square_tiled_surface


def test_balls_of_arrays_are_points():
    Pi = random_point(3, np.random.default_rng(0))
    Pi = 0.5 * (Pi + Pi.T)
    balls = to_flint(Pi)
    assert all(complex(balls[i, j]) == Pi[i, j] for i in range(3) for j in range(3))
    assert all(balls[i, j].rad() == 0 for i in range(3) for j in range(3))


def test_balls_of_a_mesh_hold_the_exact_matrix():
    tau = 0.3 + 0.9j
    pm = ip.period_matrix(flat_torus(tau, 3))
    gamma = symplectic_isomorphisms([[tau]], pm.matrix, 1e-6)[0]
    exact = siegel_transform(gamma, [[tau]])[0, 0]
    assert to_flint(pm)[0, 0].contains(exact)
    pm = ip.period_matrix(square_tiled_surface("omega_2", 4))
    (gamma, *_) = symplectic_isomorphisms(square_tiled_period_matrix("omega_2"), pm.matrix, 1e-3)
    exact = siegel_transform(gamma, square_tiled_period_matrix("omega_2"))
    balls = to_flint(pm)
    for i, j in product(range(2), repeat=2):
        assert balls[i, j].contains(exact[i, j])
        assert float(balls[i, j].real.rad()) >= pm.entry_bounds[i, j]
