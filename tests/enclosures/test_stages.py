import numpy as np
import pytest
from support.enclosed_surfaces import cut, generic_torus

import igl_periods as ip
from igl_periods.enclosures.limits import Limits
from igl_periods.enclosures.stages import STALLED, Stages


@pytest.fixture(scope="module")
def cells():
    return cut(generic_torus())[1]


def test_stages_reach_their_digits_and_go_on_where_more_are_asked_for(cells):
    stages = Stages(cells, 12, Limits(None, None))
    first = stages.solve()
    assert first.expected_digits > 11.5
    assert not stages.reason
    stages.ask_for_more(8.0)
    second = stages.solve()
    assert second.expected_digits > 15.0
    assert second.problem.n_unknowns > first.problem.n_unknowns


def test_a_stage_that_gains_nothing_is_the_last_one(monkeypatch, cells):
    stages = Stages(cells, 40, Limits(None, None))
    solve, seen = ip.enclosures.stages.solution_for, []

    def always_the_same(cells, size, goal, before=None):
        seen.append(goal)
        return solve(cells, np.full(cells.n_cells, 6), goal, before)

    monkeypatch.setattr(ip.enclosures.stages, "solution_for", always_the_same)
    assert stages.solve() is not None
    assert stages.reason == STALLED
    assert len(seen) == 2
    assert stages.solve() is None


def test_the_first_stage_needs_room(cells):
    with pytest.raises(ip.MemoryLimitError, match="Ask for fewer digits"):
        Stages(cells, 40, Limits(None, 1e3))
