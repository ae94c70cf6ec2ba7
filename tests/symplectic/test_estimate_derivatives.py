"""Derivatives of the symplectic mean, and of the estimates of the paper."""

import numpy as np
import pytest

from igl_periods.symplectic import energy_matrix, estimate_derivative, siegel_point, williamson

ESTIMATES = ("matrix", "primal", "dual", "mean")


def estimate(D, name):
    """The estimates by their definitions."""
    if name == "matrix":
        return siegel_point(williamson(D)[1])
    g = len(D) // 2
    aa, ab, inverse = D[:g, :g], D[:g, g:], np.linalg.inv(D[g:, g:])
    primal = -ab @ inverse + 1j * inverse
    dual = -inverse @ ab.T + 1j * (aa - ab @ inverse @ ab.T)
    return {"primal": primal, "dual": dual, "mean": 0.5 * (primal + dual)}[name]


def random_energies(g, seed):
    rng = np.random.default_rng(seed)
    M, dD = rng.normal(size=(2, 2 * g, 2 * g))
    W = rng.normal(size=(g, g)) + 1j * rng.normal(size=(g, g))
    return M @ M.T + np.eye(2 * g), dD + dD.T, W


@pytest.mark.parametrize("name", ESTIMATES)
@pytest.mark.parametrize("g", [1, 2, 3, 5])
def test_derivatives_are_limits_of_differences(g, name):
    D, dD, _ = random_energies(g, g)
    forward = estimate_derivative(D, name).forward(dD)
    h = 1e-4
    ahead, back = (estimate(D + t * dD, name) - estimate(D - t * dD, name) for t in (h, 2 * h))
    difference = (8 * ahead - back) / (12 * h)
    assert np.abs(forward - difference).max() < 1e-9 * np.abs(forward).max()


@pytest.mark.parametrize("name", ESTIMATES)
@pytest.mark.parametrize("g", [1, 2, 3, 5])
def test_backward_is_the_transpose_of_forward(g, name):
    D, dD, W = random_energies(g, 10 + g)
    derivative = estimate_derivative(D, name)
    S = derivative.backward(W)
    assert np.array_equal(S, S.T)
    there = np.sum(W.conj() * derivative.forward(dD)).real
    assert np.sum(S * dD) == pytest.approx(there, rel=1e-11)


def test_all_symplectic_eigenvalues_equal():
    """At an exact D, where all d are 1, tangents of exact matrices go through unchanged."""
    Pi = np.array([[0.3 + 1.2j, 0.1 - 0.2j], [0.1 - 0.2j, -0.4 + 0.9j]])
    dPi = np.array([[0.5 - 0.3j, 0.2j], [0.2j, 1.0 + 0.7j]])
    h = 1e-5
    dD = (energy_matrix(Pi + h * dPi) - energy_matrix(Pi - h * dPi)) / (2 * h)
    for name in ESTIMATES:
        moved = estimate_derivative(energy_matrix(Pi), name).forward(dD)
        assert np.abs(moved - dPi).max() < 1e-9


def test_scaling_of_energies_does_not_move_the_mean():
    D, _, _ = random_energies(3, 5)
    assert np.abs(estimate_derivative(D).forward(D)).max() < 1e-13


def test_unknown_estimates_are_refused():
    with pytest.raises(ValueError, match='estimate must be "matrix", "primal"'):
        estimate_derivative(np.eye(2), "median")
