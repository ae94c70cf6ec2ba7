"""Williamson's form, the symplectic mean, the sharp inequality."""

import numpy as np
import pytest
import scipy.linalg
from support.surfaces_with_bounds import SURFACES, harmonic

from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.symplectic.williamson_form import (
    _singular_pairs,
    cholesky_factor,
    energy_matrix,
    siegel_point,
    williamson,
    williamson_basis,
)


@pytest.mark.parametrize("surface", SURFACES)
def test_williamson_basis(surface):
    *_, D = harmonic(surface())
    g, d = len(D) // 2, williamson(D)[0]
    T = williamson_basis(cholesky_factor(D)).swapaxes(0, 1).reshape(2 * g, 2 * g)
    np.testing.assert_allclose(T @ standard_form(g) @ T.T, standard_form(g), atol=1e-12)
    np.testing.assert_allclose(T @ D @ T.T, np.diag(np.r_[d, d]), atol=1e-12)


def random_period_matrix(g, rng):
    A, B = rng.normal(size=(2, g, g))
    return A + A.T + 1j * (B @ B.T + 0.3 * np.eye(g))


def random_energy(g, rng, spread=1.0):
    """A positive definite matrix with known Williamson form: (D, d, G)."""
    T = scipy.linalg.cholesky(energy_matrix(random_period_matrix(g, rng)))
    d = np.sort(np.exp(spread * rng.uniform(0, 1, g)))[::-1]
    S = _symplectic_square_root(T.T @ T)
    return S @ np.diag(np.r_[d, d]) @ S, d, S @ S


def _symplectic_square_root(G):
    # The root of a symplectic positive definite matrix is symplectic and symmetric.
    return np.real(scipy.linalg.sqrtm(G))


@pytest.mark.parametrize("spread", [0.0, 1e-6, 1.0, 12.0])
@pytest.mark.parametrize("g", [1, 2, 3, 6, 12])
def test_williamson(g, spread):
    rng = np.random.default_rng(g)
    D, d, G = random_energy(g, rng, spread)
    computed, mean = williamson(D)
    condition = np.linalg.cond(G)
    np.testing.assert_allclose(computed, d, rtol=1e-14 * condition * d[0])
    np.testing.assert_allclose(mean, G, atol=1e-14 * condition * d[0] * np.abs(G).max())
    moduli = np.sort(np.abs(np.linalg.eigvals(standard_form(g) @ D)))[::-2]
    np.testing.assert_allclose(computed, moduli, rtol=1e-12 * condition * d[0])


def test_symplectic_mean_is_the_geometric_mean():
    # The only positive definite solution of G D⁻¹ G = J D⁻¹ Jᵀ, up to order of the two.
    rng = np.random.default_rng(1)
    D, _, _ = random_energy(3, rng)
    J = standard_form(3)
    _, G = williamson(D)
    np.testing.assert_allclose(G @ np.linalg.inv(D) @ G, J @ np.linalg.inv(D) @ J.T, atol=1e-9)
    np.testing.assert_allclose(G @ J @ G, J, atol=1e-11)


@pytest.mark.parametrize("g", [1, 2, 5])
def test_period_matrices_are_symplectic_energies(g):
    Pi = random_period_matrix(g, np.random.default_rng(g))
    D, J = energy_matrix(Pi), standard_form(g)
    np.testing.assert_allclose(D @ J @ D, J, atol=1e-10 * np.abs(D).max())
    np.testing.assert_allclose(siegel_point(D), Pi, atol=1e-11 * np.abs(D).max())


def test_the_bound_of_the_symplectic_mean_holds_and_is_sharp():
    # D_exact symplectic with J D⁻¹ Jᵀ ≤ D_exact ≤ D: then ‖Y^-½ (Π_exact − Π) Y^-½‖ ≤ d − 1.
    rng = np.random.default_rng(0)
    worst = 0.0
    for _ in range(2000):
        g = int(rng.integers(1, 4))
        d = 1.0 + 10.0 ** rng.uniform(-3, 0.5)
        # Symplectic matrices between 1/d and d: exponentials of Hamiltonian symmetric ones.
        P, Q = rng.normal(size=(2, g, g))
        H = np.block([[P + P.T, Q + Q.T], [Q + Q.T, -P - P.T]])
        H *= np.log(d) / np.linalg.norm(H, 2) * rng.choice([1.0, rng.uniform()])
        exact = siegel_point(scipy.linalg.expm(H))
        off = np.linalg.norm(exact - 1j * np.eye(g), 2)
        assert off <= (d - 1) * (1 + 1e-9)
        worst = max(worst, off / (d - 1))
    assert worst > 0.99


@pytest.mark.parametrize("g", [10, 30, 90])
def test_vectors_of_equal_singular_values_are_orthonormal(g):
    # All values are 1 for an exact D: the hardest case.
    R = np.linalg.cholesky(energy_matrix(random_period_matrix(g, np.random.default_rng(g))))
    A = R.T @ standard_form(g) @ R
    d, Q = _singular_pairs(0.5 * (A - A.T))
    np.testing.assert_allclose(Q.T @ Q, np.eye(2 * g), rtol=0, atol=2e-14)
    assert d.shape == (2 * g,)


def test_matrices_that_are_not_positive_definite():
    with pytest.raises(
        NotPositiveDefiniteError, match=r"not positive definite \(least eigenvalue -1"
    ):
        williamson(np.diag([1.0, -1.0]))


def test_empty():
    d, G = williamson(np.zeros((0, 0)))
    assert (d.shape, G.shape) == ((0,), (0, 0))
