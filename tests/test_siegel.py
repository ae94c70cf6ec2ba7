"""The Siegel upper half-space: action, metric, reduction."""

import time
from fractions import Fraction

import flint
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from modular_words import random_point, random_word

from igl_periods.errors import EnumerationLimitError, NotASiegelPointError
from igl_periods.siegel.enumeration import short_vectors
from igl_periods.siegel.half_space import (
    check_siegel_point,
    check_symplectic,
    siegel_distance,
    siegel_transform,
)
from igl_periods.siegel.lll import is_lll_reduced, lll_basis, shortest_first
from igl_periods.siegel.lll_in_floats import all_swap_lll
from igl_periods.siegel.reducing_pairs import pairwise_reduction
from igl_periods.siegel.reduction import SIEGEL_GENUS_LIMIT, siegel_reduce
from igl_periods.siegel.reduction_steps import inversion_step, lattice_step
from igl_periods.symplectic.canonical_basis import form_action, standard_form
from igl_periods.symplectic.williamson_form import energy_matrix

cases = st.tuples(st.integers(1, 6), st.integers(0, 2**32 - 1), st.integers(0, 40))


def mobius(gamma: np.ndarray, Pi: np.ndarray) -> np.ndarray:
    """The action, by the formula."""
    (a, b), (c, d) = (np.hsplit(half, 2) for half in np.vsplit(gamma, 2))
    return (a @ Pi + b) @ np.linalg.inv(c @ Pi + d)


def assert_lll_reduced(Y: np.ndarray) -> None:
    """By the definition, on the Gram–Schmidt coefficients of the Cholesky factor."""
    R = np.linalg.cholesky(Y)
    mu, height = R / np.diag(R), np.diag(R) ** 2
    assert np.abs(np.tril(mu, -1)).max(initial=0) <= 0.51 + 1e-6
    for i in range(1, len(Y)):
        assert height[i] >= (0.99 - mu[i, i - 1] ** 2) * height[i - 1] * (1 - 1e-6)


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


def exactly_lll_reduced(U: np.ndarray, Y: np.ndarray) -> bool:
    """The definition for U Y Uᵀ, by Gram–Schmidt in ball arithmetic of 200 bits."""
    with flint.ctx.workprec(200):
        basis = flint.arb_mat(U.tolist())
        gram = (basis * flint.arb_mat(Y.tolist()) * basis.transpose()).tolist()
        r, mu = [], []
        for i, row in enumerate(gram):
            r.append([])
            mu.append([])
            for j in range(i + 1):
                r[i].append(row[j] - sum((mu[j][k] * r[i][k] for k in range(j)), flint.arb(0)))
                if j < i:
                    mu[i].append(r[i][j] / r[j][j])
        height = [r[i][i] for i in range(len(Y))]
        lovasz = (height[i] >= (0.99 - mu[i][i - 1] ** 2) * height[i - 1] for i in range(1, len(Y)))
        return all(abs(m) <= 0.51 for row in mu for m in row) and all(lovasz)


@pytest.mark.parametrize("n", [40, 41, 60])
def test_large_lattices_are_reduced_by_the_definition(n):
    rng = np.random.default_rng(n)
    A = rng.standard_normal((n, n)) / np.sqrt(n)
    V = np.eye(n)
    for i, j in rng.integers(n, size=(3 * n, 2)):
        V[i] += rng.integers(-1, 2) * V[j] * (i != j)
    Y = V @ (A @ A.T + 0.1 * np.eye(n)) @ V.T
    U = all_swap_lll(Y)
    assert exactly_lll_reduced(U, Y)
    assert not exactly_lll_reduced(np.eye(n, dtype=int), Y)
    assert abs(int(flint.fmpz_mat(U.tolist()).det())) == 1
    assert np.array_equal(lll_basis(Y), U)
    assert is_lll_reduced(U @ Y @ U.T, 1e-9)
    assert not is_lll_reduced(Y, 1e-9)


def test_forms_too_far_from_round_are_reduced_in_integers():
    # A basis of the lattice of (x, 10^9 x_1 + …): it takes more digits than a double has.
    rng = np.random.default_rng(0)
    n = 40
    row = rng.integers(10**5, 10**6, n).astype(float)
    Y = np.eye(n) + np.outer(row, row)
    assert all_swap_lll(Y) is None
    U = lll_basis(Y)
    assert exactly_lll_reduced(U, Y)


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


