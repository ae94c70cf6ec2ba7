"""Exact period matrices in balls: they contain what floating point knows, and are small."""

import flint
import numpy as np
import pytest

import igl_periods as ip
from igl_periods.siegel import midpoint
from igl_periods.surfaces.exact_matrices import bring, lawson_integral, root_of_unity
from igl_periods.surfaces.named_surfaces import catalogue

IN_FLOATS_ONLY = {"Wente torus", "Schwarz P and D surfaces and gyroid"}
ENTRIES = [surface for genus in range(1, 7) for surface in catalogue(genus)]


@pytest.mark.parametrize("surface", ENTRIES, ids=lambda surface: surface.name)
def test_balls_are_small_and_in_the_marking_of_the_floats(surface):
    balls = surface.matrix_in_balls(50)
    assert (balls is None) == (surface.name in IN_FLOATS_ONLY)
    if balls is None:
        return
    assert max(float(z.rad()) for z in balls.entries()) < 1e-48
    assert np.abs(midpoint(balls) - surface.matrix).max() < 1e-13
    sharper = surface.matrix_in_balls(90)
    assert balls.overlaps(sharper)
    assert max(float(z.rad()) for z in sharper.entries()) < 1e-88


def test_bring_has_both_moduli():
    with flint.ctx.workprec(400):
        tau = bring()[0, 1]
        assert tau.modular_j().overlaps(flint.acb(-(29**3) * 5) / 2**5)
        assert (5 * tau).modular_j().overlaps(flint.acb(-25) / 2)
        assert float(tau.rad()) < 1e-118


def test_sides_of_lawson_surfaces_by_integration():
    with flint.ctx.workprec(120):
        for a, b, M, n in ((1, 1, 3, 3), (2, 1, 4, 3), (1, 2, 3, 4)):
            by_arb = flint.acb.integral(
                # x = 1 − sⁿ removes the singularity.
                lambda s, _, a=a, b=b, M=M, n=n: _integrand(1 - s**n, s, a, b, M, n),
                0,
                1,
            )
            assert by_arb.real.overlaps(lawson_integral(a, b, M, n))
            assert float(by_arb.rad()) < 1e-20


def _integrand(x, s, a, b, M, n):
    # (1 − x^M) = sⁿ (1 + x + … + x^{M−1}) with 1 − x = sⁿ; dx = n s^{n−1} ds.
    quotient = (1 + x**M) / sum((x**i for i in range(M)), flint.acb(0))
    return (quotient.log() * b / n).exp() * x ** (a - 1) / (1 + x**M) * n * s ** (n - 1 - b)


def test_roots_of_unity():
    from fractions import Fraction

    assert root_of_unity(Fraction(1, 4)).contains(flint.acb(0, 1))
    assert (root_of_unity(Fraction(2, 7)) ** 7).contains(1)


def test_at_least_one_digit():
    with pytest.raises(ValueError, match="at least one is wanted"):
        ip.catalogue(1)[0].matrix_in_balls(0)
