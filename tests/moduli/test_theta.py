"""Theta constants: sums, identities, published values, vanishing ones."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.known_bounds import known_within
from support.modular_words import random_point, random_word
from support.quadrature_periods import period_matrix as curve_period_matrix

import igl_periods as ip
from igl_periods.errors import NotASiegelPointError
from igl_periods.moduli.genus_one import j_invariant
from igl_periods.moduli.genus_two import rosenhain_roots
from igl_periods.moduli.theta import (
    is_hyperelliptic,
    theta_constants,
    vanishing_even_characteristics,
)
from igl_periods.siegel.balls import to_flint
from igl_periods.siegel.half_space import siegel_transform
from igl_periods.surfaces import (
    regular_map_period_matrix,
    regular_map_surface,
    square_tiled_period_matrix,
)
from igl_periods.surfaces.named_surfaces import binomial_period_matrix

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


# --- genus 2 -----------------------------------------------------------------------------------


def test_wrong_genus():
    with pytest.raises(ValueError, match="needs a surface of genus 2, and Π has genus 1"):
        rosenhain_roots([[1j]])
    with pytest.raises(ValueError, match="needs a surface of genus 1, and Π has genus 2"):
        j_invariant(np.diag([1j, 1j]))
    for function in (theta_constants, to_flint, j_invariant, rosenhain_roots, is_hyperelliptic):
        with pytest.raises(NotASiegelPointError, match="not positive definite"):
            function([[-1j]])
