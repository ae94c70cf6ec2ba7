"""What counts as known in balls, and how well."""

import re

import flint
import numpy as np
from support.points_in_balls import Enclosed, with_radius

import igl_periods as ip
from igl_periods.siegel import balls_of, bits_of, in_marking, midpoint


def test_what_is_known_in_balls():
    balls = with_radius([[0.25 + 1j]], 20)
    assert balls_of(balls) is balls
    assert balls_of(Enclosed(balls, 100)) is balls
    assert balls_of(np.array([[1j]])) is None
    assert bits_of(Enclosed(balls, 500)) == 500
    assert ip.to_flint(Enclosed(balls, 100)) is balls
    text = repr(ip.siegel_reduce(balls))
    assert re.fullmatch(r"EnclosedReduction by γ \(2 × 2\) to\n  0\.250+ \+ 1\.0+ i", text)


def test_the_precision_keeps_what_is_known():
    assert 200 < bits_of(with_radius([[0.25 + 1j]], 60)) < 300
    with flint.ctx.workprec(1000):
        assert bits_of(flint.acb_mat([[flint.acb(0, 1)]])) == 1000
    balls = with_radius([[0.25 + 1j]], 60)
    inverted = in_marking(balls, np.array([[0, -1], [1, 0]]))
    assert float(inverted[0, 0].rad()) < 1e-59
    assert abs(midpoint(inverted)[0, 0] + 1 / (0.25 + 1j)) < 1e-15
