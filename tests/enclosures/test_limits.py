import itertools
import math

import flint
import pytest
from support.enclosed_surfaces import generic_torus

import igl_periods as ip
from igl_periods.enclosures import enclose, limits, stages
from igl_periods.enclosures.limits import Limits, OutOfTimeError, check_time, time_until


class Clock:
    """Every look at the clock takes a second."""

    def __init__(self):
        self._seconds = itertools.count()

    def perf_counter(self):
        return float(next(self._seconds))


def test_time_is_over_after_its_end(monkeypatch):
    monkeypatch.setattr(limits, "time", Clock())
    with time_until(1.0):
        check_time()
        check_time()
        with pytest.raises(OutOfTimeError):
            check_time()
    check_time()


def test_a_stage_that_takes_too_long_is_given_up(monkeypatch):
    monkeypatch.setattr(limits, "time", Clock())
    found = Limits(10.0, None, start=0.0)

    def endless():
        while True:
            check_time()

    assert found.solved(endless, 1, reserve=True) is None
    assert found.proved(endless) is None
    assert found.out_of_time() == "10 s are over"


@pytest.fixture(scope="module")
def reliable():
    return enclose(generic_torus(), digits=30).matrix


@pytest.mark.parametrize("seconds", [3, 30, 100, 300])
def test_what_was_proved_before_counts(monkeypatch, reliable, seconds):
    # Nothing is foreseen, so that every stage begins, and some stage is interrupted.
    monkeypatch.setattr(limits, "time", Clock())
    monkeypatch.setattr(limits, "_COST_EXPONENT", -math.inf)
    monkeypatch.setattr(stages, "_LEAST_RESERVE", 0.0)
    with pytest.warns(ip.ToleranceWarning, match=f"60 were asked for: {seconds} s are over"):
        e = enclose(generic_torus(), digits=60, max_seconds=seconds)
    assert e.bound < 1
    with flint.ctx.workprec(400):
        assert e.contains(reliable)
