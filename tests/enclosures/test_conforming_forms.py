from functools import cache

import flint
import numpy as np
import pytest
from flint import acb, arb_mat
from support.enclosed_surfaces import cut, exact_matrix, generic_genus_two, matches

from igl_periods.enclosures import PeriodEnclosure
from igl_periods.enclosures.conforming_forms import dirichlet_enclosure
from igl_periods.enclosures.degrees import first_sizes, node_counts
from igl_periods.enclosures.interface_nodes import InterfaceNodes
from igl_periods.enclosures.least_squares import least_squares
from igl_periods.enclosures.refinement import refined
from igl_periods.enclosures.series import Series
from igl_periods.enclosures.trial_functions import trial_functions
from igl_periods.surfaces import regular_map_surface, square_tiled_surface
from igl_periods.topology import cohomology_basis

BITS = 160


def surface_named(name):
    return square_tiled_surface(name) if "omega" in name else regular_map_surface(name)


@cache
def solved(name, radial):
    """A surface, its triangulation, its basis and series of about this radial degree."""
    K = surface_named(name)
    with flint.ctx.workprec(BITS):
        surface, cells, T = cut(K, BITS)
        size = np.maximum(1, np.rint(radial / cells.exponents)).astype(int)
        nodes = InterfaceNodes.of(cells, node_counts(cells, size))
        series = refined(least_squares(trial_functions(nodes, size)), 6.0).series
    return K, surface, T, series


def proved(K, surface, T, series):
    with flint.ctx.workprec(BITS):
        U = arb_mat(T.astype(int).tolist())
        D = U * dirichlet_enclosure(surface, series, -70.0) * U.transpose()
    return PeriodEnclosure(D, cohomology_basis(K), K, BITS)


def disturbed(series, size, seed):
    """Every coefficient with noise of this size."""
    rng = np.random.default_rng(seed)
    return Series(
        series.cells,
        [
            [[c + acb(*(size * rng.normal(size=2))) for c in form] for form in forms]
            for forms in series.coefficients
        ],
    )


def check_bad_solution(name, radial, noise, seed):
    K, surface, T, series = solved(name, radial)
    e = proved(K, surface, T, disturbed(series, noise, seed))
    # D ≥ D_exact is what the proof rests on: compare with the energies of a good solution.
    with flint.ctx.workprec(BITS):
        excess = e.dirichlet - good(name).dirichlet
        values = np.array([float(x.mid()) for x in excess.entries()]).reshape(T.shape)
        size = np.abs(np.linalg.eigvalsh(values)).max()
        assert np.linalg.eigvalsh(values)[0] > -1e-12 * size - float(good(name).bound) * 10
        assert e.matrix.contains(good(name).matrix)


@cache
def good(name):
    return proved(*solved(name, 24))


@pytest.mark.parametrize("name", ["omega_1", "omega_2", "omega_3", "bolza"])
def test_good_solutions_contain_the_exact_matrix(name):
    with flint.ctx.workprec(BITS + 64):
        exact = exact_matrix(name)
    e = good(name)
    assert e.bound < 1e-10
    assert matches(e, exact)


@pytest.mark.parametrize("noise", [1e-10, 1e-4, 1e-1, 10.0])
@pytest.mark.parametrize("radial", [1, 4, 9])
def test_bad_solutions_stay_enclosed(radial, noise):
    check_bad_solution("omega_1", radial, noise, radial)
    check_bad_solution("omega_2", radial, noise, radial)


def test_energies_are_those_of_linear_functions_where_these_are_harmonic():
    # On a flat torus the harmonic forms are linear, and two coefficients a cell are enough.
    from igl_periods.surfaces import flat_torus

    K = flat_torus(0.25 + 1.5j, 2, 2)
    with flint.ctx.workprec(BITS):
        surface, cells, T = cut(K, BITS)
        size = np.full(cells.n_cells, 2)
        nodes = InterfaceNodes.of(cells, node_counts(cells, size))
        series = refined(least_squares(trial_functions(nodes, size)), 30.0).series
    e = proved(K, surface, T, series)
    assert e.bound < 1e-20
    assert e.reduced().contains([[0.25 + 1.5j]])


def test_first_guess_is_enclosed_on_a_surface_without_symmetry():
    K = generic_genus_two()
    with flint.ctx.workprec(BITS):
        surface, cells, T = cut(K, BITS)
    found = []
    for goal in (1.0, 4.0):
        size = first_sizes(cells, goal)
        nodes = InterfaceNodes.of(cells, node_counts(cells, size))
        with flint.ctx.workprec(BITS):
            series = refined(least_squares(trial_functions(nodes, size)), goal).series
        found.append(proved(K, surface, T, series))
    assert found[1].bound < 0.1 * found[0].bound
    assert found[0].matrix.contains(found[1].matrix)
