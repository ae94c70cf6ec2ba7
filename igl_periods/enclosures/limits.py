r"""What a computation may take: seconds and bytes.

Limits act in two ways.  A stage that would probably pass one is not begun; its seconds are
extrapolated from the stage before, its bytes are known beforehand.  And every long loop asks, step
by step, whether its time is over (:func:`check_time`); then the stage ends with OutOfTimeError, and
what was reached before counts.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import TypeVar

from igl_periods.arrays import Ints
from igl_periods.errors import MemoryLimitError
from igl_periods.machine import available_memory
from igl_periods.run_log import logger

from .cells import Cells
from .degrees import node_counts

# Seconds grow with this power of the number of unknowns, for estimates; entries of the Cholesky
# factor over those of the normal equations.
_COST_EXPONENT, _FILL = 2.5, 5.0

_end: ContextVar[float] = ContextVar("end", default=math.inf)
_Result = TypeVar("_Result")


class OutOfTimeError(Exception):
    """The time that a stage had is over."""


@contextmanager
def time_until(end: float) -> Iterator[None]:
    """Let :func:`check_time` raise after this value of the clock, ``time.perf_counter()``."""
    token = _end.set(end)
    try:
        yield
    finally:
        _end.reset(token)


def check_time() -> None:
    """Raise OutOfTimeError if the time is over; it costs a look at the clock."""
    if time.perf_counter() > _end.get():
        raise OutOfTimeError


@dataclass
class Limits:
    """What the computation may take, and what it has taken.

    Attributes
    ----------
    max_seconds, max_memory : float or None
    start : float
        When it began.
    last : (float, float)
        The seconds that the last solution took, and its number of functions.
    """

    max_seconds: float | None
    max_memory: float | None
    start: float = field(default_factory=lambda: time.perf_counter())
    last: tuple[float, float] = (0.0, 1.0)

    def solved(self, solve: Callable[[], _Result], size: Ints, reserve: bool) -> _Result | None:
        """Solve, and remember how long that took for so many functions; None if time was over.

        With ``reserve`` as much time is left as the solution before took, for its proof.
        """
        before = time.perf_counter()
        try:
            with time_until(self._end() - (self.last[0] if reserve else 0.0)):
                solution = solve()
        except OutOfTimeError:
            return None
        self.last = time.perf_counter() - before, float(size.sum())
        return solution

    def proved(self, prove: Callable[[], _Result]) -> _Result | None:
        """What a proof gives; None if time was over."""
        try:
            with time_until(self._end()):
                return prove()
        except OutOfTimeError:
            return None

    def out_of_time(self) -> str:
        """What to say if time was over."""
        return f"{self.max_seconds:g} s are over"

    def exceeded_by(self, cells: Cells, size: Ints) -> str:
        """Why a solution with these numbers of functions is not to be begun; empty if it may."""
        seconds, unknowns = self.last
        expected = seconds * (float(size.sum()) / unknowns) ** _COST_EXPONENT
        # The proof takes about as long as the solution.
        if time.perf_counter() + 2.0 * expected > self._end():
            return f"the next step would take about {2.0 * expected:.3g} s more"
        needed = stage_memory(cells, size)
        if needed > self._room():
            return f"the next step would take about {needed / 1e9:.3g} GB"
        logger.info("next: degrees up to %d, about %.2g s", size.max(), expected)
        return ""

    def check_memory(self, cells: Cells, size: Ints) -> None:
        """Raise MemoryLimitError if a solution has no room."""
        needed = stage_memory(cells, size)
        if needed > self._room():
            raise MemoryLimitError(
                f"series on {cells.n_cells:,} stars and faces take about {needed / 1e9:.3g} GB, "
                f"and there are {self._room() / 1e9:.3g} GB. Ask for fewer digits, simplify the "
                "mesh, or use a machine with more memory."
            )

    def _end(self) -> float:
        return math.inf if self.max_seconds is None else self.start + self.max_seconds

    def _room(self) -> float:
        available = available_memory()
        return available if self.max_memory is None else min(available, self.max_memory)


def stage_memory(cells: Cells, size: Ints) -> float:
    """Bytes that the least-squares problem takes: tables, normal equations and their factor."""
    columns = 2.0 * size[cells.cell]
    nodes = node_counts(cells, size)
    tables = 24.0 * float((nodes[:, None] * columns).sum())
    normal = 16.0 * float((columns[:, 0] * columns[:, 1]).sum())
    return tables + (1.0 + _FILL) * normal + 16.0 * float((2.0 * size**2).sum())
