"""Faces unfolded into the plane: sides close, rotations are isometries, orders are found."""

from fractions import Fraction

import flint
import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes import cosine_and_sine
from igl_periods.flat_surfaces.developments import (
    BITS,
    ExactComplex,
    development,
    order_of,
    rational_in,
    turn_share,
)

SURFACES = [
    ip.surfaces.regular_polygon(8),
    ip.surfaces.triangle_unfolding(1, 2, 4),
    ip.surfaces.regular_map_surface("klein"),
    ip.surfaces.origami("(1,2)", "(1,3)", 2),
    ip.DeltaComplex.from_mesh(*ip.surfaces.torus_of_revolution(3, 1, 5, 4)),
]


@pytest.mark.parametrize("K", SURFACES)
def test_sides_close_and_have_their_lengths(K):
    unfolded = development(K)
    with flint.ctx.workprec(BITS):
        v = unfolded.vector_balls()
        for f in range(K.n_faces):
            total = v[3 * f] + v[3 * f + 1] + v[3 * f + 2]
            assert total.real.contains(0)
            assert total.imag.contains(0)
            # Counterclockwise.
            assert (v[3 * f].conjugate() * v[3 * f + 1]).imag > 0
        assert np.allclose([abs(complex(z)) for z in v], K.lengths.ravel(), rtol=1e-12)
        twin = K.twin.ravel()
        for h, t in enumerate(twin.tolist()):
            agree = (v[h] + v[t]).real.contains(0) and (v[h] + v[t]).imag.contains(0)
            left_over = h in unfolded.rotations or t in unfolded.rotations
            assert agree or left_over
    # A spanning tree of the faces.
    assert len(unfolded.rotations) == K.n_edges - K.n_faces + 1


def test_exact_rotations_are_exactly_what_they_are():
    one, i = ExactComplex(Fraction(1), Fraction(0)), ExactComplex(Fraction(0), Fraction(1))
    assert [order_of(z, "exact") for z in (one, -one, i, -i)] == [1, 2, 4, 4]
    assert order_of(ExactComplex(Fraction(3, 5), Fraction(4, 5)), "exact") is None
    # So close to 1 that its angle is the one of a root of unity, to more digits than are looked at.
    n = 10**130
    nearly = ExactComplex(Fraction(n * n - 1, n * n + 1), Fraction(2 * n, n * n + 1))
    assert order_of(nearly, "exact") is None
    c, s = cosine_and_sine(3, 14)
    assert order_of(ExactComplex(c, s), "exact") == 14
    z = ExactComplex(c, s) / ExactComplex(s, c)
    assert z * ExactComplex(s, c) == ExactComplex(c, s)
    assert z + -z == ExactComplex(c - c, c - c)


def test_angles_of_balls():
    with flint.ctx.workprec(BITS):
        for k in range(-5, 7):
            z = flint.acb(flint.fmpq(k, 6)).exp_pi_i()
            found = rational_in(turn_share(z), "balls")
            assert (found - Fraction(k, 12)).denominator == 1
            assert order_of(z, "balls") == Fraction(k, 12).denominator
        assert order_of(flint.acb(3, 4) / 5, "balls") is None
        # Half a turn from both sides of the cut.
        for y in (flint.arb(0, 1e-30), flint.arb(1e-30), flint.arb(-1e-30)):
            share = turn_share(flint.acb(-1, y))
            assert abs(abs(float(share.mid())) - 0.5) < 1e-20
            assert float(share.rad()) < 1e-20
        # What is known badly is not taken for rational.
        assert rational_in(flint.arb(0.5, 0.1), "balls") is None
    assert rational_in(flint.arb(1 / 3 + 1e-12), "floats") == Fraction(1, 3)
    assert rational_in(flint.arb(1 / 3 + 1e-12), "balls") is None


def test_what_cannot_be_unfolded():
    with pytest.raises(ip.ComplexError, match="boundary"):
        development(ip.DeltaComplex.from_lengths([[1, 1, 1]], [[0, 1, 2]]))
