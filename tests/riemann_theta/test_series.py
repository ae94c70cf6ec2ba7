"""The series against FLINT's theta function, and what it obeys."""

import flint
import numpy as np
import pytest
from support.points_in_balls import with_radius

from igl_periods.errors import EnumerationLimitError, NotASiegelPointError
from igl_periods.riemann_theta import spin_structures, theta_series

PI = [
    [0.2 + 1.1j, 0.3 - 0.2j, 0.1j],
    [0.3 - 0.2j, -0.1 + 1.4j, 0.2],
    [0.1j, 0.2, 0.4 + 1.2j],
]
Z = [0.3 + 0.4j, -0.2 + 0.1j, 0.7 - 0.6j]


def point(g):
    return flint.acb_mat([row[:g] for row in PI[:g]]), flint.acb_mat([[z] for z in Z[:g]])


@pytest.mark.parametrize("g", [1, 2, 3])
def test_values_are_those_of_flint(g):
    flint.ctx.prec = 150
    Pi, z = point(g)
    for spin, value in zip(spin_structures(g), Pi.theta(z).entries(), strict=True):
        mine = theta_series(Pi, z, list(spin.a), list(spin.b))[()]
        assert mine.overlaps(value)
        assert mine.rel_accuracy_bits() > 130


@pytest.mark.skipif(not hasattr(flint.acb_mat, "theta_jets"), reason="python-flint before 0.9")
@pytest.mark.parametrize("g", [1, 2])
def test_derivatives_are_those_of_flint(g):
    flint.ctx.prec = 150
    Pi, z = point(g)
    jets = Pi.theta_jets(z, 2)
    for row, spin in enumerate(spin_structures(g)):
        first = theta_series(Pi, z, list(spin.a), list(spin.b), 1)
        second = theta_series(Pi, z, list(spin.a), list(spin.b), 2)
        assert all(first[(i,)].overlaps(jets[row, 1 + i]) for i in range(g))
        assert (second[0, 0] / 2).overlaps(jets[row, 1 + g])


def test_heat_equation_by_a_difference_of_the_matrix():
    """4πi ∂θ/∂Π_11 = ∂²θ/∂z_1², to the order of a central difference."""
    flint.ctx.prec = 200
    Pi, z = point(2)
    h = flint.arb(2) ** -40
    up, down = (
        flint.acb_mat([[Pi[0, 0] + s * h, Pi[0, 1]], [Pi[1, 0], Pi[1, 1]]]) for s in (1, -1)
    )
    slope = theta_series(up, z, [1, 0], [0, 1])[()] - theta_series(down, z, [1, 0], [0, 1])[()]
    heat = slope / (2 * h) * flint.acb(0, 4) * flint.arb.pi()
    second = theta_series(Pi, z, [1, 0], [0, 1], 2)[0, 0]
    assert float(abs(heat - second).upper()) < 1e-20


def test_integers_added_to_the_characteristic_change_the_sign_only():
    Pi, z = point(2)
    plain = theta_series(Pi, z, [1, 0], [1, 0])[()]
    assert theta_series(Pi, z, [3, -2], [1, 0])[()].overlaps(plain)
    assert theta_series(Pi, z, [1, 0], [3, 0])[()].overlaps(-plain)


def test_balls_contain_the_values_of_all_matrices_in_them():
    flint.ctx.prec = 100
    Pi, z = point(2)
    around = theta_series(with_radius(np.array(PI)[:2, :2], 12), z, [0, 1], [1, 1], 1)
    inside = theta_series(Pi, z, [0, 1], [1, 1], 1)
    assert all(around[k].contains(inside[k]) for k in inside)


def test_wide_balls_take_more_terms():
    Pi, z = point(2)
    wide = theta_series(with_radius(np.array(PI)[:2, :2], 2), z, [0, 0], [0, 0])[()]
    assert wide.contains(theta_series(Pi, z, [0, 0], [0, 0])[()])
    assert float(wide.rad()) < 1.0


def test_refused():
    z = flint.acb_mat(2, 1)
    flat = flint.acb_mat([[1j, 2j], [2j, 1j]])
    with pytest.raises(NotASiegelPointError, match="positive definite"):
        theta_series(flat, z, [0, 0], [0, 0])
    tiny = flint.acb_mat([[1e-12j, 0], [0, 1e-12j]])
    with pytest.raises(EnumerationLimitError, match="partial vectors"):
        theta_series(tiny, z, [0, 0], [0, 0])
