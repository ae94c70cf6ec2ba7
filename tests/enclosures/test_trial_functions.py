import flint
import numpy as np
from support.enclosed_surfaces import cut, generic_genus_two

from igl_periods.enclosures.interface_nodes import InterfaceNodes
from igl_periods.enclosures.trial_functions import trial_functions


def test_values_are_products_and_of_size_one():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_genus_two())
    nodes = InterfaceNodes.of(cells, np.full(cells.n_interfaces, 20))
    size = 9 + np.arange(cells.n_cells) % 4
    trial = trial_functions(nodes, size)
    w, dw = nodes.coordinates
    for cell in range(cells.n_cells):
        rows = slice(nodes.start[cell], nodes.start[cell + 1])
        values, points, factors = trial.values[cell], trial.points[cell], trial.factors[cell]
        assert values.shape[1] == size[cell]
        assert np.allclose(np.abs(values).max(axis=0), 1.0)
        k = size[cell] - 1
        product = np.prod(factors[:k] * (w[rows, None] - points[:k]), axis=1)
        assert np.allclose(values[:, k], product, atol=1e-12)
        logarithmic = (1.0 / (w[rows, None] - points[:k] + 1e-300)).sum(axis=1) * product * dw[rows]
        regular = np.abs(w[rows, None] - points[:k]).min(axis=1) > 1e-6
        assert np.allclose(trial.slopes[cell][regular, k], logarithmic[regular], rtol=1e-8)
        assert np.unique(points).size == size[cell]


def test_a_larger_basis_goes_on_where_a_smaller_one_ended():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_genus_two())
    size = 9 + np.arange(cells.n_cells) % 4
    small = trial_functions(InterfaceNodes.of(cells, np.full(cells.n_interfaces, 20)), size)
    nodes = InterfaceNodes.of(cells, np.full(cells.n_interfaces, 28))
    large = trial_functions(nodes, size + 6, small)
    for cell in range(cells.n_cells):
        n = size[cell]
        assert (large.points[cell][:n] == small.points[cell]).all()
        assert (large.factors[cell][:n] == small.factors[cell]).all()
        assert np.unique(large.points[cell]).size == n + 6
        assert np.abs(large.values[cell]).max() < 1.5
