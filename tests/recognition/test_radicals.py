"""Algebraic numbers written with roots."""

import flint
import pytest

from igl_periods.recognition import AlgebraicNumber, in_radicals, isolated_roots

FORMS = [
    ((-3, 2), 1.5, "3/2"),
    ((-1, -1, 1), -0.618, "(1 - √5)/2"),
    ((1, -1, 2), 0.25 + 0.66j, "(1 + i√7)/4"),
    ((1, 0, -10, 0, 1), -3.146, "-√2 - √3"),
    ((2, 0, -4, 0, 1), 1.8478, "√(2 + √2)"),
    ((1, 0, 0, 0, 1), 0.7 + 0.7j, "(√2 + i√2)/2"),
    ((-3, 3, -3, 1), 2.26, "1 + ∛2"),
    ((-2, 0, 0, 0, 0, 1), 1.15, "⁵√2"),
    ((-1, 0, 0, -2, 0, 0, 1), 1.34, "∛(1 + √2)"),
    ((-1, 0, 0, -2, 0, 0, 1), -0.745, "-∛(-1 + √2)"),
    ((1, 1, 1, 1, 1), 0.309 + 0.951j, "(-1 + √5 + √(-10 - 2√5))/4"),
]


@pytest.mark.parametrize(("polynomial", "near", "text"), FORMS)
def test_forms(polynomial, near, text):
    x = AlgebraicNumber(polynomial, complex(near))
    form = in_radicals(x)
    assert str(form) == text == str(x)
    assert form.ball(300).overlaps(x.ball(300))


@pytest.mark.parametrize(
    "polynomial", [(7, -1, 3), (1, 0, -10, 0, 1), (3, 1, -7, 1, 1), (-2, 0, 0, 1)]
)
def test_each_root_has_its_own_form_or_none(polynomial):
    for root in isolated_roots(polynomial, 200):
        form = in_radicals(AlgebraicNumber(polynomial, complex(root.mid())))
        if form is not None:
            assert form.ball(200).overlaps(root)
    real = [r for r in isolated_roots(polynomial, 200) if r.imag == 0]
    if polynomial == (-2, 0, 0, 1):
        assert len(real) == 1


def test_a_quintic_without_roots_to_write_it_with():
    assert in_radicals(AlgebraicNumber((-1, -1, 0, 0, 0, 1), 1.1673 + 0j)) is None


def test_a_quartic_with_the_full_symmetric_group():
    assert in_radicals(AlgebraicNumber((1, 1, 0, 0, 1), flint_root())) is None


def flint_root():
    return complex(isolated_roots((1, 1, 0, 0, 1), 64)[0].mid())


def test_two_digits_more_than_enough():
    x = AlgebraicNumber((2, 0, -4, 0, 1), 1.8478 + 0j)
    with flint.ctx.workprec(200):
        assert in_radicals(x).ball(200).overlaps(flint.acb((2 + flint.arb(2).sqrt()).sqrt()))
