"""Curves of genus 2: from branch points to matrices and back, Igusa–Clebsch invariants."""

from itertools import combinations, product

import flint
import numpy as np
import pytest
from support.exact_action import moebius_distance
from support.modular_words import random_point, random_word
from support.quadrature_periods import period_matrix as curve_period_matrix

import igl_periods as ip
from igl_periods.moduli.equivalence import symplectic_isomorphisms
from igl_periods.moduli.genus_two import (
    absolute_igusa_invariants,
    igusa_clebsch_invariants,
    rosenhain_roots,
)
from igl_periods.moduli.theta import theta_constants
from igl_periods.siegel.half_space import siegel_transform
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.surfaces import cyclic_cover, square_tiled_period_matrix

BRANCHED = [0, 1, np.inf]


def six_points(roots: np.ndarray) -> np.ndarray:
    return np.concatenate([BRANCHED, roots])


def test_curves_of_the_papers_surfaces():
    cases = {
        "omega_1": [8 - 4 * 3**0.5, 0.5 + 1 / 3**0.5, 2 / 3**0.5],
        "omega_2": [(1 - 1j) / 2, 1 - 1j, -1j],
        "omega_3": [1.5, 2, 3],
    }
    for name, roots in cases.items():
        found = six_points(rosenhain_roots(square_tiled_period_matrix(name)))
        assert moebius_distance(found, six_points(np.array(roots))) < 1e-10
    # Bolza's curve is the octahedron, y² = x⁶ − 1 the hexagon.
    bolza = six_points(rosenhain_roots(square_tiled_period_matrix("omega_2")))
    assert moebius_distance(bolza, np.array([0, 1, -1, 1j, -1j, np.inf])) < 1e-10
    hexagon = np.exp(2j * np.pi * np.arange(6) / 6)
    assert moebius_distance(bolza, hexagon) > 0.1


@pytest.mark.parametrize("seed", range(4))
def test_from_generic_branch_points_to_the_matrix_and_back(seed):
    rng = np.random.default_rng(seed)
    points = rng.standard_normal(6) + 1j * rng.standard_normal(6)
    word = random_word(2, 20, rng, 8)
    Pi = siegel_transform(word, curve_period_matrix(2, points))
    assert moebius_distance(six_points(rosenhain_roots(Pi)), points) < 1e-9


@pytest.mark.parametrize("seed", range(3))
def test_from_a_generic_matrix_to_the_curve_and_back(seed):
    # Far from products of tori, where branch points would come too close for the quadrature.
    a, b, c = np.random.default_rng(seed).uniform(-0.15, 0.15, 3)
    Pi = np.array([[a + 1j, 0.4 + 0.3j], [0.4 + 0.3j, b + (1.2 + c) * 1j]])
    roots = rosenhain_roots(Pi)
    again = curve_period_matrix(2, np.concatenate([[0, 1], roots]))
    assert len(symplectic_isomorphisms(Pi, again, 1e-7)) == 2


def test_from_a_mesh_back_to_the_curve():
    points = np.array([0, 1, -1 + 0.4j, 0.3 - 1.2j, 1.5 + 1j, -0.2 + 1.3j])
    distances = []
    for size in (0.2, 0.1):
        pm = ip.period_matrix(cyclic_cover(2, points, size=size))
        distances.append(moebius_distance(six_points(rosenhain_roots(pm.matrix)), points))
    assert distances[0] < 0.03
    assert distances[1] < 0.6 * distances[0]


def test_products_of_tori_are_no_curves():
    with pytest.raises(ValueError, match=r"characteristic \(\(1, 1\), \(1, 1\)\) vanishes"):
        rosenhain_roots(np.diag([1j, 2j]))
    word = random_word(2, 20, np.random.default_rng(2), 8)
    with pytest.raises(ValueError, match="product of two elliptic curves"):
        rosenhain_roots(siegel_transform(word, np.diag([1j, 2j])))


def absolute(invariants: np.ndarray) -> np.ndarray:
    i2, i4, i6, i10 = invariants
    return np.array([i2**5 / i10, i2**3 * i4 / i10, i2**2 * i6 / i10, i4 * i6 / i10])


