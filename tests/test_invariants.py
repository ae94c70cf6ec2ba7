"""Theta constants, j, curves of genus 2, recognition of quadratic numbers."""

import math
from dataclasses import replace
from fractions import Fraction
from itertools import combinations, product

import numpy as np
import pytest
from curve_periods import period_matrix as curve_period_matrix
from hypothesis import given, settings
from hypothesis import strategies as st
from modular_words import random_point, random_word
from moebius import moebius_distance
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.errors import NotASiegelPointError
from igl_periods.moduli.equivalence import symplectic_isomorphisms
from igl_periods.moduli.genus_one import j_invariant
from igl_periods.moduli.genus_two import igusa_clebsch_invariants, rosenhain_roots
from igl_periods.moduli.quadratic_numbers import recognise_entries, recognise_quadratic
from igl_periods.moduli.theta import (
    is_hyperelliptic,
    theta_constants,
    vanishing_even_characteristics,
)
from igl_periods.siegel.balls import to_flint
from igl_periods.siegel.half_space import siegel_transform
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.surfaces import (
    cyclic_cover,
    flat_torus,
    regular_map_period_matrix,
    regular_map_surface,
    square_tiled_period_matrix,
    square_tiled_surface,
)
from igl_periods.surfaces.named_surfaces import binomial_period_matrix
from igl_periods.symplectic.williamson_form import energy_matrix

BRANCHED = [0, 1, np.inf]


def six_points(roots: np.ndarray) -> np.ndarray:
    return np.concatenate([BRANCHED, roots])


def known_within(bound: float, Pi: np.ndarray) -> ip.PeriodMatrix:
    """A certified period matrix: all energies too large by the same factor."""
    any_surface = ip.period_matrix(square_tiled_surface("omega_1"))
    energies = (1 + bound) * energy_matrix(Pi)
    no_marking = csr_array((2 * len(Pi), any_surface.complex.n_edges))
    pm = replace(any_surface, dirichlet=energies, cocycles=no_marking)
    assert bound <= pm.bound < 2 * bound + 1e-12
    return pm


# --- theta constants ---------------------------------------------------------------------------


@pytest.mark.parametrize("g", [1, 2, 3])
def test_theta_constants_are_the_sums(g):
    Pi = random_point(g, np.random.default_rng(g)) + 0.5j * np.eye(g)
    n = np.array(list(product(range(-8, 9), repeat=g)))
    values = theta_constants(Pi)
    for i, a in enumerate(product((0, 1), repeat=g)):
        for j, b in enumerate(product((0, 1), repeat=g)):
            m = n + np.array(a) / 2
            terms = np.exp(1j * np.pi * (np.einsum("ni,ij,nj->n", m, Pi, m) + m @ np.array(b)))
            assert abs(values[i, j] - terms.sum()) < 1e-12


def test_published_theta_constants():
    # abelfunctions, test_riemanntheta.py (Maple's value).
    Pi = 0.5 * np.ones((3, 3)) + (1j - 0.5) * np.eye(3)
    assert abs(theta_constants(Pi)[0, 0] - 1.2362529854204190) < 1e-15
    # flint issue #2017, a form of ξ_{3,1}.
    s = np.sqrt(2)
    Pi = np.array([[(2 + s) / 4 * 1j, 0.5, (2 - s) / 4 * 1j], [0.5, s / 2 * 1j, -0.5], [0, 0, 0]])
    Pi[2] = [(2 - s) / 4 * 1j, -0.5, (2 + s) / 4 * 1j]
    published = [1.4650143759872511, 1.1841100316567141, 1.1381506044944230, 0.7620864111821092]
    published += [1.1841100316567141, 1.0359215997963638, 0.7620864111821092, 0.4714374164]
    assert np.abs(theta_constants(Pi)[0] - published).max() < 1e-10
    # python-flint, doctest of acb_mat.theta.
    published = [1.180340599016096, 0.9925441784910575, 0.9925441784910575, 0.8346268416740732]
    assert np.abs(theta_constants(np.diag([1j, 1j]))[0] - published).max() < 1e-15


def test_jacobis_identity():
    (t00, t01), (t10, t11) = theta_constants([[0.3 + 0.8j]])
    assert abs(t00**4 - t01**4 - t10**4) < 1e-14
    assert t11 == 0


@settings(max_examples=25, deadline=None)
@given(st.integers(1, 3), st.integers(0, 2**32 - 1), st.integers(0, 20))
def test_even_theta_constants_are_permuted(g, seed, length):
    rng = np.random.default_rng(seed)
    Pi = random_point(g, rng)
    moved = siegel_transform(random_word(g, length, rng, 10), Pi)
    here, there = (
        np.sort(np.abs(theta_constants(M)).ravel()) * np.linalg.det(M.imag) ** 0.25
        for M in (Pi, moved)
    )
    assert np.abs(here - there).max() < 1e-9


def test_sorted_theta_constants_of_the_papers_surfaces():
    for name, values in (
        ("omega_2", [0.88733688] * 4 + [1.05522733] * 6),
        ("omega_3", [0.66949264] * 3 + [0.94680557] * 6 + [1.15959527]),
    ):
        theta = np.abs(theta_constants(square_tiled_period_matrix(name))).ravel()
        assert np.abs(np.sort(theta)[6:] - values).max() < 1e-8
        assert np.abs(np.sort(theta)[:6]).max() < 1e-15  # the odd ones


# --- vanishing and hyperelliptic surfaces ------------------------------------------------------


