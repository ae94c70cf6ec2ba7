"""Geodesics of the half-space."""

from itertools import pairwise

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.errors import NotASiegelPointError
from igl_periods.siegel import orthonormal_weights


def random_point(g, rng):
    X, M = rng.normal(size=(2, g, g))
    return X + X.T + 1j * (M @ M.T + 0.3 * np.eye(g))


@pytest.mark.parametrize("g", [1, 2, 3, 5])
def test_logarithm_and_exponential_are_inverse(g):
    rng = np.random.default_rng(g)
    one, two = random_point(g, rng), random_point(g, rng)
    velocity = ip.siegel_logarithm(one, two)
    assert np.abs(ip.siegel_exponential(one, velocity) - two).max() < 1e-11 * np.abs(two).max()


@pytest.mark.parametrize("g", [1, 2, 4])
def test_the_velocity_is_as_long_as_the_distance(g):
    rng = np.random.default_rng(g)
    one, two = random_point(g, rng), random_point(g, rng)
    coordinates = np.einsum(
        "ckl,kl->c", orthonormal_weights(one).conj(), ip.siegel_logarithm(one, two)
    ).real
    assert np.linalg.norm(coordinates) == pytest.approx(ip.siegel_distance(one, two), rel=1e-11)


def test_geodesics_are_shortest():
    """Distances along a path add up to the whole, and parts are equal."""
    rng = np.random.default_rng(3)
    one, two = random_point(3, rng), random_point(3, rng)
    path = ip.moduli_path(one, two, 6)
    parts = [ip.siegel_distance(a, b) for a, b in pairwise(path)]
    assert np.allclose(parts, ip.siegel_distance(one, two) / 5, rtol=1e-10)
    assert np.array_equal(path[0], one) and np.array_equal(path[-1], two)


def test_hyperbolic_plane():
    """In genus 1 geodesics are half-circles around real points."""
    path = ip.moduli_path([[-1 + 1j]], [[1 + 1j]], 7)[:, 0, 0]
    assert np.allclose(np.abs(path), np.sqrt(2.0))


def test_nearby_points():
    """The logarithm of a point at a distance of 1e-9 has its leading digits."""
    rng = np.random.default_rng(0)
    Pi, E = random_point(2, rng), rng.normal(size=(2, 2)) + 1j * rng.normal(size=(2, 2))
    E = 1e-9 * (E + E.T)
    assert np.abs(ip.siegel_logarithm(Pi, Pi + E) - E).max() < 1e-16


def test_genus_zero():
    nothing = np.zeros((0, 0))
    assert ip.siegel_logarithm(nothing, nothing).shape == (0, 0)


def test_bad_input():
    with pytest.raises(ValueError, match="2 points at least"):
        ip.moduli_path([[1j]], [[2j]], 1)
    with pytest.raises(ValueError, match="different genus"):
        ip.moduli_path([[1j]], 1j * np.eye(2), 3)
    with pytest.raises(NotASiegelPointError, match="not positive definite"):
        ip.siegel_logarithm([[1j]], [[-1j]])
    with pytest.raises(ValueError, match="a velocity at Π has the shape"):
        ip.siegel_exponential([[1j]], np.zeros((2, 2)))
