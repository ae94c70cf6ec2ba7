import flint
import pytest
from flint import arb

from igl_periods import ComplexError
from igl_periods.enclosures.planes import foot_and_height


def test_third_corner_has_the_right_distances():
    with flint.ctx.workprec(300):
        a, b, c = arb(7) / 5, arb(11) / 10, arb(2).sqrt()
        x, y = foot_and_height(c, a, b)
        assert (x * x + y * y).overlaps(a * a)
        assert ((c - x) * (c - x) + y * y).overlaps(b * b)
        assert float(y.rad()) < 1e-85


def test_needle_keeps_its_digits():
    with flint.ctx.workprec(100):
        _, y = foot_and_height(arb(1), arb(1), arb(2) ** -40)
        assert y.rel_accuracy_bits() > 90


def test_flat_triangle_is_refused():
    with pytest.raises(ComplexError, match="form no triangle"):
        foot_and_height(arb(2), arb(1), arb(1))
