import flint
import numpy as np
from flint import acb, arb
from support.enclosed_surfaces import cut, generic_genus_two, l_shape

from igl_periods.enclosures.quadrature import gauss_balls
from igl_periods.enclosures.series import PowerTables, Series, face_trace, powers_of, star_traces
from igl_periods.surfaces import regular_map_surface


def random_series(K, length=9, bits=200):
    surface, cells, T = cut(K, bits)
    rng = np.random.default_rng(0)
    forms = cells.jumps.shape[1]
    coefficients = [
        [[acb(*rng.normal(size=2)) for _ in range(length + cell % 3)] for _ in range(forms)]
        for cell in range(cells.n_cells)
    ]
    return surface, Series(cells, coefficients), T


def directly(series, i, side, t, form):
    """F and dF/ds at one node, from the definition."""
    cells = series.cells
    cell = int(cells.cell[i, side])
    a, b = cells.start[i][side], cells.end[i][side]
    s = (1 + t) / 2 if side == 0 else (1 - t) / 2
    z = (a + s * (b - a)) / arb(float(cells.scale[cell]))
    w, dw = z, (b - a) / arb(float(cells.scale[cell]))
    if cells.is_star(i, side):
        kappa = cells.exponent[cell]
        w = ((z.log() + acb(0, cells.turn[i])) * kappa).exp()
        dw = kappa * w * dw / z
    c = series.coefficients[cell][form]
    F = sum((x * p for x, p in zip(c, powers_of(w, len(c)))), acb(0))
    slope = sum((k * x * p for k, (x, p) in enumerate(zip(c[1:], powers_of(w, len(c))), 1)), acb(0))
    return F, slope * dw


def test_traces_are_values_and_derivatives():
    for K in (generic_genus_two(), regular_map_surface("klein")):
        with flint.ctx.workprec(200):
            _, series, _ = random_series(K)
            tables = PowerTables(lambda n: gauss_balls(n)[0])
            k, nodes = series.n_forms, gauss_balls(5)[0]
            counts = [5] * series.cells.n_interfaces
            stars = dict(star_traces(series, tables, counts))
            assert sorted(stars) == list(range(series.cells.n_chords))
            for i in (0, 7, 20, series.cells.n_chords, series.cells.n_interfaces - 1):
                if i >= series.cells.n_interfaces:
                    continue
                for side in range(2):
                    if series.cells.is_star(i, side):
                        rows = stars[i].tolist()
                    else:
                        rows = face_trace(series.on_segment(i, side), tables, 5, side).tolist()
                    for t, row in zip(nodes, rows):
                        F, G = directly(series, i, side, t, 1)
                        assert row[1].overlaps(F.real)
                        assert row[k + 1].overlaps(G.real)
                        assert row[2 * k + 1].overlaps(G.imag)
                        assert float(row[2 * k + 1].rad()) < 1e-48


def test_powers_do_not_blow_up():
    with flint.ctx.workprec(128):
        w = acb(arb(0.6), arb(0.8)) * acb(0, arb(1) / 3).exp()
        assert float(powers_of(w, 512)[-1].real.rad()) < 1e-32


def test_excess_bits_make_up_for_all_that_cancels():
    # Half-strips: on long sides |α| + |β| is above 1, and the powers of t grow like (3/2)^k.
    K = l_shape(1.25)
    with flint.ctx.workprec(800):
        _, series, _ = random_series(K, length=200, bits=800)
    assert series.excess_bits > 45
    tables = PowerTables(lambda n: gauss_balls(n)[0])
    counts = [4] * series.cells.n_interfaces
    with flint.ctx.workprec(100 + series.excess_bits):
        traces = [trace for _, trace in star_traces(series, tables, counts)]
        traces += [
            face_trace(series.on_segment(i, side), tables, 4, side)
            for i in range(series.cells.n_interfaces)
            for side in range(2)
            if not series.cells.is_star(i, side)
        ]
    assert max(float(x.rad()) for trace in traces for x in trace.entries()) < 2.0**-60
