"""The Siegel upper half-space: action, metric, what is not a point of it."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.brute_force_equivalence import mobius
from support.modular_words import random_point, random_word

from igl_periods.errors import NotASiegelPointError
from igl_periods.siegel.half_space import (
    check_siegel_point,
    siegel_distance,
    siegel_transform,
)
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.symplectic.canonical_basis import form_action
from igl_periods.symplectic.williamson_form import energy_matrix

cases = st.tuples(st.integers(1, 6), st.integers(0, 2**32 - 1), st.integers(0, 40))


# --- action and distance -----------------------------------------------------------------------


@settings(max_examples=60, deadline=None)
@given(cases)
def test_the_action_is_an_action_and_an_isometry(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    one, two = random_point(g, rng), random_point(g, rng)
    first, second = random_word(g, length, rng, 300), random_word(g, length, rng, 300)
    once = siegel_transform(second @ first, one)
    assert siegel_distance(once, siegel_transform(second, siegel_transform(first, one))) < 1e-8
    moved = siegel_distance(siegel_transform(first, one), siegel_transform(first, two))
    assert abs(moved - siegel_distance(one, two)) < 1e-8 * (1 + moved)


@settings(max_examples=40, deadline=None)
@given(cases)
def test_the_action_on_forms_is_the_same_action(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi, gamma = random_point(g, rng), random_word(g, length, rng, 30)
    U = form_action(gamma)
    D = energy_matrix(siegel_transform(gamma, Pi))
    moved = U @ energy_matrix(Pi) @ U.T
    assert np.abs(moved - D).max() < 1e-9 * np.abs(D).max()


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 6), st.integers(0, 2**32 - 1))
def test_distance_is_that_of_the_eigenvalues(g, seed):
    rng = np.random.default_rng(seed)
    one, two = random_point(g, rng), random_point(g, rng)
    eigenvalues = np.linalg.eigvals(np.linalg.solve(energy_matrix(one), energy_matrix(two))).real
    largest = np.sort(eigenvalues)[g:]
    assert abs(siegel_distance(one, two) - np.linalg.norm(np.log(largest))) < 1e-8
    assert abs(siegel_distance(one, two) - siegel_distance(two, one)) < 1e-10


@pytest.mark.parametrize("epsilon", [1e-3, 1e-8, 1e-12])
def test_distance_of_nearby_points_is_that_of_the_metric(epsilon):
    # ds² = tr(Y⁻¹ dΠ Y⁻¹ dΠ̄), with a step that is exact in floating point.
    rng = np.random.default_rng(7)
    Pi = random_point(3, rng)
    step = epsilon * (lambda A: A + A.T)(rng.standard_normal((3, 3)) * (1 + 0.5j))
    near = Pi + step
    step = near - Pi
    inverse = np.linalg.inv(Pi.imag)
    metric = np.sqrt(np.trace(inverse @ step @ inverse @ step.conj()).real)
    assert abs(siegel_distance(Pi, near) / metric - 1) < 10 * epsilon + 1e-12
    assert siegel_distance(Pi, Pi) == 0.0


@pytest.mark.parametrize("factor", [2.0, 1e4, 1e8, 1e14])
def test_distance_of_far_points(factor):
    diagonal = np.diag([1j, 2j, 3j])
    assert abs(siegel_distance(diagonal, factor * diagonal) / np.log(factor) - 3**0.5) < 1e-8


def test_triangle_inequality_and_hyperbolic_plane():
    rng = np.random.default_rng(5)
    a, b, c = (random_point(4, rng) for _ in range(3))
    assert siegel_distance(a, c) <= siegel_distance(a, b) + siegel_distance(b, c)
    s, t = 0.3 + 0.7j, -1.1 + 2.5j
    hyperbolic = np.arccosh(1 + abs(s - t) ** 2 / (2 * s.imag * t.imag))
    assert abs(siegel_distance([[s]], [[t]]) - hyperbolic) < 1e-12


def test_the_action_is_exact_to_rounding_whatever_its_size():
    # In exact arithmetic: γτ = ((ax + b)(cx + d) + ac y² + iy) / |cτ + d|².
    tau = -0.618033988749895 + 1e-9j
    gamma = np.array([[1134903170, 701408733], [701408733, 433494437]])  # Fibonacci numbers
    a, b, c, d = (int(n) for n in gamma.ravel())
    x, y = Fraction(tau.real), Fraction(tau.imag)
    size = (c * x + d) ** 2 + (c * y) ** 2
    exact = complex(((a * x + b) * (c * x + d) + a * c * y * y) / size, y / size)
    moved = siegel_transform(gamma, [[tau]])[0, 0]
    assert abs(moved - exact) < 2e-16 * abs(exact)
    assert abs(mobius(gamma, np.array([[tau]]))[0, 0] - exact) > 1e-10 * abs(exact)


# --- refusals ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        ([[1j, 0]], r"square.*\(1, 2\)"),
        ([1j], r"square.*\(1,\)"),
        ([[1j, np.nan], [np.nan, 1j]], "2 entries that are not finite"),
        ([[complex(0, np.inf)]], "not finite"),
        ([[1j, 0.5], [0.4, 1j]], "not symmetric.*differ by up to 0.1"),
        ([[-1j]], "not positive definite.*least eigenvalue is -1"),
        ([[1j, 2j], [2j, 1j]], "not positive definite.*least eigenvalue is -1"),
    ],
)
def test_matrices_that_are_no_siegel_points(matrix, message):
    for function in (check_siegel_point, siegel_reduce):
        with pytest.raises(NotASiegelPointError, match=message):
            function(matrix)
    with pytest.raises(NotASiegelPointError, match=message):
        siegel_distance(matrix, matrix)


@pytest.mark.parametrize(
    ("gamma", "message"),
    [
        (np.eye(4, dtype=int), r"shape \(2, 2\), not \(4, 4\)"),
        (0.5 * np.eye(2), "integer entries"),
        (2 * np.eye(2, dtype=int), "not symplectic"),
    ],
)
def test_transformations_that_are_not_modular(gamma, message):
    with pytest.raises(ValueError, match=message):
        siegel_transform(gamma, [[1j]])


def test_different_genus():
    with pytest.raises(ValueError, match="different genus, 1 and 2"):
        siegel_distance([[1j]], np.diag([1j, 1j]))


def test_integers_and_lists_are_accepted():
    Pi = [[1j, 0], [0, 2j]]
    assert np.array_equal(siegel_transform(np.eye(4), Pi), np.array(Pi))
    assert np.array_equal(siegel_transform(np.eye(4, dtype=np.int8), Pi), np.array(Pi))
