"""Weierstrass equations with a given j."""

from fractions import Fraction

import flint
import pytest

from igl_periods.curves.elliptic_models import (
    minimal_coefficients,
    rational,
    weierstrass_coefficients,
)
from igl_periods.recognition import AlgebraicNumber


def j_of(A, B):
    return 1728 * 4 * A**3 / (4 * A**3 + 27 * B**2)


@pytest.mark.parametrize(
    ("j", "expected"),
    [(287496, (-11, 14)), (54000, (-15, 22)), (8000, (-30, 56)), (-3375, (-35, 98))],
)
def test_complex_multiplication(j, expected):
    A, B = minimal_coefficients(Fraction(j))
    assert j_of(Fraction(A), Fraction(B)) == j
    assert (A, B) == expected


@pytest.mark.parametrize("j", [Fraction(1792), Fraction(-25, 2), Fraction(7, 11)])
def test_rational_j(j):
    A, B = minimal_coefficients(j)
    assert j_of(Fraction(A), Fraction(B)) == j


def test_in_balls():
    flint.ctx.dps = 30
    A, B = weierstrass_coefficients(flint.acb(3, 4))
    assert (j_of(A, B) - flint.acb(3, 4)).contains(0)


def test_rational_numbers():
    assert rational(AlgebraicNumber((-3, 2), 1.5 + 0j)) == Fraction(3, 2)
    assert rational(AlgebraicNumber((-2, 0, 1), 2**0.5 + 0j)) is None
    assert rational(None) is None
