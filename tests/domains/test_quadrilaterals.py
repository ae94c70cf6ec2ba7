"""Moduli of quadrilaterals: rectangles, published ones, conjugates and compositions."""

from itertools import combinations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import ellipk
from support.random_domains import AITCH, ELL, random_domain, square, star

import igl_periods as ip
from igl_periods.domains.quadrilaterals import extremal_length
from igl_periods.surfaces import planar_domain


@pytest.mark.parametrize(("width", "height"), [(1.0, 1.0), (2.0, 0.7), (0.3, 4.0)])
def test_rectangles_are_exact_at_degree_one(width, height):
    V, F = planar_domain([0, width, width + 1j * height, 1j * height])
    h = extremal_length(V, F, [0, 1, 2, 3], degree=1)
    assert h.value == pytest.approx(height / width, rel=1e-12)
    low, high = h.bounds
    assert low <= height / width <= high
    assert float(h) == h.value


def test_published_modulus_of_the_ell():
    # Between the ends of both arms: twice that of the half, a trapezium with the modulus
    # 1.279261571171 (Papamichael, Stylianopoulos).  It is conjugate to itself by no symmetry.
    V, F = planar_domain(ELL)
    h = extremal_length(V, F, [1, 2, 4, 5], tolerance=1e-12)
    low, high = h.bounds
    assert high - low < 1e-11
    assert h.value == pytest.approx(2 * 1.279261571171, rel=1e-12)
    half = planar_domain([0, 2, 2 + 1j, 1 + 1j])
    assert extremal_length(half, [1, 2, 3, 0], tolerance=1e-12).value == pytest.approx(
        1.279261571171, rel=1e-12
    )


def prevertices_of_the_ell():
    """The corners of the ell on the real line, with the disc as the half plane.

    dz = √w dw / √((w² − a²)(w² − 1)) takes −1, −a, 0, a, 1 to the corners but the outer one, which
    is the image of ∞; all of these sides have the length 1.
    """

    def difference(a):
        # Where a root vanishes at an end, w is a sine or a square of the distance from there.
        inner = quad(lambda t: np.sqrt(a * np.sin(t) / (1 - (a * np.sin(t)) ** 2)), 0, np.pi / 2)
        c, r = (1 + a * a) / 2, (1 - a * a) / 2
        outer = quad(lambda t: 0.5 * (c - r * np.cos(t)) ** -0.25, 0, np.pi)
        return inner[0] - outer[0]

    a = brentq(difference, 0.01, 0.99, xtol=1e-15)
    # ∞ goes to 0, behind all others.
    return np.append(0.0, -1 / (np.array([-1, -a, 0, a, 1]) + 2))


@pytest.mark.parametrize("corners", list(combinations(range(6), 4))[::2])
def test_ells_by_the_formula_of_schwarz_and_christoffel(corners):
    x = prevertices_of_the_ell()
    order = sorted(corners, key=lambda k: x[k])
    p, q, r, s = x[order]
    share = (q - p) * (s - r) / ((r - p) * (s - q))
    exact = ellipk(1 - share) / ellipk(share)
    h = extremal_length(planar_domain(ELL), order, tolerance=1e-9)
    assert h.bounds[0] - 1e-12 <= exact <= h.bounds[1] + 1e-12
    assert h.value == pytest.approx(exact, rel=2e-9)


def test_ells_whose_moduli_are_roots_of_three():
    V, F = planar_domain(ELL)
    for corners in ([0, 1, 4, 5], [1, 2, 3, 4], [2, 3, 4, 5]):
        low, high = extremal_length(V, F, corners, tolerance=1e-9).bounds
        assert low <= np.sqrt(3) <= high


def test_symmetric_quadrilaterals_have_modulus_one():
    # The ell is symmetric about its diagonal, which joins two of the corners.
    V, F = planar_domain(ELL)
    for corners in ([0, 1, 3, 5], [0, 2, 3, 4]):
        low, high = extremal_length(V, F, corners, tolerance=1e-9).bounds
        assert low <= 1 <= high


