import flint
import pytest
from flint import arb

from igl_periods.enclosures.exact_arithmetic import (
    ball_from_text,
    ball_in_text,
    exponent_of,
    from_integers,
    to_integers,
)

BALLS = [arb(0), arb(-3), arb(2) ** -2000, arb(1) / 3, arb.pi() * 10**40, arb(0, 1e-30)]


@pytest.mark.parametrize("ball", BALLS, ids=str)
def test_integers_give_the_ball_again(ball):
    again = from_integers(*to_integers(ball))
    assert again.mid() == ball.mid()
    # python-flint rounds a radius upwards by one unit when it makes a ball.
    assert again.contains(ball)
    assert again.rad() <= ball.rad() * (1 + 1e-8)


@pytest.mark.parametrize("ball", BALLS, ids=str)
@pytest.mark.parametrize("digits", [1, 5, 40])
def test_text_contains_the_ball(ball, digits):
    with flint.ctx.workprec(200):
        assert ball_from_text(ball_in_text(ball, digits)).contains(ball)


@pytest.mark.parametrize("ball", [x for x in BALLS if x != 0 and x.mid() != 0], ids=str)
def test_exponent_is_the_least_power_of_two_above(ball):
    e = exponent_of(ball)
    assert arb(2) ** (e - 1) <= abs(ball.mid()) < arb(2) ** e
    assert exponent_of(-ball) == e
    assert exponent_of(arb(0)) < -(10**6)