@pytest.mark.parametrize(
    ("matrix", "n_vanishing", "hyperelliptic"),
    [
        (regular_map_period_matrix("klein"), 0, False),
        (regular_map_period_matrix("fermat"), 0, False),
        (regular_map_period_matrix("schwarz_p"), 1, True),
        (binomial_period_matrix(7), 1, True),
        (binomial_period_matrix(8), 1, True),
        (curve_period_matrix(2, [0, 1, 2j, -1, 3, 1 - 2j, 0.4 + 0.7j]), 1, True),
        (curve_period_matrix(3, [0, 1, 2j, -1 - 1j]), 0, False),  # a plane quartic
        (random_point(3, np.random.default_rng(8)), 0, False),
        (random_point(2, np.random.default_rng(8)), 0, True),
        (square_tiled_period_matrix("omega_1"), 0, True),
    ],
)
def test_vanishing_even_theta_constants(matrix, n_vanishing, hyperelliptic):
    word = random_word(len(matrix), 20, np.random.default_rng(5), 6)
    for Pi in (matrix, siegel_transform(word, matrix)):
        assert len(vanishing_even_characteristics(Pi)) == n_vanishing
        assert is_hyperelliptic(Pi) is hyperelliptic


def test_products_of_tori():
    assert vanishing_even_characteristics(np.diag([1j, 2j])) == [((1, 1), (1, 1))]
    # Two of the three factors odd: 3 ways, times the 3 even characteristics of the third.
    assert len(vanishing_even_characteristics(np.diag([1j, 2j, 0.2 + 1.7j]))) == 9


def test_hyperelliptic_by_certificate():
    assert is_hyperelliptic(ip.period_matrix(regular_map_surface("schwarz_p", 4))) is not False
    fine = known_within(1e-5, regular_map_period_matrix("klein"))
    assert is_hyperelliptic(fine) is False  # proved for the polyhedral surface
    assert vanishing_even_characteristics(fine) == []
    coarse = ip.period_matrix(regular_map_surface("klein", 1))
    assert vanishing_even_characteristics(coarse) is None
    assert is_hyperelliptic(coarse) is None
    assert is_hyperelliptic(regular_map_period_matrix("bring")) is None


def test_no_certificate():
    K = regular_map_surface("klein")
    abstract = ip.period_matrix_from_weights(np.ones((K.n_faces, 3)), K.twin)
    with pytest.raises(ValueError, match="without a certificate"):
        vanishing_even_characteristics(abstract)


# --- genus 1 -----------------------------------------------------------------------------------


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


# --- genus 2 -----------------------------------------------------------------------------------


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


def test_wrong_genus():
    with pytest.raises(ValueError, match="needs a surface of genus 2, and Π has genus 1"):
        rosenhain_roots([[1j]])
    with pytest.raises(ValueError, match="needs a surface of genus 1, and Π has genus 2"):
        j_invariant(np.diag([1j, 1j]))
    for function in (theta_constants, to_flint, j_invariant, rosenhain_roots, is_hyperelliptic):
        with pytest.raises(NotASiegelPointError, match="not positive definite"):
            function([[-1j]])


# --- hand-over ---------------------------------------------------------------------------------


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


# --- recognition -------------------------------------------------------------------------------


@settings(max_examples=100, deadline=None)
@given(st.integers(-9, 9), st.integers(-6, 6), st.integers(1, 8), st.sampled_from([2, 3, 5, 7, 13]))
def test_small_quadratic_numbers_are_recognised(p, q, r, n):
    guess = recognise_quadratic((p + q * math.sqrt(n)) / r, 1e-14)
    assert guess is not None
    assert guess.rational == Fraction(p, r)
    assert guess.root == Fraction(q, r)
    assert guess.radicand == (n if q else 0)
    assert guess.error < 1e-14


def test_random_numbers_are_not_recognised():
    rng = np.random.default_rng(0)
    for error in (1e-3, 1e-6, 1e-12):
        recognised = [recognise_quadratic(y, error) for y in rng.uniform(-1, 1, 400)]
        assert sum(guess is not None for guess in recognised) <= 2
    assert recognise_quadratic(math.pi) is None
    assert recognise_quadratic(math.e, 1e-6) is None


def test_a_guess_tells_its_error():
    guess = recognise_quadratic(math.sqrt(2) + 3e-9, 1e-8)
    assert str(guess) == "sqrt(2)"
    assert abs(guess.error - 3e-9) < 1e-12
    assert guess.coincidence < 1e-3
    assert str(recognise_quadratic(-0.75)) == "-3/4"
    assert str(recognise_quadratic(1 - math.sqrt(2))) == "1 - sqrt(2)"
    assert float(recognise_quadratic(1 - math.sqrt(2))) == 1 - math.sqrt(2)


def test_entries_of_the_papers_matrices():
    table = recognise_entries(square_tiled_period_matrix("omega_2"))
    text = [[tuple(str(part) for part in entry) for entry in row] for row in table]
    diagonal, off = ("-2/3", "2/3*sqrt(2)"), ("1/3", "-1/3*sqrt(2)")
    assert text == [[diagonal, off], [off, diagonal]]
    pm = known_within(1e-9, siegel_reduce(square_tiled_period_matrix("omega_3")).matrix)
    for row in recognise_entries(pm):
        for real, imaginary in row:
            assert real.radicand == 0
            assert imaginary.radicand == 3


def test_recognition_refuses_nonsense():
    for y, error in ((math.nan, 1e-9), (1.0, 0.0), (1.0, -1.0)):
        with pytest.raises(ValueError, match="finite number and a positive error"):
            recognise_quadratic(y, error)
    with pytest.raises(NotASiegelPointError, match="not symmetric"):
        recognise_entries([[1j, 0.5], [0, 1j]])
