"""Numbers written with roots."""

from fractions import Fraction

import flint

from igl_periods.recognition import Root, Surd, square_part
from igl_periods.recognition.surds import square_root, surd


def test_square_parts():
    for n in (*range(-60, 0), *range(1, 60)):
        s, r = square_part(n)
        assert s * s * r == n
        assert all(exponent == 1 for prime, exponent in flint.fmpz(abs(r)).factor())
    assert square_part(0) == (0, 0)


def test_square_roots_of_fractions():
    assert square_root(Fraction(8, 9)) == (Fraction(2, 3), 2)
    assert square_root(Fraction(1, 2)) == (Fraction(1, 2), 2)


def test_equal_roots_are_collected():
    assert surd(Fraction(1), (Fraction(2), 3), (Fraction(-2), 3)) == Surd(Fraction(1))
    assert surd(Fraction(1), (Fraction(2), 1)) == Surd(Fraction(3))


def test_text_and_latex_and_ball():
    x = surd(Fraction(1, 2), (Fraction(1, 2), -3))
    assert str(x) == "(1 + i√3)/2"
    assert x.latex() == r"\frac{1 + \mathrm{i}\sqrt{3}}{2}"
    assert (x.ball(200) ** 6).contains(1)
    nested = Surd(Fraction(0), (Root(Fraction(-1, 2), surd(Fraction(2), (Fraction(1), 2))),))
    assert str(nested) == "-√(2 + √2)/2"
    assert nested.latex() == r"-\frac{\sqrt{2 + \sqrt{2}}}{2}"
    cube = Root(Fraction(1), Surd(Fraction(2)), 3)
    assert str(Surd(Fraction(0), (cube,))) == "∛2"
    assert Surd(Fraction(0), (cube,)).latex() == r"\sqrt[3]{2}"
    assert str(surd(Fraction(0), (Fraction(1), -1))) == "i"
    assert str(Surd(Fraction(0))) == "0"