@pytest.mark.parametrize("g", [3, 20, 45])
def test_steps_move_points_as_their_transformations_do(g):
    rng = np.random.default_rng(g)
    Pi = siegel_transform(random_word(g, 100, rng), random_point(g, rng))
    for step in (lattice_step(Pi), inversion_step(Pi, g), inversion_step(Pi, 1)):
        assert not step.idle
        assert np.abs(step.point - siegel_transform(step.gamma, Pi)).max() < 1e-9
    # Quasi-inversions raise det Y, and lattice steps keep it.
    before, lattice, inverted = (
        np.linalg.slogdet(point.imag)[1]
        for point in (Pi, lattice_step(Pi).point, inversion_step(Pi, g).point)
    )
    assert abs(lattice - before) < 1e-9
    assert inverted > before + 1e-6


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


@pytest.mark.parametrize(
    ("Y", "reduced"),
    [
        ([[1.0, 0.5], [0.5, 1.2]], True),
        ([[1.0, 0.52], [0.52, 1.5]], False),
        ([[1.0, 0.1], [0.1, 0.9]], False),
        ([[1.0]], True),
    ],
)
def test_definition_of_reduced_bases(Y, reduced):
    assert is_lll_reduced(np.array(Y), 1e-6) is reduced


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
    with pytest.raises(NotASiegelPointError, match="64-bit integers"):
        siegel_reduce([[1e20 + 1j]])


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


# --- lattices ----------------------------------------------------------------------------------


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 5), st.integers(0, 2**32 - 1))
def test_short_vectors_are_all_short_vectors(n, seed):
    rng = np.random.default_rng(seed)
    A = rng.standard_normal((n, n))
    Y = A @ A.T + 0.5 * np.eye(n)
    bound = 3.0
    vectors, values = short_vectors(Y, bound)
    box = np.stack(np.meshgrid(*[np.arange(-3, 4)] * n), -1).reshape(-1, n)  # |x_i| ≤ √(3 / 0.5)
    expected = {tuple(x) for x in box.tolist() if np.array(x) @ Y @ np.array(x) <= bound}
    assert {tuple(x) for x in vectors.tolist()} == expected
    assert len(vectors) == len(expected)
    assert np.abs(values - np.einsum("ni,ij,nj->n", vectors, Y, vectors)).max() < 1e-12
    assert np.all(np.diff(values) >= 0)


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 7), st.integers(0, 2**32 - 1))
def test_lattice_bases(n, seed):
    rng = np.random.default_rng(seed)
    A = rng.integers(-30, 31, (n, n)) + 0.3 * rng.standard_normal((n, n)) + 0.01 * np.eye(n)
    Y = A @ A.T
    for basis in (lll_basis, shortest_first):
        U = basis(Y)
        assert abs(round(np.linalg.det(U))) == 1
        assert_lll_reduced(U @ Y @ U.T)
    shortest = (U @ Y @ U.T)[0, 0]
    assert short_vectors(U @ Y @ U.T, shortest * (1 - 1e-5))[0].any(axis=1).sum() == 0


@pytest.mark.parametrize("Y", [[[1, 3e9], [3e9, 1e61]], [[1, 1e15], [1e15, 1.000000001e30]]])
def test_lattices_far_from_round(Y):
    # Beyond any condition number that eigenvalues could tell from 0.
    U = lll_basis(np.array(Y))
    assert U.tolist() == [[1, 0], [-round(Y[0][1]), 1]]
    matrix, gamma = siegel_reduce(1j * np.array(Y))
    assert gamma[:2, :2].tolist() == U.tolist()
    assert matrix[0, 0] == 1j


@pytest.mark.parametrize(
    ("Y", "message"),
    [
        ([[1, 1 - 1e-15], [1 - 1e-15, 1]], "singular up to rounding"),
        ([[1, 1], [1, 1]], "singular up to rounding"),
        ([[1, 1e25], [1e25, 1e61]], "does not fit into 64-bit integers"),
        ([[1e-200, 0], [0, 1e200]], "does not fit into 64-bit integers"),
    ],
)
def test_lattices_that_are_none(Y, message):
    # In FLINT a form that is not positive definite would end the process.
    with pytest.raises(NotASiegelPointError, match=message):
        lll_basis(np.array(Y))


def test_enumeration_has_a_limit():
    with pytest.raises(
        EnumerationLimitError, match="more than 100 partial vectors at level 2 of 3"
    ):
        short_vectors(np.eye(3), 50.0, limit=100)
