r"""Solutions in stages, each with more trial functions than the one before.

A stage solves for jumps of a goal 10^−goal, with the numbers of functions that the coefficients of
the stage before suggest.  The next one follows as long as this one was worth it: a stage that gains
hardly anything of what it was made for is the last one, so that the search ends whatever the
solutions are worth.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from igl_periods.arrays import Ints
from igl_periods.run_log import logger, stage

from .cells import Cells
from .degrees import first_sizes, next_goal, next_sizes, node_counts
from .interface_nodes import InterfaceNodes
from .least_squares import least_squares
from .limits import Limits
from .refinement import Refined, refined
from .trial_functions import trial_functions

STALLED = "more trial functions do not help"

# Digits beyond those that are wanted which series are made for, and with which a proof is tried.
_RESERVE, _LEAST_RESERVE = 0.3, -0.5
# Of the digits that a stage was made for it gains as much at least, or is the last one.
_LEAST_SHARE = 0.1


class Stages:
    """The stages on the way to a number of digits.

    Attributes
    ----------
    closest : Refined or None
        The best solution so far.
    reason : str
        Why there is no further stage; empty as long as there may be one.
    """

    def __init__(self, cells: Cells, digits: int, limits: Limits) -> None:
        """Raise MemoryLimitError if even the first stage has no room."""
        self.cells, self.digits, self.limits = cells, digits, limits
        # Energies add up the squares of the jumps on all segments, about a tenth of the largest.
        self._margin = 0.5 * float(np.log10(max(cells.n_interfaces / 10.0, 1.0)))
        self._final = 0.5 * (digits + _RESERVE) + self._margin
        self._goal = next_goal(0.0, self._final)
        self._size = first_sizes(cells, self._goal)
        self.closest: Refined | None = None
        self._last: Refined | None = None
        self.reason = ""
        limits.check_memory(cells, self._size)

    def solve(self) -> Refined | None:
        """Go on until a solution probably has the digits; None if it is none that is new."""
        before = self.closest
        while not self.reason:
            with stage(f"series for jumps of 1e-{self._goal:.1f}"):
                solve = partial(solution_for, self.cells, self._size, self._goal, self._last)
                found = self.limits.solved(solve, self._size, self.closest is not before)
            if found is None:
                self.reason = self.limits.out_of_time()
                break
            self._last = found
            logger.info(
                "jumps of 1e%.1f with %d functions, about %.1f digits",
                found.residual,
                self._size.sum(),
                found.expected_digits,
            )
            if not self._is_worth_it(found):
                self.reason = STALLED
            if self.closest is None or found.expected_digits > self.closest.expected_digits:
                self.closest = found
            if self.reason or found.expected_digits >= self.digits + _LEAST_RESERVE:
                break
            self._enlarge(found, found.expected_digits)
        return self.closest if self.closest is not before else None

    def ask_for_more(self, proved: float) -> None:
        """Raise the goal by what is missing where so many digits were proved."""
        assert self.closest is not None
        self._final += 0.5 * (self.digits - proved + _RESERVE)
        self._enlarge(self.closest, proved)

    def _is_worth_it(self, found: Refined) -> bool:
        before = 0.0 if self.closest is None else self.closest.expected_digits
        wanted = max(2.0 * (self._goal - self._margin) - before, 0.0)
        least = -np.inf if self.closest is None else before + _LEAST_SHARE * wanted
        # What is no number is not worth it.
        return bool(found.expected_digits > least)

    def _enlarge(self, found: Refined, digits: float) -> None:
        """The next goal, and the numbers of functions that it probably takes."""
        reached = 0.5 * digits + self._margin
        # What was asked for in vain is not asked for again.
        again = min(self._goal, self._final) + 0.5 * max(self._goal - reached, 0.0)
        self._goal = max(next_goal(reached, self._final), again)
        size = next_sizes(self.cells, found.sizes, found.jumps, self._goal)
        self._size = np.maximum(size, self._size)
        self.reason = self.limits.exceeded_by(self.cells, self._size)


def solution_for(cells: Cells, size: Ints, goal: float, before: Refined | None = None) -> Refined:
    """Solve with ``size`` functions for each cell, no fewer than there were before."""
    nodes = InterfaceNodes.of(cells, node_counts(cells, size))
    trial = trial_functions(nodes, size, None if before is None else before.problem.trial)
    return refined(least_squares(trial), goal, before)
