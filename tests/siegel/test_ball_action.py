"""The action on balls contains the action on points; energies; reduction."""

import flint
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.modular_words import random_point, random_word
from support.points_in_balls import Enclosed, with_radius

import igl_periods as ip
from igl_periods.errors import NotASiegelPointError
from igl_periods.siegel import (
    EnclosedReduction,
    cholesky,
    energy_balls,
    midpoint,
    moved_balls,
)
from igl_periods.symplectic import energy_matrix, form_action, product

cases = st.tuples(st.integers(1, 4), st.integers(0, 2**32 - 1), st.integers(0, 12))


@settings(max_examples=40, deadline=None)
@given(cases)
def test_moved_balls_contain_moved_points(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi, gamma = random_point(g, rng), random_word(g, length, rng, 20)
    moved = moved_balls(gamma, with_radius(Pi, 30), 300)
    inside = moved_balls(gamma, with_radius(Pi, 60), 300)
    assert moved.contains(inside)
    assert np.allclose(midpoint(moved), ip.siegel_transform(gamma, Pi), rtol=1e-13)
    back = np.array(flint.fmpz_mat(gamma.tolist()).inv().tolist()).astype(np.float64)
    assert moved_balls(back.astype(np.int64), inside, 300).overlaps(with_radius(Pi, 60))


@settings(max_examples=30, deadline=None)
@given(cases)
def test_energies_move_as_forms_do(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi, gamma = random_point(g, rng), random_word(g, length, rng, 20)
    G = energy_balls(with_radius(Pi, 40), 300)
    assert np.allclose([float(x.mid()) for x in G.entries()], energy_matrix(Pi).ravel())
    U = flint.arb_mat(form_action(gamma).tolist())
    with flint.ctx.workprec(300):
        moved = U * G * U.transpose()
        assert moved.overlaps(energy_balls(moved_balls(gamma, with_radius(Pi, 40), 300), 300))
        J = flint.arb_mat(np.kron([[0, 1], [-1, 0]], np.eye(g, dtype=int)).tolist())
        assert (G * J * G).overlaps(J)
        L = cholesky(G)
        assert (L * L.transpose()).overlaps(G)


@settings(max_examples=30, deadline=None)
@given(cases)
def test_balls_are_reduced_where_their_midpoints_are(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi, word = random_point(g, rng), random_word(g, length, rng, 20)
    given_balls = moved_balls(word, with_radius(Pi, 60), 400)
    matrix, gamma = ip.siegel_reduce(given_balls)
    assert np.array_equal(ip.siegel_reduce(midpoint(matrix)).gamma, np.eye(2 * g))
    assert matrix.overlaps(moved_balls(product(gamma, word), with_radius(Pi, 60), 400))
    again = ip.siegel_reduce(Enclosed(given_balls, 400))
    assert isinstance(again, EnclosedReduction)
    assert np.array_equal(again.gamma, gamma)
    assert again.matrix.overlaps(matrix)
    assert ip.siegel_transform(gamma, Enclosed(given_balls, 400)).overlaps(matrix)


def test_distance_has_all_digits_of_the_balls():
    with flint.ctx.workprec(300):
        near = flint.acb_mat([[flint.acb(0, 1 + flint.arb(10) ** -40)]])
        here = flint.acb_mat([[flint.acb(0, 1)]])
        assert ip.siegel_distance(here, near) == pytest.approx(1e-40, rel=1e-9)


def test_large_balls_are_refused():
    huge = with_radius([[1j]], 0)
    with pytest.raises(NotASiegelPointError, match="balls are so large that nothing is known of γ"):
        ip.siegel_transform([[0, -1], [1, 0]], huge)
    with pytest.raises(NotASiegelPointError, match="nothing is known of the energies"):
        energy_balls(huge, 100)


def test_midpoints_are_checked():
    with pytest.raises(NotASiegelPointError, match="not positive definite"):
        ip.siegel_reduce(with_radius([[-1j]], 20))
    with pytest.raises(NotASiegelPointError, match="square"):
        ip.siegel_reduce(flint.acb_mat(1, 2))
    with pytest.raises(ValueError, match="not symplectic"):
        ip.siegel_transform([[2, 0], [0, 1]], with_radius([[1j]], 20))
