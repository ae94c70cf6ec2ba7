"""How far a period matrix can be off, where the exact one is known."""

import flint
import numpy as np
import pytest
from flint import arb, arb_mat
from support.modular_words import random_point

from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.proofs.midpoint_radius import Balls
from igl_periods.proofs.siegel_radius import (
    energy_balls,
    largest_eigenvalue,
    relative_radius,
)
from igl_periods.symplectic import siegel_point, williamson


def energies(Pi, excess=None):
    """The Dirichlet matrix of Π, exactly, and something positive semidefinite."""
    X, Y = arb_mat(Pi.real.tolist()), arb_mat(Pi.imag.tolist())
    inverse = Y.inv()
    XY = X * inverse
    top = [a + b for a, b in zip((Y + XY * X).table(), (XY * arb(-1)).table(), strict=True)]
    low = [a + b for a, b in zip((XY.transpose() * arb(-1)).table(), inverse.table(), strict=True)]
    D = arb_mat(top + low)
    return D if excess is None else D + arb_mat((excess @ excess.T).tolist())


def true_error(Pi, other):
    """‖Y^{-1/2} (Π − Π′) Y^{-1/2}‖₂, Y of Π."""
    L = np.linalg.cholesky(Pi.imag)
    half = np.linalg.solve(L, Pi - other)
    return np.linalg.norm(np.linalg.solve(L, half.T), 2)


@pytest.fixture(autouse=True)
def precision():
    with flint.ctx.workprec(300):
        yield


@pytest.mark.parametrize("seed", range(20))
def test_the_exact_matrix_has_radius_zero_nearly(seed):
    Pi = random_point(1 + seed % 4, np.random.default_rng(seed))
    radius = relative_radius(energies(Pi), Pi.real, Pi.imag)
    # What is left is the floating-point factor of Y.
    assert 0 <= radius < 1e-13


@pytest.mark.parametrize("seed", range(60))
def test_the_radius_covers_the_error_of_any_matrix(seed):
    # Any Π̃ whatever, from the symplectic mean to nonsense, and any energies above the exact ones.
    rng = np.random.default_rng(seed)
    g = 1 + seed % 4
    Pi = random_point(g, rng)
    excess = 10.0 ** rng.uniform(-7, 0.5) * rng.normal(size=(2 * g, 2 * g))
    D = energies(Pi, excess)
    floats = np.array([[float(x) for x in row] for row in D.table()])
    mean = siegel_point(williamson(0.5 * (floats + floats.T))[1])
    change = 10.0 ** rng.uniform(-10, -1) * rng.normal(size=(2, g, g))
    moved = mean + (change + change.transpose(0, 2, 1)).T @ np.array([1, 1j])
    for other in (mean, moved if np.linalg.eigvalsh(moved.imag)[0] > 0 else mean):
        X, Y = (0.5 * (part + part.T) for part in (other.real, other.imag))
        radius = float(relative_radius(D, X, Y))
        assert true_error(X + 1j * Y, Pi) <= radius * (1 + 1e-12) + 1e-14


@pytest.mark.parametrize("seed", range(10))
def test_of_the_symplectic_mean_it_is_the_bound(seed):
    # The largest symplectic eigenvalue minus 1, by the other route.
    rng = np.random.default_rng(seed)
    g = 1 + seed % 4
    Pi = random_point(g, rng)
    D = energies(Pi, 0.1 * rng.normal(size=(2 * g, 2 * g)))
    floats = np.array([[float(x) for x in row] for row in D.table()])
    d, G = williamson(0.5 * (floats + floats.T))
    mean = siegel_point(G)
    radius = float(relative_radius(D, mean.real, 0.5 * (mean.imag + mean.imag.T)))
    assert radius == pytest.approx(d[0] - 1, rel=1e-9)


