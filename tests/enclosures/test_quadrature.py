import flint
import numpy as np
from support.enclosed_surfaces import cut, generic_torus

from igl_periods.enclosures.quadrature import ChordBounds, gauss_balls, shape
from igl_periods.enclosures.series import Series


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


def test_bound_covers_the_error_of_few_nodes():
    with flint.ctx.workprec(300):
        _, cells, _ = cut(generic_torus(), 300)
        rng = np.random.default_rng(1)
        coefficients = [
            [[flint.acb(*rng.normal(size=2)) * 0.6**k for k in range(6)] for _ in range(2)]
            for _ in range(cells.n_cells)
        ]
        series = Series(cells, coefficients)
        bounds = ChordBounds(series)
        zero = [flint.arb(0)] * 2
        for i in (0, 5, 11):
            polynomials = series.on_segment(i, 0)
            for accuracy in (-3.0, -20.0):
                rule = bounds.rule(i, polynomials, 2, accuracy)
                bound = bounds.error(i, polynomials, (zero, zero), rule)
                error = _flux(series, i, rule.n_nodes) - _flux(series, i, 120)
                assert float(abs(error).upper()) < float(bound[0, 0].upper())


def _flux(series, i, n):
    """∫ 2 (g − u/2) Im G on the star's side, for the first form, by n nodes."""
    from igl_periods.enclosures.series import PowerTables, face_trace, star_traces

    tables = PowerTables(lambda n: gauss_balls(n)[0])
    counts = [n] * series.cells.n_interfaces
    star = dict(star_traces(series, tables, counts))[i].tolist()
    face = face_trace(series.on_segment(i, 0), tables, n, 0).tolist()
    weights = gauss_balls(n)[1]
    return sum(
        (2 * w * (a[0] - b[0] / 2) * b[4] for w, a, b in zip(weights, face, star)), flint.arb(0)
    )
