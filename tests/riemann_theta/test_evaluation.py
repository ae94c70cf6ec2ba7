"""θ of points in balls and in floating point."""

import flint
import numpy as np
import pytest

from igl_periods import NotASiegelPointError, SpinStructure, theta, theta_constants

PI = np.array([[0.2 + 1.1j, 0.3 - 0.2j], [0.3 - 0.2j, -0.1 + 1.4j]])
Z = np.array([0.3 + 0.4j, -0.2 + 0.1j])


def test_constants_are_those_of_all_characteristics():
    table = theta_constants(PI)
    for a in range(4):
        for b in range(4):
            spin = SpinStructure((a >> 1, a & 1), (b >> 1, b & 1))
            assert abs(theta(PI, 0, spin) - table[a, b]) < 1e-13


def test_quasi_periods():
    """θ(z + e_1) = θ(z), θ(z + Πe_1) = exp(−πi(Π_11 + 2 z_1)) θ(z)."""
    value = theta(PI, Z)
    assert abs(theta(PI, Z + np.array([1, 0])) - value) < 1e-13
    factor = np.exp(-1j * np.pi * (PI[0, 0] + 2 * Z[0]))
    assert abs(theta(PI, Z + PI[:, 0]) - factor * value) < 1e-12 * abs(factor)


def test_derivatives_of_floats_are_arrays():
    step = 1e-4
    for order in (1, 2, 3):
        slopes = theta(PI, Z, derivatives=order)
        assert slopes.shape == (2,) * order
        lower = [theta(PI, Z + s * np.array([step, 0]), derivatives=order - 1) for s in (1, -1)]
        difference = (lower[0] - lower[1]) / (2 * step)
        assert np.abs(slopes[0] - difference).max() < 1e-4 * np.abs(slopes).max()


def test_in_balls_shapes_and_values_follow_the_precision():
    flint.ctx.prec = 160
    balls = flint.acb_mat(PI.tolist())
    assert theta(balls).rel_accuracy_bits() > 140
    gradient = theta(balls, Z.tolist(), ([1, 0], [0, 0]), derivatives=1)
    assert (gradient.nrows(), gradient.ncols()) == (2, 1)
    hessian = theta(balls, flint.acb_mat([[z] for z in Z.tolist()]), derivatives=2)
    assert (hessian.nrows(), hessian.ncols()) == (2, 2)
    assert len(theta(balls, 0, derivatives=3)) == 2
    numbers = theta(PI, Z, ([1, 0], [0, 0]), derivatives=1)
    assert all(abs(complex(gradient[i, 0]) - numbers[i]) < 1e-13 for i in range(2))


def test_odd_ones_vanish_and_have_a_gradient():
    spin = SpinStructure((1, 0), (1, 0))
    flint.ctx.prec = 120
    balls = flint.acb_mat(PI.tolist())
    assert theta(balls, 0, spin).contains(0)
    assert not theta(balls, 0, spin, derivatives=1)[0, 0].contains(0)


def test_refused():
    with pytest.raises(NotASiegelPointError, match="square"):
        theta(np.ones((2, 3)))
    with pytest.raises(ValueError, match=r"point of C\^2"):
        theta(PI, [1.0])
    with pytest.raises(ValueError, match="orders 0 to 4"):
        theta(PI, derivatives=5)
