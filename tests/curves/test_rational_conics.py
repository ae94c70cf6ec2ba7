"""Rational points of conics, and proofs that there are none."""

import random
from fractions import Fraction

import pytest

from igl_periods.curves.rational_conics import (
    UndecidedConicError,
    parametrization,
    rational_point,
)


def diagonal(*entries):
    return [[Fraction(entries[i] * (i == j)) for j in range(3)] for i in range(3)]


def value(conic, x):
    return sum(x[i] * conic[i][j] * x[j] for i in range(3) for j in range(3))


def with_point(point, rng):
    """A random conic through a point."""
    M = [[Fraction(rng.randint(-30, 30)) for _ in range(3)] for _ in range(3)]
    conic = [[M[i][j] + M[j][i] for j in range(3)] for i in range(3)]
    conic[0][0] -= value(conic, point) / point[0] ** 2
    return conic


def test_conics_through_known_points_have_points():
    rng = random.Random(1)
    for _ in range(40):
        known = [Fraction(rng.randint(1, 20)), *(Fraction(rng.randint(-20, 20)) for _ in "yz")]
        conic = with_point(known, rng)
        point = rational_point(conic)
        assert any(point)
        assert value(conic, point) == 0
        forms = parametrization(conic, point)
        for t in (Fraction(2), Fraction(-1, 3)):
            x = [sum(c * t**k for k, c in enumerate(form)) for form in forms]
            assert value(conic, x) == 0
            assert any(x)


@pytest.mark.parametrize(
    ("entries", "obstruction"),
    [
        ((1, 1, 1), "the real numbers"),
        ((1, 1, -3), "modulo 3"),
        ((1, -2, 5), "modulo 5"),
        ((2, 3, -15), "modulo 5 or 3"),
    ],
)
def test_no_points(entries, obstruction):
    assert rational_point(diagonal(*entries)) is None


def test_hasse_a_form_over_primes_that_has_a_point():
    conic = diagonal(7, -3, -4 * 7)
    point = rational_point(conic)
    assert (value(conic, point), any(point)) == (0, True)


def test_refused():
    with pytest.raises(ValueError, match="degenerate"):
        rational_point(diagonal(1, -1, 0))
    hard = (2**521 - 1) * (2**607 - 1)
    with pytest.raises(UndecidedConicError, match="not factored"):
        rational_point(diagonal(1, 1, -hard))
