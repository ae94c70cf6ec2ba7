"""Isometries that are decided in balls: none is lost, and none too many is found."""

from itertools import product

import flint
import numpy as np
import pytest
from support.modular_words import random_point
from support.points_in_balls import with_radius

from igl_periods.errors import EnumerationLimitError, NotASiegelPointError
from igl_periods.moduli import isometries_in_balls
from igl_periods.moduli.isometries_in_balls import ball_isometries, short_vectors_in_balls
from igl_periods.moduli.lattice_isometries import isometries
from igl_periods.siegel import energy_balls
from igl_periods.symplectic import energy_matrix


@pytest.mark.parametrize("seed", range(6))
def test_short_vectors_by_trying_all(seed):
    rng = np.random.default_rng(seed)
    A = np.eye(4) + 0.3 * rng.standard_normal((4, 4))
    G = A @ A.T
    bound = 4.0 * float(np.diag(G).max())
    found = short_vectors_in_balls(flint.arb_mat(G.tolist()), flint.arb(bound))
    reach = int(np.ceil(np.sqrt(bound / np.linalg.eigvalsh(G)[0])))
    x = np.array(list(product(range(-reach, reach + 1), repeat=4)))
    inside = x[np.einsum("ni,ij,nj->n", x, G, x) <= bound]
    assert {tuple(v) for v in found.tolist()} == {tuple(v) for v in inside.tolist()}
    assert len(found) == len(inside)


def test_vectors_on_the_sphere_are_kept():
    # |x|² = 2 exactly at the bound: rounding must not lose any.
    found = short_vectors_in_balls(flint.arb_mat(np.eye(4).tolist()), flint.arb(2))
    assert len(found) == 1 + 8 + 24


@pytest.mark.parametrize("g", [1, 2, 3])
def test_the_same_as_with_a_small_tolerance(g):
    Pi = random_point(g, np.random.default_rng(g))
    Pi = np.diag(np.diag(Pi)) if g == 2 else Pi
    in_balls = list(ball_isometries(*[energy_balls(with_radius(Pi, 12), 100)] * 2))
    in_floats = list(isometries(*[energy_matrix(Pi)] * 2, 1e-10))
    assert {U.tobytes() for U in in_balls} == {U.astype(np.int64).tobytes() for U in in_floats}
    assert len(in_balls) == len(in_floats) >= 2


def test_none_where_balls_are_apart():
    Pi = random_point(2, np.random.default_rng(4))
    moved = Pi + 1e-12 * np.array([[1, 0], [0, 0]])
    with flint.ctx.workprec(200):
        G1, G2 = (energy_balls(with_radius(X, 20), 200) for X in (Pi, moved))
        assert list(ball_isometries(G1, G2)) == []
        assert len(list(ball_isometries(G1, G1))) == 2
    G1, G2 = (energy_balls(with_radius(X, 11), 200) for X in (Pi, moved))
    assert len(list(ball_isometries(G1, G2))) == 2


def test_an_enumeration_that_is_too_large(monkeypatch):
    Pi = random_point(2, np.random.default_rng(8))
    G = energy_balls(with_radius(Pi, 20), 200)
    monkeypatch.setattr(isometries_in_balls, "VECTOR_LIMIT", 3)
    with pytest.raises(EnumerationLimitError, match="more than 3 partial vectors"):
        list(ball_isometries(G, G))


def test_balls_that_are_too_large():
    G = flint.arb_mat([[flint.arb(1, 0.1), 0.95], [0.95, 1]])
    with pytest.raises(NotASiegelPointError, match="need not be positive definite"):
        short_vectors_in_balls(G, flint.arb(2))
