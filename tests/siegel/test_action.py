"""The action of the modular group at high genus, against exact rational arithmetic."""

import flint
import numpy as np
import pytest
from support.modular_words import random_point, random_word

from igl_periods.siegel.half_space import siegel_transform

HIGH = 42


def exact_action(gamma, Pi):
    """Re and Im of γ · Π, correctly rounded: a linear system over Q for [[X, −Y], [Y, X]]."""
    g = len(Pi)
    X, Y = Pi.real, Pi.imag
    doubled = flint.fmpq_mat(_rational(np.block([[X, -Y], [Y, X]])))
    a, b, c, d = (
        flint.fmpq_mat(flint.fmpz_mat(np.kron(np.eye(2, dtype=np.int64), block).tolist()))
        for block in (gamma[:g, :g], gamma[:g, g:], gamma[g:, :g], gamma[g:, g:])
    )
    Z = (c * doubled + d).transpose().solve((a * doubled + b).transpose()).transpose()
    # Division of Python's integers is correctly rounded.
    value = np.array([int(v.p) / int(v.q) for v in Z.entries()]).reshape(2 * g, 2 * g)
    return value[:g, :g] + 1j * value[g:, :g]


def _rational(M):
    return [[flint.fmpq(*v.as_integer_ratio()) for v in row] for row in M.tolist()]


@pytest.mark.parametrize("length", [0, 60, 200])
def test_every_entry_is_right_to_rounding(length):
    rng = np.random.default_rng(length)
    Pi, gamma = random_point(HIGH, rng), random_word(HIGH, length, rng, 10**6)
    moved = siegel_transform(gamma, Pi)
    exact = exact_action(gamma, Pi)
    scale = np.abs(np.diag(exact)).min()
    assert np.abs(moved - exact).max() <= 2.0**-52 * max(scale, np.abs(exact).max())


@pytest.mark.parametrize("length", [0, 60])
def test_one_correction_is_enough_for_ordinary_points(length, monkeypatch):
    rng = np.random.default_rng(length)
    Pi, gamma = random_point(HIGH, rng), random_word(HIGH, length, rng)
    with_either = siegel_transform(gamma, Pi)
    monkeypatch.setattr("igl_periods.siegel.action._in_balls", None)
    assert np.array_equal(siegel_transform(gamma, Pi), with_either)
    monkeypatch.undo()
    monkeypatch.setattr("igl_periods.siegel.action._BALL_GENUS", HIGH)
    assert np.abs(siegel_transform(gamma, Pi) - with_either).max() <= 2.0**-52


def test_plain_floating_point_is_not():
    rng = np.random.default_rng(5)
    Pi, gamma = random_point(HIGH, rng), random_word(HIGH, 200, rng, 10**6)
    a, b, c, d = (block for half in np.split(gamma, 2) for block in np.split(half, 2, 1))
    plain = (a @ Pi + b) @ np.linalg.inv(c @ Pi + d)
    assert np.abs(plain - exact_action(gamma, Pi)).max() > 2.0**-50


@pytest.mark.parametrize("height", [1e-9, 1e9])
def test_points_near_the_boundary(height):
    # One correction is not enough there, or leading bits have no common unit with integers.
    rng = np.random.default_rng(1)
    Pi, gamma = random_point(HIGH, rng), random_word(HIGH, 60, rng)
    Pi = Pi.real + 1j * height * Pi.imag
    moved, exact = siegel_transform(gamma, Pi), exact_action(gamma, Pi)
    scale = np.abs(np.diag(exact)).min()
    assert np.abs(moved - exact).max() <= 2.0**-52 * max(scale, np.abs(exact).max())
