"""From closed-form period matrices, and from equations by quadrature, to curves."""

import flint
import numpy as np
import pytest
from support.curve_periods import (
    l_shape_matrix,
    real_branch_points_matrix,
    silhol_matrix,
)
from support.modular_words import random_point, random_word
from support.points_in_balls import with_radius

import igl_periods as ip
from igl_periods.siegel import moved_balls
from igl_periods.surfaces import exact_matrices
from igl_periods.surfaces.named_surfaces import _binomial_balls

EQUATIONS = {
    "square torus": (exact_matrices.square_torus, "y^2 = x^3 - x"),
    "hexagonal torus": (exact_matrices.hexagonal_torus, "y^2 = x^3 - 1"),
    "Bolza": (exact_matrices.bolza, "y^2 = x^5 - x"),
    "omega 1": (exact_matrices.omega_1, "y^2 = 3*x^5 + 7*x^3 + 4*x"),
    "golden L": (
        lambda: l_shape_matrix((1 + flint.arb(5).sqrt()) / 2),
        "y^2 = x^5 + 5*x^3 + 5*x",
    ),
    "Klein": (exact_matrices.klein, "x^3*y + x*z^3 + y^3*z = 0"),
    "Silhol": (silhol_matrix, "x^4 + y^4 + z^4 = 0"),
}


@pytest.mark.parametrize("name", EQUATIONS)
def test_equations_of_named_surfaces(name):
    flint.ctx.dps = 50
    matrix, equation = EQUATIONS[name]
    curve = ip.curve(matrix())
    assert curve.equation == equation
    assert curve.evidence.left_over > 30
    assert curve.proved


@pytest.mark.parametrize("n", range(5, 11))
def test_binomial_curves(n):
    flint.ctx.dps = 50
    assert ip.curve(_binomial_balls(n)).equation == f"y^2 = x^{n} - 1"


def test_from_a_polygon_to_its_equation():
    curve = ip.curve(ip.enclose(ip.surfaces.regular_polygon(8), digits=20))
    assert curve.equation == "y^2 = x^5 - x"
    assert curve.proved
    assert curve.digits >= 20


def test_another_marking_is_the_same_curve():
    flint.ctx.dps = 60
    gamma = random_word(2, 8, np.random.default_rng(3))
    moved = moved_balls(gamma, exact_matrices.omega_1(), 250)
    assert ip.curve(moved).equation == ip.curve(exact_matrices.omega_1()).equation


@pytest.mark.parametrize("points", [(-3, -1, 0, 2, 5), (-4, -2, -1, 1, 3, 4, 7)])
def test_there_and_back_again(points):
    """Equation → Π by quadrature → equation, the same curve with small coefficients."""
    flint.ctx.dps = 80
    curve = ip.curve(real_branch_points_matrix(points))
    assert curve.is_recognised
    assert str(curve.field) == "Q"
    exact = flint.fmpz_poly([1])
    for p in points:
        exact *= flint.fmpz_poly([-p, 1])
    size = 2 * curve.genus + 3
    there = ip.curve_of_form([*exact.coeffs(), 0], digits=60)
    assert curve.same_invariants(there)
    back = [0] * size
    for (k,), number in curve.recognised.items():
        back[k] = -number.polynomial[0]
    assert there.same_invariants(ip.curve_of_form(back, digits=60))


def test_a_curve_with_more_symmetries():
    """y² = x(x² − 1)(x² − 4) in coordinates of its rotations."""
    flint.ctx.dps = 40
    curve = ip.curve(real_branch_points_matrix((-2, -1, 0, 1, 2)))
    assert curve.equation in ("y^2 = 2*x^5 - 5*x^3 + 2*x", "y^2 = 2*x^5 + 5*x^3 + 2*x")
    assert curve.same_invariants(ip.curve_of_form([0, 4, 0, -5, 0, 1, 0]))


@pytest.mark.parametrize("seed", range(3))
def test_generic_points_stay_unrecognised(seed):
    flint.ctx.dps = 40
    rng = np.random.default_rng(seed)
    for genus in (1, 2):
        Pi = with_radius(random_point(genus, rng), 40)
        curve = ip.curve(Pi, degree=10)
        assert not curve.is_recognised
        assert curve.remarks or genus == 1


def test_generic_quartic():
    flint.ctx.dps = 40
    curve = ip.curve(with_radius(random_point(3, np.random.default_rng(1)), 40), degree=4)
    assert (curve.model, curve.is_recognised) == ("plane quartic", False)
    assert "bitangents" in curve.remarks[0]
    assert curve.vanishing_theta_constants == 0


def test_l_shapes_with_transcendental_moduli_stay_unrecognised():
    flint.ctx.dps = 50
    for x in (flint.arb(2).sqrt(), flint.arb(2).root(3)):
        assert not ip.curve(l_shape_matrix(x), degree=10).is_recognised


def test_floats_give_a_few_digits():
    curve = ip.curve(1j / np.sqrt(3) * np.array([[2, -1], [-1, 2]]))
    assert not curve.proved
    assert curve.digits < 10
    assert curve.same_invariants(ip.curve_of_form([-1, 0, 0, 0, 0, 0, 1]))


def test_a_certificate_is_what_is_known():
    """Ω₂ by high degree: a few digits; Ω₁ by linear functions: none."""
    K = ip.surfaces.square_tiled_surface("omega_2", n=2)
    known = ip.curve(ip.period_matrix(K, degree=8))
    assert 6 <= known.digits <= 9
    assert known.same_invariants(ip.curve_of_form([0, -1, 0, 0, 0, 1, 0]))
    assert not known.same_invariants(ip.curve_of_form([-1, 0, 0, 0, 0, 1, 0]))
    with pytest.raises(ip.CurveError, match="known too badly"):
        ip.curve(ip.period_matrix(ip.surfaces.square_tiled_surface("omega_1")))


def test_a_torus_that_may_be_the_square_one():
    curve = ip.curve(np.array([[1j]]))
    assert curve.coefficients == {}
    assert "1728" in curve.remarks[0]


def test_beyond():
    flint.ctx.dps = 40
    bring = ip.curve(exact_matrices.bring())
    assert (bring.model, bring.is_hyperelliptic) == ("unknown", False)
    assert "0 of 136 even theta constants vanish" in bring.remarks[0]
    far = ip.curve(_binomial_balls(13))
    assert (far.genus, far.is_hyperelliptic) == (6, None)
    assert "up to genus 5" in far.remarks[0]
    assert far.equation == "no equation is computed"


def test_refused():
    product = np.diag([1.1j, 1.3j])
    with pytest.raises(ip.CurveError, match="a product of curves"):
        ip.curve(product)
    with pytest.raises(ip.CurveError, match="a sphere"):
        ip.curve(np.zeros((0, 0)))
    with pytest.raises(ip.NotASiegelPointError, match="square"):
        ip.curve(np.ones((2, 3)))
    with pytest.raises(ValueError, match="degree = 0"):
        ip.curve(product, degree=0)
    with pytest.raises(ValueError, match="7 or 9 coefficients"):
        ip.curve_of_form([1, 2, 3])
