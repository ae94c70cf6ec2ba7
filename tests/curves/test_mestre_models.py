"""Sextics over Q from invariants alone."""

import flint
import pytest

from igl_periods.curves.binary_forms import igusa_clebsch_of_sextic, substituted
from igl_periods.curves.mestre_models import NO_RATIONAL_POINT, mestre_sextic
from igl_periods.curves.weighted_points import same_point


def elsewhere(coefficients):
    """The same curve in coordinates that are not rational."""
    form = [flint.acb(c) for c in coefficients]
    change = [[flint.acb(1, 2), flint.acb(3)], [flint.acb(0.25, 1), flint.acb(1).exp()]]
    return [c * flint.acb(3).sqrt() for c in substituted(form, change)]


@pytest.mark.parametrize(
    "coefficients", [[-2, 4, 3, -3, 0, 4, 2], [1, 4, 2, -3, 0, -4, -5], [1, 1, 0, -1, 2, 3, 0]]
)
def test_curves_over_q_come_back(coefficients):
    flint.ctx.dps = 120
    model, remark = mestre_sextic(elsewhere(coefficients))
    assert remark is None
    assert model.degree == 1
    found = [flint.fmpq(-x.polynomial[0]) for x in model.numbers]
    exact = [flint.fmpq(c) for c in coefficients]
    pair = igusa_clebsch_of_sextic(found), igusa_clebsch_of_sextic(exact)
    assert same_point(*pair, (2, 4, 6, 10))
    assert sum(c * c for c in found) <= 2 * sum(c * c for c in coefficients)


def test_a_curve_that_is_not_defined_over_its_field_of_moduli():
    """f = x⁶ + a x⁵ + b x⁴ + c x³ − b̄ x² + ā x − 1 with a = 1 + i, b = 2 − i, c = 3.

    x ↦ −1/x takes f̄ to a multiple of f, so that the field of moduli is in Q; the real curve would
    be a conic without real points.
    """
    flint.ctx.dps = 120
    a, b = flint.acb(1, 1), flint.acb(2, -1)
    form = [flint.acb(-1), a.conjugate(), -b.conjugate(), flint.acb(3), b, a, flint.acb(1)]
    model, remark = mestre_sextic(form)
    assert model is None
    assert remark == NO_RATIONAL_POINT


def test_with_involutions_the_conic_is_degenerate():
    flint.ctx.dps = 60
    assert mestre_sextic(elsewhere([1, 0, 2, 0, -3, 0, 5])) == (None, None)


def test_transcendental_invariants():
    flint.ctx.dps = 60
    form = [flint.acb(c) for c in (1, 2, 3, 0, 5, 1)] + [flint.acb(1).exp()]
    assert mestre_sextic(form) == (None, None)
