from itertools import pairwise

import flint
import numpy as np
from support.enclosed_surfaces import cut, generic_torus

from igl_periods.enclosures.degrees import first_sizes, next_sizes, node_counts, stage_goals


def test_stages_grow_by_a_bounded_factor_and_end_at_the_goal():
    for goal in (1.0, 6.5, 51.0, 500.0):
        goals = stage_goals(goal)
        assert goals[-1] == goal
        assert all(b <= 2.2 * a * (1 + 1e-12) for a, b in pairwise(goals))


def test_geometric_decay_is_extrapolated():
    with flint.ctx.workprec(100):
        _, cells, _ = cut(generic_torus())
    size = first_sizes(cells, 10.0)
    sizes = [10.0 ** (-0.4 * k * np.arange(n)) for n, k in zip(size, cells.exponents)]
    jumps = np.full(cells.n_interfaces, -30.0)
    found = next_sizes(cells, sizes, jumps, 12.0)
    assert (np.abs(found * cells.exponents - 12.0 / 0.4) < 5 * cells.exponents + 1).all()
    assert (node_counts(cells, found) % 4 == 0).all()
