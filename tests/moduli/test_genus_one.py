"""The j-invariant: known values, invariance, theta constants."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from support.modular_words import random_point, random_word

from igl_periods.moduli.genus_one import j_invariant
from igl_periods.moduli.theta import theta_constants
from igl_periods.siegel.half_space import siegel_transform
from igl_periods.surfaces import regular_map_period_matrix


def test_j_invariants():
    assert abs(j_invariant([[1j]]) - 1728) < 1e-9
    assert abs(j_invariant([[np.exp(2j * np.pi / 3)]])) < 1e-9
    # Bring's curve: Braden and Northover (2012).
    tau = regular_map_period_matrix("bring")[0, 1]
    assert abs(j_invariant([[tau]]) + 29**3 * 5 / 2**5) < 1e-6
    assert abs(j_invariant([[5 * tau]]) + 25 / 2) < 1e-6


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 30))
def test_j_is_invariant_and_a_function_of_the_theta_constants(seed, length):
    rng = np.random.default_rng(seed)
    Pi = random_point(1, rng)
    j = j_invariant(Pi)
    moved = siegel_transform(random_word(1, length, rng, 20), Pi)
    assert abs(j_invariant(moved) - j) < 1e-7 * max(1, abs(j))
    t = theta_constants(Pi).ravel()[:3] ** 8
    assert abs(32 * t.sum() ** 3 / t.prod() - j) < 1e-9 * max(1, abs(j))
