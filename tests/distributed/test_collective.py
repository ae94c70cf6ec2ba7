"""Collective work: what one rank raises, all raise."""

import pytest
from support.mpi_processes import OneRank

from igl_periods.distributed.collective import on_every_rank, on_root

# ---- Solution and bound ----


def test_only_rank_0_has_the_result(runs):
    root, *others = runs(3)
    assert len(others) == 2
    for found in others:
        assert all(pm is None for key, pm in found.items() if isinstance(key, tuple))
    assert root["one vertex", "tight"].genus == 2
    assert root["sphere", "tight"].matrix.shape == (0, 0)


def test_a_refusal_is_raised_on_every_rank(runs):
    for found in runs(3):
        assert "not closed: it has 3 boundary edges" in found["open"]


# ---- Failures and options ----


@pytest.mark.parametrize("how", [on_root, on_every_rank])
def test_collective_work_returns_or_raises(how):
    assert how(OneRank(), lambda: 3) == 3
    with pytest.raises(KeyError, match="lost"):
        how(OneRank(), lambda: {}["lost"])
