"""Points of weighted projective spaces."""

import flint
import pytest

from igl_periods.curves.weighted_points import absolute_invariants, same_point

WEIGHTS = (2, 3, 6, 10)


def numbers(*values):
    return [flint.fmpq(x) for x in values]


def test_scaled_points_have_the_same_absolute_invariants():
    point = numbers(5, -7, 3, 2)
    scaled = [x * flint.fmpq(-2, 3) ** w for x, w in zip(point, WEIGHTS, strict=True)]
    assert absolute_invariants(point, WEIGHTS) == absolute_invariants(scaled, WEIGHTS)
    assert same_point(point, scaled, WEIGHTS)


def test_only_degrees_that_occur_count():
    """Without odd degrees the scale may be a square root."""
    one, two = numbers(4, 0, 8, 32), numbers(8, 0, 64, 1024)
    assert same_point(one, two, WEIGHTS)
    assert not same_point(one, numbers(8, 1, 64, 1024), WEIGHTS)
    assert not same_point(one, numbers(8, 0, 64, 1025), WEIGHTS)


def test_wide_balls_prove_nothing():
    wide = [flint.acb(flint.arb(x, 10)) for x in (2, 0, 3, 5)]
    assert same_point(wide, numbers(2, 1, 3, 5), WEIGHTS)
    half = [flint.acb(2), flint.acb(flint.arb(0, 0.5)), flint.acb(3), flint.acb(5)]
    assert same_point(half, numbers(2, flint.fmpq(1, 4), 3, 5), WEIGHTS)
    assert not same_point(half, numbers(2, 1, 3, 5), WEIGHTS)


def test_balls_that_contain_zero_are_zero():
    tiny = flint.acb(flint.arb(0, 1e-30))
    point = [flint.acb(2), tiny, flint.acb(3), flint.acb(5)]
    assert same_point(point, numbers(2, 0, 3, 5), WEIGHTS)


def test_refused():
    with pytest.raises(ValueError, match="unstable"):
        absolute_invariants(numbers(0, 0), (2, 3))
    with pytest.raises(ValueError, match="2 invariants have 3 weights"):
        absolute_invariants(numbers(1, 1), (2, 3, 5))