@pytest.mark.parametrize("seed", range(3))
def test_igusa_clebsch_invariants_are_invariant(seed):
    rng = np.random.default_rng(seed)
    points = rng.standard_normal(6) + 1j * rng.standard_normal(6)
    a, b, c = rng.standard_normal(3) + 1j * rng.standard_normal(3)
    expected = absolute(igusa_clebsch_invariants(points))
    moved = (a * points + b) / (c * points + 1)
    assert np.abs(absolute(igusa_clebsch_invariants(moved)) / expected - 1).max() < 1e-9
    to_infinity = 1 / (points[:5] - points[5])  # one point at ∞
    assert np.abs(absolute(igusa_clebsch_invariants(to_infinity)) / expected - 1).max() < 1e-9
    roots = rosenhain_roots(curve_period_matrix(2, points))  # three at 0, 1, ∞
    assert np.abs(absolute(igusa_clebsch_invariants(roots)) / expected - 1).max() < 1e-7


def test_igusa_clebsch_invariants_by_modular_forms():
    # I₂ : I₄ : I₆ : I₁₀ = h₁₂/h₁₀ : h₄ : h₁₆/h₁₀ : h₁₀ (Igusa 1967; Spallek 1994), with h_k made of
    # the ten even theta constants and the 15 Göpel quadruples of characteristics with sum 0.
    Pi = siegel_reduce(random_point(2, np.random.default_rng(4))).matrix
    theta, even = theta_constants(Pi), []
    for a, b in product(product((0, 1), repeat=2), repeat=2):
        if np.dot(a, b) % 2 == 0:
            even.append((np.array([*a, *b]), theta[2 * a[0] + a[1], 2 * b[0] + b[1]] ** 4))
    fourth = np.array([t for _, t in even])
    quadruples = [
        chosen
        for chosen in combinations(range(10), 4)
        if not (sum(even[i][0] for i in chosen) % 2).any()
    ]
    assert len(quadruples) == 15
    rest = [np.prod(np.delete(fourth, chosen)) for chosen in quadruples]
    h4, h10, h12 = (fourth**2).sum(), np.sqrt(np.prod(fourth)), sum(rest)
    h16 = sum(r * (fourth[list(c)] ** 2).sum() for r, c in zip(rest, quadruples, strict=True))
    forms = absolute(np.array([h12 / h10, h4, h16 / h10, h10]))
    roots = absolute(igusa_clebsch_invariants(rosenhain_roots(Pi)))
    assert np.abs(forms / roots - 1).max() < 1e-9


@pytest.mark.parametrize(
    ("roots", "message"),
    [([1, 2], "3, 5 or 6 finite roots"), ([2, 2, 3], "coincide"), ([0, 2, 3], "coincide")],
)
def test_singular_curves(roots, message):
    with pytest.raises(ValueError, match=message):
        igusa_clebsch_invariants(roots)


@pytest.mark.parametrize("word", [0, 3])
def test_invariants_in_balls_contain_rational_numbers(word):
    # y² = x⁶ − 1, in the marking of the surface or in a random one.
    with flint.ctx.workprec(200):
        root = flint.arb(3).sqrt()
        Pi = flint.acb_mat([[flint.acb(0, x / root) for x in row] for row in ((2, -1), (-1, 2))])
        gamma = random_word(2, word, np.random.default_rng(1), 8)
        (a, b), (c, d) = (
            [flint.acb_mat(block.astype(int).tolist()) for block in np.hsplit(half, 2)]
            for half in np.vsplit(gamma, 2)
        )
        moved = (a * Pi + b) * (c * Pi + d).inv()
        found = absolute_igusa_invariants(moved)
        roots = rosenhain_roots(Pi)
        assert all(z.contains(x) for z, x in zip(roots, (1.5, 2, 3)))
        exact = [flint.fmpq(51200000, 3), 480000, 148000]
        assert all(z.contains(flint.acb(flint.arb(x))) for z, x in zip(found, exact))
        assert max(float(z.real.rad()) for z in found) < 1e-30
    with pytest.raises(ValueError, match="coincide"):
        igusa_clebsch_invariants([flint.acb(flint.arb(1, 0.1)), flint.acb(2), flint.acb(3)])


def test_products_known_in_balls_have_no_invariants():
    assert absolute_igusa_invariants(flint.acb_mat([[1j, 0], [0, 2j]])) is None
