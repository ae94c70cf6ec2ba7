"""Whatever the coefficients are, the forms are closed, and the truth stays enclosed."""

from dataclasses import replace
from functools import cache

import flint
import numpy as np
import pytest
from flint import acb, acb_mat, arb
from support.enclosed_surfaces import (
    cut,
    exact_matrix,
    generic_genus_two,
    generic_torus,
    l_shape,
    l_shape_matrix,
    matches,
    polygons,
)

import igl_periods as ip
from igl_periods.enclosures import PeriodEnclosure, enclose, stages
from igl_periods.enclosures.conforming_forms import dirichlet_enclosure
from igl_periods.enclosures.float_energies import float_dirichlet_enclosure
from igl_periods.enclosures.float_traces import coefficients_in_floats
from igl_periods.enclosures.refinement import _jump_rows, _left
from igl_periods.enclosures.series import Series
from igl_periods.enclosures.stages import solution_for
from igl_periods.surfaces import flat_torus, square_tiled_surface
from igl_periods.topology import cohomology_basis

BITS = 128
TAU = 0.3125 + 0.84375j
SURFACES = {
    "L(5/4)": (lambda: l_shape(1.25), lambda: l_shape_matrix(arb(1.25))),
    "L(2)": (lambda: l_shape(2.0), lambda: l_shape_matrix(arb(2))),
    "L(3)": (lambda: l_shape(3.0), lambda: l_shape_matrix(arb(3))),
    "flat torus": (lambda: flat_torus(TAU, 1, 2), lambda: acb_mat([[acb(TAU)]])),
    "octagon": (lambda: octagon(), lambda: exact_matrix("bolza")),
    "omega_3": (lambda: square_tiled_surface("omega_3"), lambda: exact_matrix("omega_3")),
    "torus": (generic_torus, None),
    "genus 2": (generic_genus_two, None),
}
# Beyond these a warning or an error may say that nothing is known.
FAITHFUL = 1e-6


def octagon():
    return polygons(8, 1, lambda p, i: (p, (i + 4) % 8))


@cache
def truth(name):
    """The exact matrix in the marking of the surface, in balls of 30 digits."""
    make, exact = SURFACES[name]
    e = enclose(make(), digits=30)
    assert e.digits >= 30
    if exact is not None:
        with flint.ctx.workprec(400):
            Pi = exact()
        assert matches(e, Pi)
    return e.matrix


@cache
def solved(name, degree):
    """A surface cut into cells, and series of ``degree`` functions on every cell."""
    K = SURFACES[name][0]()
    with flint.ctx.workprec(BITS):
        surface, cells, T = cut(K, BITS)
        return K, surface, T, solution_for(cells, np.full(cells.n_cells, degree), 4.0)


def in_floats(surface, solution, size, rng):
    coefficients = coefficients_in_floats(solution.problem.trial, solution.newton)
    noisy = [a + size * (rng.normal(size=a.shape) + 1j * rng.normal(size=a.shape))
             for a in coefficients]  # fmt: skip
    return float_dirichlet_enclosure(surface, solution.problem.trial.nodes.cells, noisy, -40.0)


def in_balls(surface, solution, size, rng):
    series = solution.series
    noisy = [[[c + acb(*(size * rng.normal(size=2))) for c in form] for form in forms]
             for forms in series.coefficients]  # fmt: skip
    return dirichlet_enclosure(surface, Series(series.cells, noisy), -40.0)


def check_noise(name, degree, size, seed, energies):
    """Whether something was proved; what was proved is true."""
    K, surface, T, solution = solved(name, degree)
    rng = np.random.default_rng(seed)
    U = flint.arb_mat(T.astype(int).tolist())
    try:
        with flint.ctx.workprec(BITS):
            D = U * energies(surface, solution, size, rng) * U.transpose()
            found = PeriodEnclosure(D, cohomology_basis(K), K, BITS).matrix
    except ip.ComplexError:
        return False
    assert found.contains(truth(name)), (name, degree, size, seed)
    return True


@pytest.mark.parametrize("energies", [in_floats, in_balls])
@pytest.mark.parametrize("name", ["L(2)", "torus"])
def test_noise_of_any_size_stays_enclosed(name, energies):
    for seed, size in enumerate(10.0 ** np.arange(-16.0, 4.0, 3.0)):
        proved = check_noise(name, 1 + 3 * seed % 16, size, seed, energies)
        assert proved or size > FAITHFUL


@pytest.mark.slow
def test_a_thousand_bad_solutions_stay_enclosed():
    rng = np.random.default_rng(0)
    names, n_proved = list(SURFACES), 0
    for case in range(1000):
        size, degree = 10.0 ** rng.uniform(-16, 3), int(rng.integers(1, 17))
        energies = in_balls if case % 4 == 3 else in_floats
        proved = check_noise(names[case % len(names)], degree, size, case, energies)
        assert proved or degree == 1 or size > FAITHFUL
        n_proved += proved
    assert n_proved > 600


def with_noise(solution, size, rng):
    """The solution with noise in all coefficients, and the jumps that it has then."""
    noise = [size * rng.normal(size=a.shape) for a in solution.newton]
    newton = [a + b for a, b in zip(solution.newton, noise)]
    update, exponent = solution._last
    update = [a + b / 2.0**exponent for a, b in zip(update, noise)]
    nodes = solution.problem.trial.nodes
    values = _jump_rows(nodes)
    left = np.full(nodes.cells.n_interfaces, 1e-300)
    for jumps in _left(solution.problem, newton, values, np.zeros(values.shape, complex)):
        np.maximum.at(left, nodes.side_of_row // 2, np.abs(jumps).max(axis=1))
    return replace(solution, newton=newton, jumps=np.log10(left), _last=(update, exponent))


def believed(solution, size, rng):
    """The same, with the jumps of the solution without noise."""
    return replace(with_noise(solution, size, rng), jumps=solution.jumps)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("disturbed", [with_noise, believed])
@pytest.mark.parametrize("digits", [8, 20])
@pytest.mark.parametrize("size", [1e-12, 1e-3, 0.1, 1e3, np.nan])
def test_the_search_ends_whatever_the_solutions_are_worth(monkeypatch, disturbed, digits, size):
    expected, rng = truth("torus"), np.random.default_rng(7)
    solve, sizes = stages.solution_for, []

    def bad(cells, size_of_cells, goal, before=None):
        sizes.append(size_of_cells.sum())
        return disturbed(solve(cells, size_of_cells, goal, before), size, rng)

    monkeypatch.setattr(stages, "solution_for", bad)
    K = generic_torus()
    if digits == 8 and size == 1e-12:
        e = enclose(K, digits=digits)
    else:
        with pytest.warns(ip.ToleranceWarning, match="digits are proved"):
            e = enclose(K, digits=digits)
    assert e.bound < 1
    assert e.contains(expected)
    assert len(sizes) <= 6
    assert sizes[-1] <= 20 * sizes[0]
