import flint
import numpy as np
from support.enclosed_surfaces import cut, generic_torus

from igl_periods.enclosures.interface_nodes import InterfaceNodes, gauss_nodes


def test_nodes_are_symmetric_to_the_last_bit():
    for n in (7, 8, 40, 161):
        s, weights = gauss_nodes(n)
        assert np.array_equal(s + s[::-1], np.ones(n))
        assert (np.diff(s) > 0).all()
        assert abs(weights.sum() - 1.0) < 1e-13
        assert abs((weights * s**5).sum() - 1 / 6) < 1e-13


def test_rows_of_both_sides_are_the_same_points():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_torus())
    nodes = InterfaceNodes.of(cells, 8 + 4 * (np.arange(cells.n_interfaces) % 3))
    assert np.array_equal(nodes.opposite[nodes.opposite], np.arange(nodes.n_rows))
    assert np.array_equal(nodes.position + nodes.position[nodes.opposite], np.ones(nodes.n_rows))
    cell = np.repeat(np.arange(cells.n_cells), np.diff(nodes.start))
    assert np.array_equal(cells.cell.ravel()[nodes.side_of_row], cell)


def test_coordinates_have_the_right_derivative():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_torus())
    nodes = InterfaceNodes.of(cells, np.full(cells.n_interfaces, 24))
    w, dw = nodes.coordinates
    assert np.abs(w).max() < 1.0 + 1e-9
    for i in range(cells.n_interfaces):
        for side in range(2):
            rows = nodes.rows(i, side)
            s = nodes.position[rows]
            fit = np.polynomial.Chebyshev.fit(s, w[rows], 20)
            assert np.abs(fit.deriv()(s) - dw[rows]).max() < 1e-7
