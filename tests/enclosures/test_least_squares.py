import flint
import numpy as np
from support.enclosed_surfaces import cut, generic_genus_two

from igl_periods.enclosures.interface_nodes import InterfaceNodes
from igl_periods.enclosures.least_squares import least_squares
from igl_periods.enclosures.trial_functions import trial_functions


def test_solution_is_that_of_a_dense_least_squares_problem():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_genus_two())
    nodes = InterfaceNodes.of(cells, np.full(cells.n_interfaces, 12))
    trial = trial_functions(nodes, np.full(cells.n_cells, 7))
    rng = np.random.default_rng(0)
    values, slopes = rng.normal(size=(nodes.n_rows, 2)), rng.normal(size=(nodes.n_rows, 2)) + 0j
    slopes += 1j * rng.normal(size=slopes.shape)
    # What is wanted is given twice, once for each side.
    values, slopes = values - values[nodes.opposite], slopes + slopes[nodes.opposite]
    found = least_squares(trial).solve(values, slopes)
    matrix, wanted = _dense(trial, values, slopes)
    dense = np.linalg.lstsq(matrix, wanted, rcond=None)[0]
    ours = np.concatenate([np.concatenate([a.real, a.imag]) for a in found])
    assert np.allclose(matrix @ ours, matrix @ dense, atol=1e-10)


def _dense(trial, values, slopes):
    nodes, cells = trial.nodes, trial.nodes.cells
    size = 2 * trial.size
    first = np.cumsum(size) - size
    rows, wanted = [], []
    for i in range(cells.n_interfaces):
        block = np.zeros((3 * nodes.n_nodes[i], size.sum()))
        for side, sign in ((0, 1.0), (1, -1.0)):
            cell = cells.cell[i, side]
            r = nodes.rows(i, side)
            r = slice(r.start - nodes.start[cell], r.stop - nodes.start[cell])
            phi, G = trial.values[cell][r], trial.slopes[cell][r]
            columns = np.block(
                [[sign * phi.real, -sign * phi.imag], [G.real, -G.imag], [G.imag, G.real]]
            )
            block[:, first[cell] : first[cell] + size[cell]] += columns
        here = nodes.rows(i, 0)
        root = np.sqrt(np.tile(nodes.weight[here], 3))[:, None]
        rows.append(root * block)
        data = np.concatenate([values[here], slopes[here].real, slopes[here].imag])
        wanted.append(root * data)
    return np.concatenate(rows), np.concatenate(wanted)
