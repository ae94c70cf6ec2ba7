"""The allowance for rounding of the algebra: it covers the true errors."""

import flint
import numpy as np
import pytest
from support import ball_arithmetic
from support.modular_words import random_point, random_word

from igl_periods.periods.rounding import algebraic_allowance, congruence
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.symplectic.williamson_form import energy_matrix, siegel_point, williamson


def test_congruence_reports_lost_digits():
    # Two nearly parallel forms: their difference loses what they have in common.
    D = np.array([[1.0, 1.0 - 1e-8], [1.0 - 1e-8, 1.0]])
    changed, loss = congruence(np.array([[1, -1], [0, 1]]), D)
    assert changed[0, 0] == pytest.approx(2e-8, rel=1e-6)
    assert 1e-9 < loss < 1e-6
    _, kept = congruence(np.eye(2, dtype=int), np.eye(2))
    assert kept < 1e-14


def inverse_positive(n, seed):
    """D with D⁻¹ ≥ 0 entry by entry: the inverse of a positive definite positive matrix."""
    B = np.random.default_rng(seed).uniform(0, 1, (n, n))
    D = np.linalg.inv(B @ B.T + np.eye(n))
    return 0.5 * (D + D.T)


@pytest.mark.parametrize("seed", range(5))
def test_congruence_bounds_the_worst_error_of_entries_and_is_sharp(seed):
    # Errors of 8 ulps of √(D_ii D_jj), all upwards: the worst there are if D⁻¹ is positive.
    D = inverse_positive(8, seed)
    _, loss = congruence(np.eye(8, dtype=int), D)
    ulp = np.finfo(float).eps / 2
    t = np.sqrt(np.diag(D))
    worst = 8 * ulp * float(np.abs(np.linalg.eigvals(np.linalg.solve(D, np.outer(t, t)))).max())
    assert worst < loss < 1.5 * worst
    # No other signs do more, in any basis.
    rng = np.random.default_rng(seed)
    for _ in range(20):
        E = (
            8
            * ulp
            * np.outer(t, t)
            * (lambda S: np.triu(S) + np.triu(S, 1).T)(rng.choice([-1.0, 1.0], (8, 8)))
        )
        assert np.abs(np.linalg.eigvals(np.linalg.solve(D, E))).max() <= worst * (1 + 1e-9)


@pytest.mark.parametrize("largest", [1, 10, 100])
@pytest.mark.parametrize("seed", range(3))
def test_products_are_right_in_their_leading_digits(seed, largest):
    # Against rational arithmetic: half an ulp of each entry, whatever cancels in the sums.
    rng = np.random.default_rng(seed)
    n = 10
    U = np.eye(n, dtype=int)
    U[1:, 0] = rng.integers(-largest, largest + 1, n - 1)
    A = rng.normal(size=(n, n))
    D = A @ A.T + np.eye(n)
    D = 0.5 * (D + D.T)
    changed, loss = congruence(U, D)
    rational = flint.fmpz_mat(U.tolist()) * _rational(D) * flint.fmpz_mat(U.T.tolist())
    error = rational - _rational(changed)
    E = np.array([float(v.p) / float(v.q) for v in error.entries()]).reshape(n, n)
    scale = np.sqrt(np.diag(changed))
    assert np.all(np.abs(E) <= 2.0**-52 * np.outer(scale, scale))
    relative = np.abs(np.linalg.eigvals(np.linalg.solve(changed, E))).max()
    assert relative < loss


def _rational(M):
    return flint.fmpq_mat([[flint.fmpq(*v.as_integer_ratio()) for v in row] for row in M.tolist()])


def test_the_loss_is_the_same_in_every_basis():
    # What rounding did to D counts as in the basis of D, however unlike the new one is.
    rng = np.random.default_rng(2)
    A = rng.normal(size=(30, 30))
    D = A @ A.T / 30 + np.eye(30)
    shear = np.eye(30, dtype=int) + np.diag(np.ones(29, dtype=int), -1)
    _, kept = congruence(np.eye(30, dtype=int), D)
    sheared, loss = congruence(shear, D)
    t = np.abs(shear) @ np.sqrt(np.diag(D))
    in_the_new_basis = t @ np.abs(np.linalg.inv(sheared)) @ t
    # There only the product counts, which is rounded twice: two of the eight ulps of entries of D.
    assert kept < loss <= kept + 2 * np.finfo(float).eps / 2 * in_the_new_basis


@pytest.mark.parametrize("n", [2, 8, 60])
def test_allowance_of_the_algebra_contains_its_norms(n):
    # The skew product Rᵀ J R, in norm, and what inverting D amplifies.
    rng = np.random.default_rng(n)
    R = np.tril(rng.normal(size=(n, n))) + 3 * np.eye(n)
    R[0, 0] *= 1e3
    J = np.abs(standard_form(n // 2))
    skew = np.linalg.norm(np.abs(R).T @ J @ np.abs(R), 2)
    D = R @ R.T
    t = np.sqrt(np.diag(D))
    unit = 4 * n * np.finfo(float).eps / 2
    exact = unit * (skew + t @ np.abs(np.linalg.inv(D)) @ t)
    assert exact * (1 - 1e-9) <= algebraic_allowance(np.linalg.cholesky(D)) <= 1.2 * exact
    assert algebraic_allowance(np.zeros((0, 0))) == 0.0


def extreme_energies(g, seed):
    """A Dirichlet matrix with lengths of cycles from 1e-4 to 1e4, in a far marking."""
    rng = np.random.default_rng(seed)
    scale = np.diag(10.0 ** rng.uniform(-4, 4, g))
    D = energy_matrix(scale @ random_point(g, rng) @ scale)
    R = np.linalg.cholesky(D)
    D = R @ np.diag(np.tile(1 + 10.0 ** -rng.uniform(0, 12, g), 2)) @ R.T
    for length in range(12, 0, -1):
        U = random_word(g, length, rng)
        moved = U @ D @ U.T
        if np.linalg.eigvalsh(moved)[0] > 1e-14 * np.trace(moved):
            return 0.5 * (moved + moved.T)
    return 0.5 * (D + D.T)


@pytest.mark.parametrize("seed", range(40))
def test_allowance_covers_the_error_of_the_symplectic_mean(seed):
    D = extreme_energies(1 + seed % 5, seed)
    Pi = siegel_point(williamson(D)[1])
    assert np.linalg.eigvalsh(Pi.imag)[0] > 0
    assert ball_arithmetic.distance_from_the_mean(D, Pi) <= algebraic_allowance(
        np.linalg.cholesky(D)
    )
