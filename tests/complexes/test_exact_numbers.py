"""Rational, algebraic and computable numbers."""

import pickle
from fractions import Fraction

import flint
import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes.exact_numbers import (
    ComputedNumber,
    ball_of,
    computed,
    computed_sum,
    cosine_and_sine,
    in_one_field,
    root_of_number,
    sign_of,
)

CUBE_ROOT = ip.algebraic_number([-2, 0, 0, 1], 1.26)


def test_roots_satisfy_their_polynomials_exactly():
    x = CUBE_ROOT
    assert x * x * x == 2
    assert x * x != 2
    # Reducible: the factor with the root next to 0.5 is taken, 2 x − 1.
    half = ip.algebraic_number([1, -2, -2, 4], 0.55)
    assert half == Fraction(1, 2)
    assert ip.algebraic_number([-2, 0, 1], -1.0) == -ip.algebraic_number([2, 0, -1], -1.0) * -1


@pytest.mark.parametrize("seed", range(5))
def test_the_axioms_of_a_field(seed):
    rng = np.random.default_rng(seed)
    field = CUBE_ROOT.field
    x, y, z = (
        field.element(*(Fraction(int(c), 7) for c in rng.integers(-9, 10, 3))) for _ in "xyz"
    )
    assert (x + y) * z == x * z + y * z
    assert x * (y * z) == (x * y) * z
    assert x - x == 0
    assert (x / z) * z == x
    assert (1 / z) * z == 1
    assert 2 - x == -(x - 2)
    assert 3 * x == x + x + x
    with flint.ctx.workprec(300):
        assert (x * y).ball(300).overlaps(x.ball(300) * y.ball(300))
    assert float(x * y) == pytest.approx(float(x) * float(y), rel=1e-12)


def test_signs_are_decided_however_close_to_zero():
    root = ip.algebraic_number([-2, 0, 1], 1.4)
    # Convergents of √2: p² − 2q² = ±1.
    p, q = 1, 1
    for _ in range(120):
        p, q = p + 2 * q, p + q
    difference = root - Fraction(p, q)
    assert abs(float(difference)) < 1e-90
    assert difference.sign() == (1 if 2 * q * q > p * p else -1)
    assert (root * root - 2).sign() == 0
    assert [sign_of(x) for x in (Fraction(-1, 3), Fraction(0), flint.arb(0, 1), flint.arb(2))] == [
        -1, 0, 0, 1,
    ]  # fmt: skip


@pytest.mark.parametrize("n", [3, 4, 5, 7, 8, 12, 30])
def test_cosines_and_sines(n):
    for k in range(-n, 2 * n):
        c, s = cosine_and_sine(k, n)
        assert c * c + s * s == 1
        with flint.ctx.workprec(200):
            turn = flint.fmpq(2 * k, n)
            assert c.ball(200).overlaps(flint.arb.cos_pi_fmpq(turn))
            assert s.ball(200).overlaps(flint.arb.sin_pi_fmpq(turn))


def test_texts_of_quadratic_numbers():
    golden = ip.algebraic_number([-1, -1, 1], 1.6)
    assert [repr(x) for x in (golden, -golden, golden - Fraction(1, 2), golden - golden + 3)] == [
        "1/2 + 1/2 √5", "-1/2 - 1/2 √5", "1/2 √5", "3",
    ]  # fmt: skip
    # 12 = 3 · 2², a leading coefficient below 0, both roots.
    assert repr(ip.algebraic_number([12, 0, -1], 3.0)) == "2 √3"
    assert repr(ip.algebraic_number([12, 0, -1], -3.0)) == "-2 √3"
    assert repr(CUBE_ROOT) == "1.25992104989487 (degree 3)"


def test_numbers_are_values():
    again = pickle.loads(pickle.dumps(CUBE_ROOT))
    assert again == CUBE_ROOT
    assert hash(again) == hash(CUBE_ROOT)
    assert hash(CUBE_ROOT * 0 + Fraction(1, 3)) == hash(Fraction(1, 3))
    assert in_one_field([CUBE_ROOT, Fraction(1), CUBE_ROOT * CUBE_ROOT])
    assert not in_one_field([CUBE_ROOT, ip.algebraic_number([-2, 0, 1], 1.0)])
    with pytest.raises(TypeError):
        CUBE_ROOT + ip.algebraic_number([-2, 0, 1], 1.0)
    assert CUBE_ROOT != "text"
    with pytest.raises(ZeroDivisionError, match="division by 0 in a number field"):
        CUBE_ROOT / (CUBE_ROOT - CUBE_ROOT)


def pi_ball(bits):
    return flint.arb.pi()


def test_computed_numbers_shrink_with_the_precision():
    pi = ComputedNumber(pi_ball)
    total = computed_sum(pi, computed(CUBE_ROOT))
    assert float(total) == pytest.approx(np.pi + 2 ** (1 / 3))
    assert float(total.ball(400).rad()) < 1e-110
    assert repr(pi) == "3.14159265358979 (computed)"
    with flint.ctx.workprec(200):
        assert root_of_number(Fraction(2))().contains(flint.arb(2).sqrt().mid())
    assert ball_of(3, 64) == 3


def test_polynomials_without_real_roots_are_refused():
    with pytest.raises(ip.ComplexError, match=r"coefficients \[1, 0, 1\] has no real root"):
        ip.algebraic_number([1, 0, 1], 0.0)
    with pytest.raises(ip.ComplexError, match="a polynomial is a list of integers, not constant"):
        ip.algebraic_number([1, 0, 0], 0.0)
    with pytest.raises(ip.ComplexError, match="a polynomial is a list of integers"):
        ip.algebraic_number([1.5, 1], 0.0)
