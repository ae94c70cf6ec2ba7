"""Triangles from their lengths: cotangents, angles, mollification, sensitivity."""

import igl
import numpy as np
import pytest
from support.random_surfaces import (
    noisy_torus,
)

import igl_periods as ip
from igl_periods.complexes.triangles import (
    angles,
    cotangents,
    double_areas,
    is_strict,
    length_sensitivity,
    mollify,
    shapes,
)


# Triangles
def test_cotangents_are_those_of_libigl():
    V, F = noisy_torus(9, 6, 0.1, seed=3)
    lengths = igl.edge_lengths(V, F)
    ours, theirs = cotangents(lengths), 2.0 * igl.cotmatrix_entries(lengths)
    np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12 * np.abs(ours).max())


@pytest.mark.parametrize("kind", [np.float64, np.longdouble])
def test_shapes_are_what_each_function_says(kind):
    rng = np.random.default_rng(5)
    lengths = rng.uniform(1.0, 1.9, (500, 3)).astype(kind)
    lengths[0] = 1.0, 1.0, 2.0
    strict, cot, sensitivity = shapes(lengths)
    assert not strict[0]
    assert strict[1:].all()
    assert np.array_equal(strict, is_strict(lengths))
    assert np.array_equal(cot[1:], cotangents(lengths[1:]))
    assert np.array_equal(sensitivity[1:], length_sensitivity(lengths[1:]))


def test_right_angles_of_needles_are_exact():
    # Legs c and 1, c = 2^-26: the hypotenuse rounds to 1, so the triangle stored is isosceles.
    c = 2.0**-26
    needle = np.array([[c, 1.0, 1.0]])
    # Isosceles: cot of the base angles is c / (2h), h² = 1 − c²/4.
    exact = c / (2.0 * np.sqrt(1.0 - c * c / 4.0))
    np.testing.assert_allclose(cotangents(needle)[0, 1:], exact, rtol=1e-15)
    np.testing.assert_allclose(double_areas(needle), c * np.sqrt(1 - c * c / 4), rtol=1e-15)


def test_angles_add_up_to_pi():
    lengths = np.random.default_rng(0).uniform(1.0, 1.99, size=(200, 3))
    np.testing.assert_allclose(angles(lengths).sum(axis=1), np.pi, rtol=1e-14)


def test_mollification_mends_what_rounding_broke():
    lengths = np.array([[1.0, 1.0, 2.0], [1.0, 1.0, 1.0]])
    mended, delta = mollify(lengths)
    assert 0 < delta < 1e-12
    assert np.array_equal(mended, lengths + delta)
    assert (double_areas(mended) > 0).all()
    assert mollify(mended) == (pytest.approx(mended, abs=0), 0.0)


@pytest.mark.parametrize(
    "lengths",
    [
        # A long collinear face among many small ones, and one that misses strictness by little.
        [[1024.0, 512.0, 512.0], *[[1.0, 1.0, 1.0]] * 3600],
        [[1000.0, 500.0, 500.0 + 2e-12], *[[1.0, 1.0, 1.0]] * 5000],
    ],
)
def test_mollified_triangles_are_strict(lengths):
    mended, delta = mollify(np.array(lengths))
    assert 0 < delta < 1e-6
    assert is_strict(mended).all()
    assert (double_areas(mended) > 0).all()


def test_the_most_that_is_mollified():
    faces = np.ones((100, 3))
    faces[0] = 1.0, 0.4, 0.6 - 0.9e-6
    assert mollify(faces)[1] == pytest.approx(0.9e-6, rel=1e-3)
    faces[0, 2] = 0.6 - 1.1e-6
    with pytest.raises(ip.ComplexError, match="face 0 is degenerate"):
        mollify(faces)


def test_sensitivity_of_simple_triangles():
    c = 1e-3
    cap = np.array([[1.0, 0.5 * np.sqrt(1 + 4 * c * c), 0.5 * np.sqrt(1 + 4 * c * c)]])
    assert length_sensitivity(np.ones((1, 3)))[0] == pytest.approx(8.0)
    assert length_sensitivity(np.array([[c, 1.0, 1.0]]))[0] == pytest.approx(4 / c, rel=1e-2)
    assert length_sensitivity(cap)[0] == pytest.approx(1 / c**2, rel=1e-2)


@pytest.mark.parametrize("seed", range(10))
def test_sensitivity_bounds_the_change_of_metric(seed):
    # The generalised eigenvalues of the two metrics on the plane of the triangle.
    rng = np.random.default_rng(seed)
    lengths = np.array([1.0, *(0.5 + rng.uniform(1e-3, 0.4, 2))])

    def metric(sides):
        a, b, c = sides**2
        return np.array([[c, (b + c - a) / 2], [(b + c - a) / 2, b]])

    g, sensitivity, epsilon = metric(lengths), length_sensitivity(lengths[None])[0], 1e-9
    for signs in rng.choice([-1.0, 1.0], (8, 3)):
        changed = metric(lengths * (1 + epsilon * signs))
        change = np.abs(np.linalg.eigvals(np.linalg.solve(g, changed)) - 1).max()
        assert change <= sensitivity * epsilon * 1.01 + 1e-14 * sensitivity
