"""Numbers of all libraries as exact ones."""

from fractions import Fraction

import flint
import numpy as np
import pytest
from support.sage_numbers import SageField, SageRational

import igl_periods as ip
from igl_periods.complexes.exact_numbers import ComputedNumber, FieldElement, ball_of
from igl_periods.complexes.number_readers import exact_number, read_number, read_point, read_points


@pytest.mark.parametrize(
    "x",
    ["3/4", Fraction(3, 4), flint.fmpq(3, 4), flint.arb("0.75"), 0.75, np.float32(0.75),
     SageRational(3, 4)],
)  # fmt: skip
def test_rational_numbers(x):
    assert exact_number(x) == Fraction(3, 4)


@pytest.mark.parametrize("x", [7, np.int8(7), flint.fmpz(7), "7", np.array(7)[()]])
def test_integers(x):
    assert read_number(x) == (Fraction(7), False)


def test_only_floating_point_is_rounded():
    assert read_number(0.5) == (Fraction(1, 2), True)
    assert read_number(np.float64(0.1)) == (Fraction(0.1), True)
    assert read_number(Fraction(1, 2))[1] is False
    assert read_point(1 + 2j) == ((1, 2), True)
    assert read_points([0, (1, 2), [Fraction(1), 0.5]])[1] is True
    assert read_points([0, (1, 2), "1/3"]) == ([(0, 0), (1, 2), (Fraction(1, 3), 0)], False)


def test_balls_stay_what_they_are():
    x = exact_number(flint.arb(2, 0.5))
    assert isinstance(x, ComputedNumber)
    assert float(x.ball(500).rad()) == pytest.approx(0.5)
    (x, y), rounded = read_point(flint.acb(1, 2).sqrt())
    assert not rounded
    assert (float(x), float(y)) == pytest.approx((1.272019649514069, 0.7861513777574233))


def test_functions_of_the_precision():
    (x, y), rounded = read_point(lambda bits: flint.acb(1, 2).sqrt())
    assert not rounded
    assert float(x.ball(1000).rad()) < 1e-290
    assert float(y) == pytest.approx(0.7861513777574233)
    (x, y), _ = read_point(lambda bits: flint.arb(2).sqrt())
    assert (float(x), y) == (pytest.approx(2**0.5), 0)


class Evaluated:
    """√2 with the methods of a SymPy expression."""

    is_Rational = False  # noqa: N815
    is_real = True
    free_symbols = frozenset()

    def evalf(self, digits):
        with flint.ctx.workprec(4 * digits):
            return flint.arb(2).sqrt().str(digits, radius=False)


def test_expressions_that_evaluate():
    x = exact_number(Evaluated())
    with flint.ctx.workprec(500):
        assert x.ball(400).overlaps(flint.arb(2).sqrt())
        assert float(x.ball(400).rad()) < 1e-118


def test_sympy():
    sympy = pytest.importorskip("sympy")
    assert exact_number(sympy.Rational(2, 3)) == Fraction(2, 3)
    assert exact_number(sympy.Integer(2)) == 2
    assert read_number(sympy.Float(0.5)) == (Fraction(1, 2), True)
    with flint.ctx.workprec(500):
        golden = ball_of(exact_number((1 + sympy.sqrt(5)) / 2), 300)
        assert (golden * golden - golden - 1).contains(0)
        assert float(golden.rad()) < 1e-88
    (_, y), rounded = read_point(sympy.exp(sympy.I * sympy.pi / 7))
    assert not rounded
    assert float(y) == pytest.approx(np.sin(np.pi / 7))
    with pytest.raises(ip.ComplexError, match="x is not a real number"):
        exact_number(sympy.Symbol("x"))


def test_elements_of_number_fields_of_sage():
    field = SageField([-1, -1, 1], 1.618033988749895)
    x = exact_number(field([Fraction(1, 2), 3]))
    assert isinstance(x, FieldElement)
    assert repr(x) == "2 + 3/2 √5"
    assert x.field == exact_number(field([0, 1])).field
    # Without a generator there is the minimal polynomial: (1 + √5)/2 again.
    assert repr(exact_number(field([0, 1]).without_its_field())) == "1/2 + 1/2 √5"
    assert exact_number(SageRational(2, 6).without_its_field()) == Fraction(1, 3)


def test_recognised_numbers():
    with flint.ctx.workprec(300):
        golden = ip.recognize((1 + flint.arb(5).sqrt()) / 2)
    assert repr(exact_number(golden)) == "1/2 + 1/2 √5"


@pytest.mark.parametrize(
    ("x", "message"),
    [
        (True, "True is not a number of the plane"),
        ("one", "'one' is not a rational number"),
        ("1/0", "'1/0' is not a rational number"),
        (float("nan"), "nan is not finite"),
        (np.inf, "inf is not finite"),
        (None, "None is not a real number"),
        (flint.arb("nan"), "nan is not finite"),
    ],
)
def test_what_is_no_number(x, message):
    with pytest.raises(ip.ComplexError, match=message):
        exact_number(x)


def test_points_have_two_coordinates():
    with pytest.raises(ip.ComplexError, match="a point of the plane has two coordinates, not 3"):
        read_point((1, 2, 3))
