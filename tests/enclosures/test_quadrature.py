import flint
import numpy as np
import pytest
from support.enclosed_surfaces import cut, generic_torus

from igl_periods.enclosures.quadrature import SegmentBounds, gauss_balls, shape
from igl_periods.enclosures.series import PowerTables, Series, face_trace, star_traces


def test_rule_is_exact_on_polynomials():
    with flint.ctx.workprec(200):
        nodes, weights = gauss_balls(9)
        for degree in range(18):
            total = sum((w * ((1 + t) / 2) ** degree for t, w in zip(nodes, weights)), flint.arb(0))
            assert total.contains(flint.arb(1) / (degree + 1))


def test_shape_is_height_over_length_and_foot():
    height, foot = shape(flint.acb(3, 2), flint.acb(-1, 2))
    assert height.contains(flint.arb(0.5))
    assert foot.contains(flint.arb(0.75))


def random_series(seed=1, length=14):
    _, cells, _ = cut(generic_torus(), 300)
    rng = np.random.default_rng(seed)
    coefficients = [
        [[flint.acb(*rng.normal(size=2)) * 0.6**k for k in range(length)] for _ in range(2)]
        for _ in range(cells.n_cells)
    ]
    return Series(cells, coefficients)


@pytest.mark.parametrize("accuracy", [-3.0, -12.0, -40.0])
def test_bounds_of_chords_cover_the_errors_of_few_nodes(accuracy):
    with flint.ctx.workprec(300):
        series = random_series()
        bounds = SegmentBounds(series)
        zero = [flint.arb(0)] * 2
        jumping = np.flatnonzero(np.abs(series.cells.jumps).sum(axis=1)).tolist()
        for i in (0, 5, *jumping[:3]):
            face = series.on_segment(i, 0)
            rule = bounds.chord_rule(i, face, accuracy)
            bound = bounds.chord_error(i, face, (zero, zero), rule)
            check_bound(bound, *(_energies(series, i, n) for n in (rule.n_nodes, 120)))


@pytest.mark.parametrize("accuracy", [-3.0, -12.0, -40.0])
def test_bounds_of_gaps_cover_the_errors_of_few_nodes(accuracy):
    with flint.ctx.workprec(300):
        series = random_series()
        bounds = SegmentBounds(series)
        for i in range(series.cells.n_chords, series.cells.n_interfaces)[:4]:
            sides = [series.on_segment(i, side) for side in range(2)]
            rule = bounds.gap_rule(*sides, accuracy)
            assert rule.n_nodes <= 16
            bound = bounds.gap_error(i, *sides, rule)
            check_bound(bound, *(_energies(series, i, n) for n in (rule.n_nodes, 120)))


def check_bound(bound, few, many):
    for found, e in zip((few - many).entries(), bound.entries()):
        assert float(abs(found).upper()) <= float(e.upper()) + 1e-60


def _energies(series, i, n):
    """All integrals over a segment, without correction, by n nodes; (2, 2)."""
    cells, tables = series.cells, PowerTables(lambda n: gauss_balls(n)[0])
    first = face_trace(series.on_segment(i, 0), tables, n, 0)
    if i < cells.n_chords:
        second = dict(star_traces(series, tables, [n] * cells.n_interfaces))[i]
    else:
        second = face_trace(series.on_segment(i, 1), tables, n, 1)
    height, foot = shape(cells.start[i][1], cells.end[i][1])
    total = flint.arb_mat(2, 2)
    for t, w, a, b in zip(*gauss_balls(n), first.tolist(), second.tolist()):
        delta = [g - int(j) - u for g, j, u in zip(a, cells.jumps[i], b)]
        slope = [x + y for x, y in zip(a[2:4], b[2:4])]
        slanted = [d + ((1 - t) / 2 - foot) * e for d, e in zip(delta, slope)]
        here, there = [u / 2 for u in a[:2]], [d + u / 2 for d, u in zip(delta, b)]
        half = _outer(here, a[4:]) + _outer(there, b[4:])
        mismatch = _outer(slanted, slanted) / (2 * height) + _outer(slope, slope) * (height / 2)
        total += (half + half.transpose() + mismatch) * w
    return total


def _outer(x, y):
    return flint.arb_mat([[a * b for b in y] for a in x])
