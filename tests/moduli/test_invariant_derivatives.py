"""How theta constants and invariants move with Π."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods import genus_two


def random_point(g, seed):
    rng = np.random.default_rng(seed)
    X, M = rng.normal(size=(2, g, g))
    E = rng.normal(size=(g, g)) + 1j * rng.normal(size=(g, g))
    return X + X.T + 1j * (M @ M.T + 0.6 * np.eye(g)), E + E.T


def difference(f, Pi, E, h=1e-4):
    near, far = (f(Pi + t * E) - f(Pi - t * E) for t in (h, 2 * h))
    return (8 * near - far) / (12 * h)


@pytest.mark.parametrize("g", [1, 2, 3])
def test_theta_constants(g):
    Pi, E = random_point(g, g)
    moved = np.einsum("abkl,kl->ab", ip.theta_derivatives(Pi), E)
    assert np.allclose(moved, difference(ip.theta_constants, Pi, E), rtol=0, atol=1e-10)


def test_odd_theta_constants_stay_zero():
    slopes = ip.theta_derivatives(random_point(2, 5)[0])
    odd = [(a, b) for a in range(4) for b in range(4) if (a & b).bit_count() % 2]
    assert max(np.abs(slopes[a, b]).max() for a, b in odd) < 1e-15


def test_ramanujan():
    """j' = −2πi j E₆/E₄; E₄ and E₆ by their series."""
    tau = 0.17 + 0.9j
    q = np.exp(2j * np.pi * tau)
    n = np.arange(1, 60)
    E4 = 1 + 240 * np.sum(n**3 * q**n / (1 - q**n))
    E6 = 1 - 504 * np.sum(n**5.0 * q**n / (1 - q**n))
    expected = -2j * np.pi * ip.j_invariant([[tau]]) * E6 / E4
    assert ip.j_derivative([[tau]]) == pytest.approx(expected, rel=1e-12)


def test_j_in_another_marking():
    """j is invariant, so its derivative is a modular form of weight 2."""
    tau = 0.17 + 0.9j
    moved = (2 * tau + 1) / (3 * tau + 2)
    there = ip.j_derivative([[moved]]) / (3 * tau + 2) ** 2
    assert there == pytest.approx(ip.j_derivative([[tau]]), rel=1e-11)


@pytest.mark.parametrize(
    ("f", "slope"),
    [
        (genus_two.rosenhain_roots, genus_two.rosenhain_derivatives),
        (genus_two.absolute_igusa_invariants, genus_two.igusa_derivatives),
    ],
)
def test_curves_of_genus_two(f, slope):
    Pi, E = random_point(2, 2)
    moved = np.sum(slope(Pi) * E, axis=(1, 2))
    assert np.allclose(moved, difference(f, Pi, E, 1e-3), rtol=1e-5)


def test_products_of_tori_have_no_roots():
    with pytest.raises(ValueError, match="product of two elliptic curves"):
        genus_two.rosenhain_derivatives(1j * np.eye(2))
    with pytest.raises(ValueError, match="genus 1"):
        ip.j_derivative(1j * np.eye(2))
