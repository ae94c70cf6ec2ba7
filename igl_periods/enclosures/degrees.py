r"""How many trial functions each cell needs, learnt from the decay of its coefficients.

On every cell the coefficients of the Newton basis fall geometrically, |a_k| ≈ C e^{−rk}, at a rate
that depends on where the next singularities lie.  The rate is read off the envelope of the
coefficients that have been computed, above the residual, below which they mean nothing.  As
extrapolation is safe over short ranges only, goals are approached in stages, each at most 2.2 times
as many digits as the one before.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints

from .cells import Cells

_GROWTH = 2.2
_FIRST_GOAL = 7.0
_FEWEST = 4
# Decimal digits for each unit of the radial degree kκ: of a first guess, at least, and at most.
_RATE, _SLOWEST, _FASTEST = 0.3, 0.04, 1.2
_MARGIN = 0.7


def stage_goals(goal: float) -> list[float]:
    """Digits of the residual to be reached one after the other; the last one is ``goal``."""
    goals = [goal]
    while goals[0] > _FIRST_GOAL:
        goals.insert(0, goals[0] / _GROWTH)
    return goals


def first_sizes(cells: Cells, goal: float) -> Ints:
    """A number of functions for each cell, before anything is known."""
    radial = goal / _RATE + 2.0
    return np.maximum(_FEWEST, np.rint(radial / cells.exponents)).astype(np.int64)


def next_sizes(cells: Cells, sizes: list[Floats], residual: float, goal: float) -> Ints:
    """Numbers of functions for a residual of 10^−goal.

    Parameters
    ----------
    sizes : list of (K,) float
        Sizes of the coefficients of the Newton basis of each cell.
    residual : float
        The logarithm of the residual of that solution, to the base 10.
    """
    found = [
        _extrapolated(a, float(kappa), residual, goal) for a, kappa in zip(sizes, cells.exponents)
    ]
    return np.array(found, dtype=np.int64)


def _extrapolated(a: Floats, kappa: float, residual: float, goal: float) -> int:
    with np.errstate(divide="ignore"):
        envelope = np.maximum.accumulate(np.log10(a)[::-1])[::-1]
    known = np.flatnonzero(envelope > residual - 0.5)
    last = int(known[-1]) if known.size else 0
    first = last // 2
    rate = _RATE * kappa
    if last > first:
        rate = (envelope[first] - envelope[last]) / (last - first)
    rate = float(np.clip(rate, _SLOWEST * kappa, _FASTEST * kappa))
    level = float(envelope[last]) if known.size else residual
    wanted = last + 1 + (level + goal + _MARGIN) / rate
    # Where hardly anything was known, do not believe in a few large or small coefficients.
    most = 1.3 * _GROWTH * a.size + 10.0
    return int(np.ceil(np.clip(wanted, _FEWEST, most)))


def node_counts(cells: Cells, size: Ints) -> Ints:
    """Numbers of nodes of the interfaces, for these numbers of functions."""
    radial = size * cells.exponents
    # In steps of 4, so that many interfaces share their nodes.
    return 4 * np.ceil((0.7 * radial[cells.cell].max(axis=1) + 8.0) / 4.0).astype(np.int64)
