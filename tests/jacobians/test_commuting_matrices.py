"""Integer matrices that commute with a complex structure."""

import math

import flint
import numpy as np
import pytest
from support.jacobian_points import random_point

from igl_periods.jacobians.commuting_matrices import commuting_matrices, equations
from igl_periods.surfaces.exact_matrices import bolza


def test_the_equations_are_those_of_an_endomorphism():
    """(a + Πc)Π − b − Πd, for one matrix with random entries."""
    Pi = random_point(3, 0)
    M = np.random.default_rng(1).integers(-4, 5, (6, 6))
    values = equations(Pi)
    got = [flint.arb(0)] * 18
    for n, value in zip(M.ravel().tolist(), values, strict=True):
        got = [s + n * x for s, x in zip(got, value, strict=True)]
    a, b, c, d = (
        flint.acb_mat(flint.fmpz_mat(block.tolist()))
        for block in (M[:3, :3], M[:3, 3:], M[3:, :3], M[3:, 3:])
    )
    wanted = (a + Pi * c) * Pi - b - Pi * d
    for k, z in enumerate(wanted.entries()):
        assert got[2 * k].overlaps(z.real)
        assert got[2 * k + 1].overlaps(z.imag)


def test_the_surface_of_bolza_has_eight():
    with flint.ctx.workdps(40):
        found = commuting_matrices(bolza(), 130)
    assert len(found.basis) == 8
    assert repr(found).startswith("CommutingMatrices(rank 8, from 12")
    assert found.left_over > 100
    assert found.excluded > 20


def test_a_random_point_has_only_the_integers():
    with flint.ctx.workdps(60):
        found = commuting_matrices(random_point(2, 5), 160)
    assert len(found.basis) == 1
    assert np.array_equal(np.abs(found.basis[0]), np.eye(4))
    # Proved: no other endomorphism has a norm below this.
    assert 10 < found.excluded < found.random_height + 1


def test_what_is_excluded_is_below_what_chance_gives():
    """With few bits there are small solutions by chance, and none below the stated norm."""
    with flint.ctx.workdps(60):
        Pi = random_point(1, 3)
        found = commuting_matrices(Pi, 30)
        least = math.inf
        tau = complex(Pi[0, 0].mid())
        for a in range(-12, 13):
            for b in range(-12, 13):
                # (a + cτ)τ = b + dτ: c τ² + (a − d)τ − b = 0
                for c in range(1, 13):
                    if abs(c * tau * tau + a * tau - b) < 2.0**-found.bits:
                        least = min(least, math.hypot(a, b, c))
    assert math.log10(least) >= found.excluded if least < math.inf else found.excluded < 6


def test_too_few_digits_are_refused():
    with pytest.raises(ValueError, match="too few to tell endomorphisms"):
        commuting_matrices(random_point(2, 5), 20)
