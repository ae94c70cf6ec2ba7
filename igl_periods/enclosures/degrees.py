r"""How many trial functions each cell needs, learnt from the decay of its coefficients.

On every cell the coefficients of the Newton basis fall geometrically, |a_k| ≈ C e^{−rk}, at a rate
that depends on where the next singularities lie.  The rate is read off the envelope of the
coefficients that have been computed, above the residual, below which they mean nothing.  As
extrapolation is safe over short ranges only, goals are approached in stages, each at most 2.2 times
as many digits as the one before has reached.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints

from .cells import Cells

_GROWTH = 2.2
_FIRST_GOAL = 4.0
_FEWEST = 4
# The first radial degree kκ for each digit.
_FIRST_RADIAL = 2.2
# Decimal digits for each unit of the radial degree: where nothing is known, at least, at most.
_RATE, _SLOWEST, _FASTEST = 0.3, 0.04, 1.2
_MARGIN = 0.5
# The radial degree at which a rate is to be believed by half.
_SLOWER = 4.0
# Logarithms of sizes that are about the same; and how much larger than its last coefficient a jump
# may be that is laid to a cell.
_DOUBT, _MOST_BLAME = 0.5, 2.0


def next_goal(reached: float, goal: float) -> float:
    """Digits of the jumps to try next, on the way to a goal; ``reached`` are known."""
    start = max(reached, _FIRST_GOAL / _GROWTH)
    n_stages = np.ceil(np.log(max(goal / start, 1.0)) / np.log(_GROWTH))
    return float(goal if n_stages <= 1 else start * (goal / start) ** (1.0 / n_stages))


def first_sizes(cells: Cells, goal: float) -> Ints:
    """A number of functions for each cell, before anything is known."""
    radial = _FIRST_RADIAL * goal + 2.0
    return np.maximum(_FEWEST, np.rint(radial / cells.exponents)).astype(np.int64)


def next_sizes(cells: Cells, sizes: list[Floats], jumps: Floats, goal: float) -> Ints:
    """Numbers of functions for jumps of 10^−goal.

    Parameters
    ----------
    sizes : list of (K,) float
        Sizes of the coefficients of the Newton basis of each cell.
    jumps : (n_interfaces,) float
        The logarithm of the jumps of that solution, to the base 10.
    """
    residual = float(jumps.max())
    decays = [_decay(a, float(k), residual) for a, k in zip(sizes, cells.exponents)]
    tail = np.array([level - rate * (a.size - n) for a, (n, level, rate) in zip(sizes, decays)])
    # A jump is laid to the cell with the larger last coefficients, or to both.
    blamed, largest = np.full((2, cells.n_cells), -np.inf)
    for here, there in ((0, 1), (1, 0)):
        a, b = cells.cell[:, here], cells.cell[:, there]
        guilty = tail[a] >= tail[b] - _DOUBT
        np.maximum.at(blamed, a[guilty], jumps[guilty])
        np.maximum.at(largest, a, jumps)
    found = []
    # Nor are coefficients believed that are much larger than all jumps of the cell.
    believed = np.minimum(tail, largest + _MOST_BLAME)
    for coefficients, (_, _, rate), last, jump in zip(sizes, decays, believed, blamed):
        excess = max(last + _MARGIN, min(jump, last + _MOST_BLAME)) + goal
        wanted = coefficients.size + excess / rate
        # Where hardly anything was known, do not believe in a few large or small coefficients.
        most = 1.3 * _GROWTH * coefficients.size + 10.0
        found.append(int(np.ceil(np.clip(wanted, _FEWEST, most))))
    return np.array(found, dtype=np.int64)


def _decay(a: Floats, kappa: float, residual: float) -> tuple[int, float, float]:
    """How many coefficients mean something, the logarithm of the last one, and its decrease."""
    with np.errstate(divide="ignore"):
        envelope = np.maximum.accumulate(np.log10(a)[::-1])[::-1]
    known = np.flatnonzero(envelope > residual - 1.0)
    if known.size == 0:
        return 0, residual, _RATE * kappa
    last = int(known[-1])
    first = last // 2
    rate = (envelope[first] - envelope[last]) / (last - first) if last > first else _RATE * kappa
    # The decrease becomes slower with k: weak singularities are not felt in the beginning.
    rate /= 1.0 + _SLOWER / (kappa * last + 1.0)
    return last + 1, float(envelope[last]), float(np.clip(rate, _SLOWEST * kappa, _FASTEST * kappa))


def node_counts(cells: Cells, size: Ints) -> Ints:
    """Numbers of nodes of the interfaces, for these numbers of functions."""
    radial = size * cells.exponents
    # In steps of 4, so that many interfaces share their nodes.
    return 4 * np.ceil((0.7 * radial[cells.cell].max(axis=1) + 8.0) / 4.0).astype(np.int64)
