"""What a curve says about itself."""

import copy
import pickle

import flint
import pytest
from support.curve_periods import l_shape_matrix

import igl_periods as ip
from igl_periods.curves.algebraic_curve import polynomial_text
from igl_periods.surfaces import exact_matrices


@pytest.fixture
def bolza():
    flint.ctx.dps = 50
    return ip.curve(exact_matrices.bolza())


def test_facts(bolza):
    assert bolza.equation == "y^2 = x^5 - x"
    assert bolza.is_hyperelliptic
    assert bolza.is_recognised
    assert str(bolza.field) == "Q"
    assert str(bolza.field_of_moduli) == "Q"
    assert bolza.evidence.left_over > 40
    assert "recognised, not proved" in repr(bolza)
    assert "y^2 = x^5 - x" in bolza._repr_html_()


def test_invariants_decide_which_curve_it_is(bolza):
    assert bolza.same_invariants(ip.curve_of_form([0, -1, 0, 0, 0, 1, 0]))
    assert bolza.same_invariants(ip.curve_of_form([0, 81, 0, 0, 0, 1, 0]))
    assert not bolza.same_invariants(ip.curve_of_form([-1, 0, 0, 0, 0, 1, 0]))
    assert not bolza.same_invariants(ip.curve_of_form([-1, 0, 0, 0, 0, 0, 0, 1, 0]))


def test_no_digits_are_lost_to_the_precision_of_the_moment():
    with flint.ctx.workdps(50):
        curve = ip.curve(l_shape_matrix(flint.arb(2)))
    assert flint.ctx.prec == 53
    assert all(z.rad() < 1e-45 for z in curve.absolute_invariants.values())
    assert str(curve.recognised_invariants["I6"]) == "38380/6440067"
    assert str(curve.field_of_moduli) == "Q"
    with flint.ctx.workdps(50):
        other = ip.curve(l_shape_matrix(flint.arb(2) + flint.arb(10) ** -30))
    assert not curve.same_invariants(other)


def test_quartics_are_compared_too():
    flint.ctx.dps = 40
    klein = ip.curve(exact_matrices.klein())
    assert klein.same_invariants(ip.curve_of_form({(1, 3, 0): 2, (0, 1, 3): 3, (3, 0, 1): 5}))
    assert not klein.same_invariants(ip.curve_of_form({(4, 0, 0): 1, (0, 4, 0): 1, (0, 0, 4): 1}))
    with pytest.raises(ValueError, match="terms of degree 4"):
        ip.curve_of_form({(3, 0, 0): 1})


def test_without_invariants_nothing_is_compared():
    flint.ctx.dps = 40
    bring = ip.curve(exact_matrices.bring())
    with pytest.raises(ValueError, match="no invariants are computed of curves"):
        bring.same_invariants(bring)


def test_recognised_absolute_invariants_of_the_omega_surface():
    """Those of y² = 3x⁵ + 7x³ + 4x, exactly."""
    flint.ctx.dps = 60
    found = ip.curve(l_shape_matrix(flint.arb(2)))
    exact = ip.curve_of_form([0, 4, 0, 7, 0, 3, 0])
    for name, number in found.recognised_invariants.items():
        assert number.is_rational
        assert number.ball(100).overlaps(exact.absolute_invariants[name])


def test_unrecognised_curves_show_digits():
    flint.ctx.dps = 40
    curve = ip.curve(l_shape_matrix(flint.arb(2).sqrt()))
    assert not curve.is_recognised
    assert curve.field is None
    assert curve.field_of_moduli is None
    assert "in balls, not recognised" in repr(curve)
    assert len(curve.branch_points) == 6


def test_copies_and_pickles(bolza):
    for other in (pickle.loads(pickle.dumps(bolza)), copy.deepcopy(bolza)):
        assert other.equation == bolza.equation
        assert other.same_invariants(bolza)


def test_polynomials_in_words():
    assert polynomial_text({(2, 1): "-1", (0, 0): "√2", (1, 0): "1 - i"}, ("x", "y")) == (
        "-x^2*y + (1 - i)*x + √2"
    )
    assert polynomial_text({}, ("x",)) == "0"
