"""Siegel reduction keeps its promises at every genus."""

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.brute_force_equivalence import mobius
from support.lattice_reduction import assert_lll_reduced, exactly_lll_reduced
from support.modular_words import random_point, random_word

from igl_periods.errors import NotASiegelPointError
from igl_periods.siegel.half_space import (
    check_symplectic,
    siegel_distance,
    siegel_transform,
)
from igl_periods.siegel.reducing_pairs import pairwise_reduction
from igl_periods.siegel.reduction import SIEGEL_GENUS_LIMIT, siegel_reduce
from igl_periods.siegel.reduction_steps import lattice_step
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.symplectic.williamson_form import energy_matrix

cases = st.tuples(st.integers(1, 6), st.integers(0, 2**32 - 1), st.integers(0, 40))


def assert_reduced(Pi: np.ndarray) -> None:
    assert np.array_equal(Pi, Pi.T)
    assert np.abs(Pi.real).max() <= 0.5 + 1e-12
    assert np.abs(np.diag(Pi)).min() >= 1 - 1e-12
    assert_lll_reduced(Pi.imag)


# --- reduction ---------------------------------------------------------------------------------


@settings(max_examples=150, deadline=None)
@given(cases)
def test_reduction_keeps_its_promises(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi = siegel_transform(random_word(g, length, rng), random_point(g, rng))
    matrix, gamma = siegel_reduce(Pi)
    assert_reduced(matrix)
    assert gamma.dtype == np.int64
    J = standard_form(g)
    assert np.array_equal(gamma @ J @ gamma.T, J)
    # The matrix is γ·Π to rounding; by the plain formula, to what conditioning leaves.
    assert np.array_equal(siegel_transform(gamma, Pi), matrix)
    assert siegel_distance(mobius(gamma, Pi), matrix) < 1e-8


@settings(max_examples=50, deadline=None)
@given(cases)
def test_reduction_is_idempotent(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    matrix, _ = siegel_reduce(siegel_transform(random_word(g, length, rng), random_point(g, rng)))
    again, gamma = siegel_reduce(matrix)
    assert np.array_equal(gamma, np.eye(2 * g, dtype=np.int64))
    assert np.array_equal(again, matrix)


@pytest.mark.parametrize("seed", range(20))
def test_first_vector_of_the_reduced_lattice_is_a_shortest_one(seed):
    rng = np.random.default_rng(seed)
    g = 2 + seed % 5
    Y = siegel_reduce(random_point(g, rng)).matrix.imag
    vectors = np.stack(np.meshgrid(*[np.arange(-2, 3)] * g), -1).reshape(-1, g)
    lengths = np.einsum("ni,ij,nj->n", vectors, Y, vectors)
    assert lengths[vectors.any(axis=1)].min() >= Y[0, 0] * (1 - 1e-5)


def test_genus_one_reduces_to_the_fundamental_domain():
    # y² = x³ + 1 has τ = exp(iπ/3); any τ equivalent to it reduces to it or to exp(2iπ/3).
    rho = np.exp(1j * np.pi / 3)
    tau = siegel_transform([[7, 12], [4, 7]], [[rho]])
    matrix, _ = siegel_reduce(tau)
    assert abs(abs(matrix[0, 0].real) - 0.5) < 1e-12
    assert abs(matrix[0, 0].imag - np.sqrt(3) / 2) < 1e-12


def test_genus_zero():
    matrix, gamma = siegel_reduce(np.zeros((0, 0)))
    assert matrix.shape == (0, 0)
    assert gamma.shape == (0, 0)
    assert siegel_distance(np.zeros((0, 0)), np.zeros((0, 0))) == 0.0
    assert siegel_transform(np.zeros((0, 0), dtype=int), np.zeros((0, 0))).shape == (0, 0)


@pytest.mark.parametrize("scale", [1.0, 0.01])
def test_high_genus(scale):
    rng = np.random.default_rng(31)
    A = rng.standard_normal((31, 31))
    Pi = rng.standard_normal((31, 31)) + 1j * (scale * A @ A.T / 31 + 0.3 * np.eye(31))
    Pi = 0.5 * (Pi + Pi.T)
    start = time.process_time()
    matrix, gamma = siegel_reduce(Pi)
    assert time.process_time() - start < 1.0
    assert_reduced(matrix)
    assert np.array_equal(check_symplectic(gamma, 31), gamma)


# --- high genus --------------------------------------------------------------------------------


@pytest.mark.parametrize(("g", "length"), [(17, 100), (45, 200), (72, 200)])
def test_reduction_keeps_its_promises_at_high_genus(g, length):
    rng = np.random.default_rng(g)
    Pi = siegel_transform(random_word(g, length, rng), random_point(g, rng))
    matrix, gamma = siegel_reduce(Pi)
    assert_reduced(matrix)
    assert exactly_lll_reduced(np.eye(g, dtype=int), matrix.imag)
    J = standard_form(g)
    assert np.array_equal(gamma @ J @ gamma.T, J)
    assert np.array_equal(siegel_transform(gamma, Pi), matrix)
    assert np.abs(mobius(gamma, Pi) - matrix).max() < 1e-8
    # A change of marking, so it is an isometry.
    other = siegel_transform(random_word(g, length, rng), random_point(g, rng))
    distance = siegel_distance(Pi, other)
    assert abs(siegel_distance(matrix, siegel_transform(gamma, other)) - distance) < 1e-8 * distance
    # det Y does not fall, and there is nothing left to do.
    assert np.linalg.slogdet(matrix.imag)[1] > np.linalg.slogdet(Pi.imag)[1]
    again, nothing = siegel_reduce(matrix)
    assert np.array_equal(nothing, np.eye(2 * g, dtype=np.int64))
    assert np.array_equal(again, matrix)


def test_the_walk_starts_at_a_pairwise_reduced_point(monkeypatch):
    rng = np.random.default_rng(4)
    Pi = siegel_transform(random_word(30, 100, rng), random_point(30, rng))
    seen = []
    monkeypatch.setattr(
        "igl_periods.siegel.reduction.lattice_step",
        lambda point: seen.append(point) or lattice_step(point),
    )
    siegel_reduce(Pi)
    D = energy_matrix(Pi)
    U = pairwise_reduction(D)
    assert np.trace(energy_matrix(seen[0])) == pytest.approx(np.trace(U @ D @ U.T), rel=1e-9)
    assert np.trace(energy_matrix(seen[0])) < 0.9 * np.trace(D)


def test_symmetric_points_of_high_genus():
    # Real parts of exactly ½ and |Π_jj| = 1 stay as they are.
    g = 50
    Pi = (0.5 + 1j * np.sqrt(3) / 2) * np.eye(g)
    word = random_word(g, 200, np.random.default_rng(1))
    matrix, _ = siegel_reduce(siegel_transform(word, Pi))
    assert_reduced(matrix)
    assert np.linalg.det(matrix.imag) == pytest.approx((np.sqrt(3) / 2) ** g, rel=1e-9)


@pytest.mark.parametrize("heights", [np.logspace(-6, 6, 20), np.logspace(-9, 0, 20)])
def test_nearly_degenerate_points_of_high_genus(heights):
    # Quasi-inversions lose digits here, so points have to be computed anew.
    Pi = np.diag(1j * heights) + 0.123456789
    matrix, gamma = siegel_reduce(Pi)
    assert_reduced(matrix)
    assert np.array_equal(siegel_transform(gamma, Pi), matrix)


def test_very_high_genus_is_reduced_only_when_asked_for():
    with pytest.raises(ValueError, match=rf"has genus {SIEGEL_GENUS_LIMIT + 1}: .* max_genus="):
        siegel_reduce(1j * np.eye(SIEGEL_GENUS_LIMIT + 1))
    Pi = np.diag([1j, 2j, 3j])
    with pytest.raises(ValueError, match=r"up to genus 2 unless .* genus 3: .* max_genus=3 does"):
        siegel_reduce(Pi, max_genus=2)
    assert np.array_equal(siegel_reduce(Pi, max_genus=3).matrix, Pi)


# --- published cases ---------------------------------------------------------------------------


def test_jtem_first_case():
    # jTEM (de.jtem.riemann), unit test of SiegelReduction; its convention is B = 2πi Π.
    B = np.array([[-5.109723656338871 + np.pi * 1j, -4.2419977778105515], [0, 0]])
    B[1] = [-4.2419977778105515, -5.78346380443502 + np.pi * 1j]
    Pi = B / (2j * np.pi)
    stated = np.block(
        [[np.eye(2), np.zeros((2, 2))], [np.array([[-1, 1], [1, -1]]), np.eye(2)]]
    ).astype(int)
    result = 2j * np.pi * siegel_transform(stated, Pi)
    diagonal, off = np.diag(result), result[0, 1]
    assert np.abs(diagonal.real + 8.893837400587667).max() < 1e-10
    assert np.abs(np.abs(diagonal.imag) - 0.878558945495512).max() < 1e-10
    assert abs(off.real + 0.700547044613776) < 1e-10
    assert abs(abs(off.imag) - np.pi) < 1e-10
    # Ours is as good: the same determinant of Im Π, the same shortest vector.
    mine = siegel_reduce(Pi).matrix
    assert_reduced(mine)
    published = (result / (2j * np.pi)).imag
    assert abs(np.linalg.det(mine.imag) / np.linalg.det(published) - 1) < 1e-10
    assert abs(mine.imag[0, 0] / published[0, 0] - 1) < 1e-10


def test_jtem_second_case():
    B = np.array([[-111.207, -96.616], [-96.616, -111.207]])
    stated = np.array([[-1, 1, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 1, 1]])
    result = siegel_transform(stated, B / (2j * np.pi))
    mine = siegel_reduce(B / (2j * np.pi)).matrix
    assert np.abs(np.abs(mine) - np.abs(result)).max() < 1e-12


def test_nbruin_case():
    # Doctest of nbruin/RiemannTheta: the periods (A | B), A⁻¹B, and what it reduces to.
    A = np.array([[1, 3], [0, 1]])
    Pi = np.linalg.solve(A, np.array([[1 + 5j, 12 + 10j], [1j, 4 + 3j]]))
    stated = np.eye(4, dtype=int)
    stated[0, 2], stated[1, 3] = -1, -4
    reduced = np.array([[2j, 1j], [1j, 3j]])
    assert np.abs(siegel_transform(stated, Pi) - reduced).max() < 1e-14
    assert np.abs(siegel_reduce(Pi).matrix - reduced).max() < 1e-14


def test_nearly_degenerate_cases():
    # Stress case of nbruin/RiemannTheta.
    Pi = 1j / (2 * np.pi) * np.array([[111.207, 96.616], [96.616, 83.943]])
    matrix, gamma = siegel_reduce(Pi)
    assert_reduced(matrix)
    assert siegel_distance(mobius(gamma, Pi), matrix) < 1e-8
    # Y of condition 10^16, and a point 10^-12 above a rational one.
    for Pi in (np.diag([1e-8j, 1j, 1e8j]) + 0.123456789, np.array([[0.3 + 1e-12j]])):
        matrix, gamma = siegel_reduce(Pi)
        assert_reduced(matrix)
        assert np.array_equal(siegel_transform(gamma, Pi), matrix)


def test_a_point_beyond_the_integers_is_refused():
    with pytest.raises(
        NotASiegelPointError, match="no 64-bit integers shift back: it is as large from"
    ):
        siegel_reduce([[1e20 + 1j]])
