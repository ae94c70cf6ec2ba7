"""Hyperelliptic matrices of genus 3 near a given one."""

import numpy as np
import pytest
from support.modular_words import random_word

import igl_periods as ip
from igl_periods.surfaces import lawson_period_matrix

LAWSON = lawson_period_matrix(3, 1)  # y² = x⁸ − 1
PERTURBATION = 0.01 * np.array([[1.0, 0.3j, 0.2], [0.3j, -0.5, 0.4], [0.2, 0.4, 0.7j]])


def test_one_even_constant_vanishes():
    point = ip.hyperelliptic_point(LAWSON + PERTURBATION)
    assert not ip.is_hyperelliptic(LAWSON + PERTURBATION)
    assert ip.is_hyperelliptic(point)
    assert 0 < ip.siegel_distance(point, LAWSON + PERTURBATION) < 0.05


def test_hyperelliptic_matrices_stay_where_they_are():
    assert ip.siegel_distance(ip.hyperelliptic_point(LAWSON), LAWSON) < 1e-12


def test_it_does_not_depend_on_the_marking():
    Pi = LAWSON + PERTURBATION
    moved = ip.siegel_transform(random_word(3, 8, np.random.default_rng(2), 20), Pi)
    here = ip.siegel_distance(ip.hyperelliptic_point(Pi), Pi)
    assert ip.siegel_distance(ip.hyperelliptic_point(moved), moved) == pytest.approx(here, rel=1e-6)


def test_only_genus_three():
    with pytest.raises(ValueError, match="genus 3"):
        ip.hyperelliptic_point(1j * np.eye(2))
