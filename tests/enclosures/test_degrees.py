import flint
import numpy as np
from support.enclosed_surfaces import cut, generic_torus

from igl_periods.enclosures.degrees import first_sizes, next_goal, next_sizes, node_counts


def test_stages_grow_by_a_bounded_factor_and_end_at_the_goal():
    for goal in (1.0, 6.5, 51.0, 500.0):
        goals = [next_goal(0.0, goal)]
        while goals[-1] != goal:
            goals.append(next_goal(goals[-1], goal))
            assert goals[-1] <= 2.2 * goals[-2] * (1 + 1e-12)
        assert len(goals) < 10


def test_geometric_decay_is_extrapolated():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_torus())
    size = first_sizes(cells, 10.0)
    sizes = [10.0 ** (-0.4 * k * np.arange(n)) for n, k in zip(size, cells.exponents)]
    # Jumps are as large as the last coefficients beside them.
    jumps = np.log10([a[-1] for a in sizes])[cells.cell].max(axis=1)
    found = next_sizes(cells, sizes, jumps, 12.0)
    # No less than the decay demands, and a little more, as it may become slower.
    radial, enough = found * cells.exponents, 12.0 / 0.4
    assert (radial > enough - 5 * cells.exponents - 1).all()
    assert (radial < 1.2 * enough + 5 * cells.exponents + 1).all()
    assert (node_counts(cells, found) % 4 == 0).all()


def test_coefficients_are_not_believed_where_nothing_jumps():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_torus())
    size = first_sizes(cells, 10.0)
    noise = [np.full(n, 0.1) for n in size]
    found = next_sizes(cells, noise, np.full(cells.n_interfaces, -13.0), 10.0)
    assert (found <= size).all()