def test_digits_are_not_limited_by_floating_point():
    # Y = 2² and X = 1/2: everything is exact, and energies are off by 1e-60.
    D = energies(np.array([[0.5 + 4j]])) * (1 + arb("1e-60"))
    radius = relative_radius(D, [[0.5]], [[4.0]])
    assert arb("1e-60") <= radius.upper() < arb("1.001e-60")
    blurred = arb_mat([[arb(x.mid(), arb("1e-70")) for x in row] for row in D.table()])
    assert arb("1e-60") < relative_radius(blurred, [[0.5]], [[4.0]]) < arb("1.001e-60")


def test_radii_of_energies_count_in_full():
    # Every matrix within the radii is covered, the worst one is nearly met.
    Pi = random_point(2, np.random.default_rng(1))
    D, r = energies(Pi), 1e-6
    blurred = arb_mat([[arb(x.mid(), r) for x in row] for row in D.table()])
    radius = float(relative_radius(blurred, Pi.real, Pi.imag))
    worst = 0.0
    for signs in np.random.default_rng(2).choice([-1.0, 1.0], (200, 4, 4)):
        change = r * (np.triu(signs) + np.triu(signs, 1).T)
        worst = max(worst, float(relative_radius(D + arb_mat(change.tolist()), Pi.real, Pi.imag)))
    assert worst <= radius < 3 * worst


def test_another_basis_changes_nothing():
    rng = np.random.default_rng(3)
    Pi = random_point(3, rng)
    D = energies(Pi, 0.01 * rng.normal(size=(6, 6)))
    W = arb_mat((rng.normal(size=(6, 6)) + 3 * np.eye(6)).tolist())
    one = relative_radius(D, Pi.real, Pi.imag)
    other = relative_radius(W * D * W.transpose(), Pi.real, Pi.imag, W.inv())
    assert abs(one - other) < 1e-60


@pytest.mark.parametrize("seed", range(10))
def test_largest_eigenvalues_are_bounded_sharply(seed):
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(7, 7)) * 10.0 ** rng.uniform(-30, 30)
    A = A + A.T
    bound = float(largest_eigenvalue(arb_mat(A.tolist())))
    assert bound == pytest.approx(np.linalg.eigvalsh(A)[-1], rel=1e-12)
    # E ≤ bound, proved by its Cholesky factor.
    rest = arb_mat((bound * (1 + 1e-14) * np.eye(7) - A).tolist())
    for n in range(1, 8):
        assert arb_mat([row[:n] for row in rest.table()[:n]]).det() > 0
    assert largest_eigenvalue(arb_mat((-np.eye(3)).tolist())) == 0
    assert largest_eigenvalue(arb_mat(3, 3)) == 0


def test_what_is_not_known_has_radius_infinity():
    unknown = energy_balls(Balls(np.eye(2), np.array([[np.inf, 0.0], [0.0, 0.0]])))
    assert not relative_radius(unknown, [[0.0]], [[1.0]]).is_finite()
    assert not largest_eigenvalue(unknown).is_finite()
    undefined = arb_mat([[arb.nan(), 0], [0, 1]])
    assert not relative_radius(undefined, [[0.0]], [[1.0]]).is_finite()


def test_an_empty_matrix_is_known():
    assert relative_radius(arb_mat(0, 0), np.zeros((0, 0)), np.zeros((0, 0))) == 0


def test_matrices_that_are_no_points_are_refused():
    D = arb_mat(np.eye(4).tolist())
    with pytest.raises(ValueError, match="exactly symmetric"):
        relative_radius(D, [[0.0, 1e-300], [0.0, 0.0]], np.eye(2))
    with pytest.raises(NotPositiveDefiniteError, match="not positive definite"):
        relative_radius(D, np.zeros((2, 2)), np.diag([1.0, -1.0]))


def test_balls_are_handed_to_flint_as_they_are():
    balls = Balls(np.array([[1.0, 0.1], [0.1, 2.0]]), np.array([[1e-20, 0.0], [0.0, 0.5]]))
    table = energy_balls(balls).table()
    assert table[0][1] == arb(0.1)
    assert table[1][1].contains(arb(2.5))
    assert not table[1][1].contains(arb(2.6))
    assert table[0][0].contains(1 + arb("1e-20"))
