"""Roots and logarithms across the negative real axis."""

import flint
import pytest

from igl_periods.curves.ball_roots import logarithm, root


@pytest.mark.parametrize("n", [2, 3, 5])
@pytest.mark.parametrize("centre", [-2.0, 2.0, 1j, -1j, -1 + 1e-20j])
def test_roots_stay_small_balls(n, centre):
    z = flint.acb(centre) + flint.acb(flint.arb(0, 1e-14), flint.arb(0, 1e-14))
    found = root(z, n)
    assert (found**n).overlaps(z)
    assert float(found.rad()) < 1e-12


@pytest.mark.parametrize("centre", [-2.0, 2.0, -1 - 1e-20j])
def test_logarithms_stay_small_balls(centre):
    z = flint.acb(centre) + flint.acb(flint.arb(0, 1e-14), flint.arb(0, 1e-14))
    found = logarithm(z)
    assert found.exp().overlaps(z)
    assert float(found.rad()) < 1e-12
