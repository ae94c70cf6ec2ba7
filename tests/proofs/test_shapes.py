"""Shapes of triangles in balls, against 300 bits."""

import flint
import numpy as np
import pytest
from flint import arb
from support.ball_arithmetic import BITS, area

import igl_periods as ip
from igl_periods.proofs.midpoint_radius import Balls
from igl_periods.proofs.shapes import check_known, cotangents, double_areas


def triangles(seed):
    """Round ones, needles and caps, of all sizes, in all orders of the sides."""
    rng = np.random.default_rng(seed)
    a = np.ones(300)
    small = 10.0 ** rng.uniform(-12, 0, 300)
    needle = np.stack([a, small, a + small * rng.uniform(-0.9, 0.9, 300)], axis=1)
    b = rng.uniform(0.2, 0.8, 300)
    cap = np.stack([a, b, (1 - b) * (1 + 10.0 ** rng.uniform(-12, -1, 300))], axis=1)
    lengths = rng.permuted(np.concatenate([needle, cap]), axis=1)
    return lengths * 10.0 ** rng.uniform(-30, 30, (600, 1))


def contained(balls, exact):
    return all(
        arb(m, r).contains(x)
        for m, r, x in zip(balls.mid.tolist(), balls.rad.tolist(), exact, strict=True)
    )


@pytest.mark.parametrize("radius", [0.0, 1e-15])
def test_areas_and_cotangents_contain_the_exact_ones(radius):
    flint.ctx.prec = BITS
    lengths = triangles(0)
    balls = Balls(lengths, radius * lengths)
    double_area = double_areas(balls)
    known = double_area.is_positive()
    assert known.all() if radius == 0.0 else known.sum() > 500
    corner = np.random.default_rng(1).integers(0, 3, 600)
    cot = cotangents(balls, double_area, corner)
    # Exact triangles within the balls: shrunk or grown as a whole.
    for t in (-radius, 0.0, radius):
        sides = [[arb(x) * (1 + arb(t) / 2) for x in row] for row in lengths[known].tolist()]
        areas = [area(*row) for row in sides]
        assert contained(double_area[known], [2 * x for x in areas])
        exact = [
            (row[c - 2] ** 2 + row[c - 1] ** 2 - row[c] ** 2) / (4 * x)
            for row, c, x in zip(sides, corner[known].tolist(), areas, strict=True)
        ]
        assert contained(cot[known], exact)


def test_areas_of_exact_sides_are_known_however_thin_triangles_are():
    double_area = double_areas(Balls.exact(triangles(2)))
    assert np.all(double_area.rad < 1e-15 * double_area.mid)


def test_triangles_that_may_be_degenerate_are_refused():
    lengths = np.array([[1.0, 1.0, 1.0], [1.0, 0.5, 0.5 + 1e-15]])
    double_area = double_areas(Balls(lengths, np.full((2, 3), 1e-15)))
    check_known(double_area[:1])
    with pytest.raises(ip.ComplexError, match="nothing can be proved about 1 faces, of which face"):
        check_known(double_area)
