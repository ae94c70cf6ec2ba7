import flint
import numpy as np
from flint import acb, arb
from support.enclosed_surfaces import cut, generic_genus_two

from igl_periods.enclosures.float_traces import LongEnds, coefficients_in_floats, traces
from igl_periods.enclosures.interface_nodes import InterfaceNodes
from igl_periods.enclosures.quadrature import gauss_balls
from igl_periods.enclosures.trial_functions import trial_functions


def test_errors_of_traces_are_covered():
    with flint.ctx.workprec(160):
        _, cells, _ = cut(generic_genus_two(), 160)
        rng = np.random.default_rng(0)
        c = [rng.normal(size=(12, 2)) * 0.7 ** np.arange(12)[:, None] + 0j for _ in cells.scale]
        nodes = {6: gauss_balls(6)[0]}
        t = np.array([float(x.mid()) for x in nodes[6]], dtype=np.longdouble)
        chords = np.array([0, 4, 9])
        long = LongEnds(cells)
        points = long.star_points(chords, np.array([6, 6, 6]), nodes, np.tile(t, 3))
        found = traces(points, c, of_stars=True)
        for row in range(18):
            i, x = int(chords[row // 6]), nodes[6][row % 6]
            star = int(cells.cell[i, 1])
            a, b = cells.start[i][1], cells.end[i][1]
            z = (a + b) / 2 - x * (b - a) / 2
            w = (
                (z / arb(float(cells.scale[star]))).log() + acb(0, cells.turn[i])
            ) * cells.exponent[star]
            w = w.exp()
            for form in range(2):
                series = [acb(complex(y)) for y in c[star][:, form]]
                F = sum((y * w**k for k, y in enumerate(series) if k), acb(0))
                H = sum((k * y * w**k for k, y in enumerate(series) if k), acb(0))
                G = H * cells.exponent[star] * (b - a) / z
                assert abs(F.real - arb(found.u[row, form])) <= found.u_error[row, form]
                error = found.G_error[row, form]
                assert abs(G.real - arb(found.G[row, form].real)) <= error
                assert abs(G.imag - arb(found.G[row, form].imag)) <= error
                assert error < 1e-14


def test_newton_bases_become_power_series():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_genus_two(), 100)
    nodes = InterfaceNodes.of(cells, np.full(cells.n_interfaces, 12))
    trial = trial_functions(nodes, 5 + np.arange(cells.n_cells) % 3)
    rng = np.random.default_rng(0)
    newton = [rng.normal(size=(K, 2)) + 0j for K in trial.size]
    series = coefficients_in_floats(trial, newton)
    w = nodes.coordinates[0]
    for cell, c in enumerate(series):
        rows = slice(nodes.start[cell], nodes.start[cell + 1])
        direct = np.polynomial.polynomial.polyval(w[rows], c).T
        assert np.allclose(direct, trial.values[cell] @ newton[cell], atol=1e-11)
