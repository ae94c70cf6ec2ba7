import flint
import numpy as np
import pytest
from support.enclosed_surfaces import cut, generic_torus

from igl_periods.enclosures.degrees import first_sizes, next_sizes, node_counts
from igl_periods.enclosures.interface_nodes import InterfaceNodes
from igl_periods.enclosures.least_squares import least_squares
from igl_periods.enclosures.refinement import precision_of, refined
from igl_periods.enclosures.trial_functions import trial_functions


def solution(cells, size, goal):
    nodes = InterfaceNodes.of(cells, node_counts(cells, size))
    return refined(least_squares(trial_functions(nodes, size)), goal)


@pytest.fixture(scope="module")
def refined_torus():
    with flint.ctx.workprec(precision_of(40)):
        _, cells, _ = cut(generic_torus(), precision_of(40))
    first = solution(cells, first_sizes(cells, 9.0), 9.0)
    size = next_sizes(cells, first.sizes, first.jumps, 18.0)
    return solution(cells, size, 18.0)


def test_jumps_fall_far_below_double_precision(refined_torus):
    assert refined_torus.residual < -16.5


def test_series_are_the_sums_of_the_newton_bases(refined_torus):
    trial, series = refined_torus.problem.trial, refined_torus.series
    w = trial.nodes.coordinates[0]
    for cell in (0, 5, len(trial.size) - 1):
        rows = slice(trial.nodes.start[cell], trial.nodes.start[cell + 1])
        values = trial.values[cell] @ refined_torus.newton[cell]
        c = np.array([[complex(x) for x in form] for form in series.coefficients[cell]])
        direct = np.polynomial.polynomial.polyval(w[rows], c.T).T
        assert np.abs(values - direct).max() < 1e-10


def test_series_are_exact_midpoints(refined_torus):
    for forms in refined_torus.series.coefficients:
        assert all(c.is_exact() for form in forms for c in form)


def test_going_on_from_a_smaller_solution_leads_to_the_same_one(refined_torus):
    cells = refined_torus.problem.trial.nodes.cells
    size = refined_torus.problem.trial.size + 8
    nodes = InterfaceNodes.of(cells, node_counts(cells, size))
    trial = trial_functions(nodes, size, refined_torus.problem.trial)
    problem = least_squares(trial)
    onward, anew = refined(problem, 24.0, refined_torus), refined(problem, 24.0)
    assert onward.residual < refined_torus.residual - 2.0
    assert abs(onward.residual - anew.residual) < 1.0
    for a, b in zip(onward.newton, anew.newton):
        assert np.abs(a - b).max() < 1e-13