@pytest.mark.parametrize("seed", range(8))
def test_conjugates(seed):
    rng = np.random.default_rng(seed)
    V, F = planar_domain(star(rng, 9))
    corners = np.sort(rng.permutation(9)[:4])
    for degree in (1, 4):
        one = extremal_length(V, F, corners, degree=degree)
        other = extremal_length(V, F, np.roll(corners, -1), degree=degree)
        low, high = np.multiply(one.bounds, other.bounds)
        assert low <= 1 <= high
        turned = extremal_length(V, F, np.roll(corners, -2), degree=degree)
        assert turned.value == pytest.approx(one.value, rel=1e-10 if degree > 1 else 1e-3)
    assert high - low < 1e-2


def test_a_half_plane_by_elliptic_integrals():
    # A polygonal half disc is equivalent to a half plane up to order 2 in its sides.
    k = 0.5
    exact = ellipk(1 - k**2) / (2 * ellipk(k**2))
    errors = []
    for n in (24, 48):
        # The disc with corners e^{±iφ}, −e^{±iφ}: equal to one with the cross ratio of k.
        phi = 2 * np.arctan(np.sqrt(k))
        angle = np.concatenate([np.linspace(-phi, phi, n)[:-1], np.linspace(phi, np.pi - phi, n)])
        angle = np.concatenate([angle[:-1], angle[:-1] + np.pi])
        V, F = planar_domain(np.exp(1j * angle))
        corners = [0, n - 1, 2 * n - 2, 3 * n - 3]
        errors.append(extremal_length(V, F, corners, tolerance=1e-7).value - exact)
    assert abs(errors[1]) < 1e-3 * exact
    assert abs(errors[0] / errors[1]) > 3


def test_longer_is_more_and_wider_is_less():
    # Composition laws: a dissection across adds up at most, one along is at most parallel.
    left, right = square(0, 0, 1), np.array([1, 2, 2 + 2j, 1 + 1j])
    whole = np.array([0, 1, 2, 2 + 2j, 1 + 1j, 1j])
    corners = {"whole": [2, 3, 5, 0], "left": [1, 2, 3, 0], "right": [1, 2, 3, 0]}
    h = {
        name: extremal_length(planar_domain(z), corners[name], tolerance=1e-6)
        for name, z in (("whole", whole), ("left", left), ("right", right))
    }
    assert h["left"].value == pytest.approx(1, rel=1e-12)
    assert h["whole"].bounds[0] > h["left"].bounds[1] + h["right"].bounds[1]


def test_other_loops_are_insulated():
    outer, holes = random_domain(np.random.default_rng(5))
    plain = extremal_length(planar_domain(outer), [0, 2, 3, 5], tolerance=1e-4)
    pierced = extremal_length(planar_domain(outer, holes), [0, 2, 3, 5], tolerance=1e-4)
    # Insulators raise the resistance both ways: products are above 1.
    across = extremal_length(planar_domain(outer, holes), [2, 3, 5, 0], tolerance=1e-4)
    assert pierced.bounds[0] > plain.bounds[1]
    assert pierced.bounds[0] * across.bounds[0] > 1


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ([0, 1, 2], r"four corners.* not an array of shape \(3,\)"),
        ([0.0, 1.0, 2.0, 3.0], "four corners.* of float64"),
        ([0, 1, 1, 3], "do not follow each other"),
        ([3, 2, 1, 0], "do not follow each other"),
        ([0, 1, 2, 12], "vertex 12 is not on the boundary loop of the other corners"),
        ([99, 98, 97, 96], "vertex 99 is on no boundary loop"),
    ],
)
def test_corners_that_are_none(corners, message):
    V, F = planar_domain(3 * AITCH, [0.5 + 0.5j + square(0, 0, 1)])
    with pytest.raises(ip.ComplexError, match=message):
        extremal_length(V, F, corners)


def test_shown_with_its_digits():
    V, F = planar_domain(square(0, 0, 1))
    assert repr(extremal_length(V, F, [0, 1, 2, 3])).startswith("ExtremalLength(1.0000000")
