"""Möbius transformations that permute branch points."""

import flint
import pytest

from igl_periods.curves.binary_forms import form_of_points, substituted
from igl_periods.curves.branch_symmetries import around_fixed_points, rotations


def points_of(coefficients):
    roots = flint.fmpz_poly(coefficients).complex_roots()
    return [(z, flint.acb(1)) for z, _ in roots]


def moved(points):
    a, b, c, d = flint.acb(1, 2), flint.acb(0.5), flint.acb(0, 1), flint.acb(2)
    return [(a * x + b * z, c * x + d * z) for x, z in points]


INFINITY = (flint.acb(1), flint.acb(0))


@pytest.mark.parametrize(
    ("coefficients", "at_infinity", "order"),
    [
        ([-1, 0, 0, 0, 0, 0, 1], False, 12),  # x⁶ − 1: dihedral
        ([0, -1, 0, 0, 0, 1], True, 24),  # x⁵ − x: octahedral
        ([-1, 0, 0, 0, 0, 1], True, 5),  # x⁵ − 1
        ([1, 0, 2, 0, 5, 0, 1], False, 2),
        ([1, 2, 2, -3, 5, 0, 1], False, 1),
        ([1, 0, 0, 0, 14, 0, 0, 0, 1], False, 24),
    ],
)
def test_groups_have_their_orders(coefficients, at_infinity, order):
    points = points_of(coefficients) + [INFINITY] * at_infinity
    assert len(rotations(moved(points))) == order - 1


def test_orders_are_those_of_permutations():
    found = rotations(moved([*points_of([-1, 0, 0, 0, 0, 1]), INFINITY]))
    assert [rotation.order for rotation in found] == [5] * 4
    assert {rotation.n_fixed for rotation in found} == {1}


def test_around_its_fixed_points_a_rotation_multiplies():
    flint.ctx.dps = 40
    points = moved(points_of([-1, 0, 0, 0, 0, 0, 1]))
    rotation = next(r for r in rotations(points) if r.order == 6)
    form = form_of_points(around_fixed_points(points, rotation))
    assert [k for k, c in enumerate(form) if not c.contains(0)] == [0, 6]


def test_substitution_and_points_belong_together():
    flint.ctx.dps = 30
    points = points_of([1, 2, 2, -3, 5, 0, 1])
    one = form_of_points(points)
    two = form_of_points([(x + 3 * z, z) for x, z in points])
    back = substituted(two, [[1, 3], [0, 1]])
    assert all((a - b).contains(0) for a, b in zip(one, back, strict=True))


def test_refused():
    twice = [(flint.acb(1), flint.acb(1)), (flint.acb(1, 1e-9), flint.acb(1)), INFINITY]
    with pytest.raises(ValueError, match="apart on the sphere"):
        rotations([*twice, (flint.acb(5), flint.acb(1))])
