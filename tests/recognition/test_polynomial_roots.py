"""Roots of integer polynomials in balls."""

from fractions import Fraction

import flint
import pytest

from igl_periods.recognition import (
    integer_polynomial,
    isolated_roots,
    polynomial_text,
    root_near,
)


def test_real_roots_are_real_exactly_and_the_others_come_in_pairs():
    roots = isolated_roots([-2, 0, 0, 1], 200)
    assert [root.imag == 0 for root in roots].count(True) == 1
    total = sum(roots, flint.acb(0))
    assert total.contains(0)


@pytest.mark.parametrize("bits", [64, 300, 1000])
def test_a_root_to_any_precision(bits):
    root = root_near([-2, 0, 1], -1.4, bits)
    with flint.ctx.workprec(bits):
        assert root.overlaps(flint.acb(-flint.arb(2).sqrt()))
        assert (root**2).contains(2)
        assert root.rel_accuracy_bits() > bits - 16


def test_polynomials_without_a_common_divisor():
    assert integer_polynomial([Fraction(3, 2), Fraction(-9, 4)]) == (-2, 3)
    assert integer_polynomial([6, 0, 2]) == (3, 0, 1)


def test_polynomials_as_text():
    assert polynomial_text([0, -1, 1]) == "x^2 - x"
    assert polynomial_text([1]) == "1"
    assert polynomial_text([0]) == "0"
