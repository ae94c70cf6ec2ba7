"""Simple equations for branch points that are known up to Möbius transformations."""

import flint
import pytest

from igl_periods.curves.binary_forms import igusa_clebsch_of_sextic
from igl_periods.curves.hyperelliptic_models import model_of_branch_points, recognised_form
from igl_periods.curves.weighted_points import same_point

DEGREE = 4


def scrambled(coefficients):
    """Branch points of y² = f(x) in other coordinates, ∞ included for an odd degree."""
    points = [(z, flint.acb(1)) for z, _ in flint.fmpz_poly(coefficients).complex_roots()]
    if len(coefficients) % 2 == 0:
        points.append((flint.acb(1), flint.acb(0)))
    a, b, c, d = flint.acb(1, 2).exp(), flint.acb(0.5).sqrt(), flint.acb(0, 1), flint.acb(2)
    return [(a * x + b * z, c * x + d * z) for x, z in points]


def numbers(model):
    return [str(x) for x in model.numbers]


@pytest.mark.parametrize(
    ("coefficients", "expected"),
    [
        ([0, -1, 0, 0, 0, 1], ["0", "-1", "0", "0", "0", "1", "0"]),
        ([-1, 0, 0, 0, 0, 1], ["-1", "0", "0", "0", "0", "1", "0"]),
        ([-5, 0, 0, 0, 0, 0, 3], ["-1", "0", "0", "0", "0", "0", "1"]),
        ([-1, 0, 0, 0, 0, 0, 0, 1], ["-1", "0", "0", "0", "0", "0", "0", "1", "0"]),
        ([0, 5, 0, 5, 0, 1], ["0", "5", "0", "5", "0", "1", "0"]),
    ],
)
def test_rotations_lead_to_the_known_equations(coefficients, expected):
    flint.ctx.dps = 50
    found = numbers(model_of_branch_points(scrambled(coefficients), DEGREE))
    assert expected in (found, found[::-1])


@pytest.mark.parametrize(
    "coefficients",
    [
        [1, 0, 2, 0, -3, 0, 5],  # x ↦ −x, fixed points rational
        [7, -1, 9, 0, 9, 1, 7],  # x ↦ −1/x, fixed points ±i
        [2, 3, 0, -1, 1, 1],  # no symmetry, a rational branch point
        [1, 2, 0, 3, 1, 1, 0, 1],  # genus 3, a rational branch point
    ],
)
def test_models_over_q(coefficients):
    flint.ctx.dps = 80
    model = model_of_branch_points(scrambled(coefficients), DEGREE)
    assert model.degree == 1
    if len(coefficients) < 8:
        exact = [flint.fmpq(c) for c in [*coefficients, 0][:7]]
        found = [flint.fmpq(-x.polynomial[0]) for x in model.numbers]
        pair = igusa_clebsch_of_sextic(found), igusa_clebsch_of_sextic(exact)
        assert same_point(*pair, (2, 4, 6, 10))
        assert max(map(abs, found)) <= 50


def test_a_curve_over_a_quadratic_field():
    """y² = x⁵ + x³ + (1 + √2)/3 · x."""
    flint.ctx.dps = 50
    t = (1 + flint.arb(2).sqrt()) / 3
    roots = [flint.acb(0)]
    for sign in (1, -1):
        square = (-1 + sign * flint.acb(1 - 4 * t).sqrt()) / 2
        roots += [square.sqrt(), -square.sqrt()]
    points = [(z, flint.acb(1)) for z in roots] + [(flint.acb(1), flint.acb(0))]
    model = model_of_branch_points([(x + z, 2 * z - x) for x, z in points], DEGREE)
    assert model.degree == 2


def test_transcendental_branch_points_stay_unrecognised():
    flint.ctx.dps = 40
    values = [flint.acb(k).exp() for k in range(1, 4)]
    points = [(z, flint.acb(1)) for z in [flint.acb(0), flint.acb(-1), *values]]
    points.append((flint.acb(1), flint.acb(0)))
    assert model_of_branch_points(points, DEGREE) is None


def test_the_evidence_goes_with_the_coefficients():
    flint.ctx.dps = 30
    form = recognised_form([flint.acb(c) / 3 for c in (1, 0, 2, 3, 0)], 2)
    assert numbers(form) == ["1", "0", "2", "3", "0"]
    assert form.numbers[0].evidence.left_over > 20
    assert recognised_form([flint.acb(1).exp(), flint.acb(1)], 2) is None
