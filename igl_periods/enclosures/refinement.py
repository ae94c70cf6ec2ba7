r"""Coefficients to any number of digits: residuals in balls, updates in double precision.

For given numbers of trial functions the least-squares problem is factored once, in double
precision.  Its residual, the jumps across the interfaces, is computed at the precision that the
goal needs, scaled to order 1, solved for, and the update added exactly; each step gains 13 to 14
digits, until the trial functions have no more to give.

The coefficients are kept as power series c_k w^k.  Newton bases become power series only through
their updates, so the large numbers of that transformation touch rounding and never truth; its
precision is raised until the result is known well enough.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import chain, zip_longest

import flint
import numpy as np

from igl_periods.arrays import Complexes, Floats
from igl_periods.errors import ComplexError

from .interface_nodes import InterfaceNodes, gauss_nodes
from .least_squares import LeastSquares
from .limits import check_time
from .series import PowerTables, Series, face_trace, largest_exponent, star_traces
from .trial_functions import TrialFunctions

Acb = flint.acb

# A step that reduces the residual by less has met what the trial functions can do; by less than
# the second number in the first step, by less than the third one where the goal is near.
_LEAST_GAIN, _LIMITED_AT_FIRST, _LIMITED, _NEARLY = 1e-2, 1e-9, 1e-12, 0.8
# Solutions are corrected, so often at most, as long as that helps by such a factor.
_CORRECTIONS, _HELP = 3, 0.2
# Digits by which a step reduces it otherwise, and those from which another solution is a start.
_GAIN, _GOOD_START = 14.0, 10.0
# Bits of residuals beyond those that a step gains.
_GUARD_BITS = 40


@dataclass(frozen=True, eq=False)
class Refined:
    """A solution of the least-squares problem.

    Attributes
    ----------
    problem : LeastSquares
    newton : list of (K, k) complex
        The coefficients of the Newton bases, in double precision.
    jumps : (n_interfaces,) float
        The largest jump at the nodes of each interface, as logarithm to the base 10.
    """

    problem: LeastSquares
    newton: list[Complexes]
    jumps: Floats
    _expansion: Expansion
    _before: Series | None
    _last: tuple[list[Complexes], int]

    @cached_property
    def series(self) -> Series:
        """The power series with all the digits that were computed."""
        return self._expansion.added(self._before, *self._last)

    @property
    def residual(self) -> float:
        """The largest jump at a node, as logarithm to the base 10."""
        return float(self.jumps.max())

    @property
    def expected_digits(self) -> float:
        """About as many digits as the energies will have: they add up the squares of jumps."""
        # The mean jump on an interface is about a third of the largest one, mostly.
        total = np.sum(10.0 ** (2.0 * (self.jumps - self.residual) - 1.0))
        return -float(np.log10(total)) - 2.0 * self.residual

    def approximate_energies(self) -> Floats:
        """The energies of the forms in double precision, from jumps of potentials and fluxes.

        A harmonic u has ∫ |∇u|² = Σ J ∫ ∂_n u over the interfaces, ∂_n seen from the first side.
        """
        trial = self.problem.trial
        nodes = trial.nodes
        flux = np.concatenate([(phi @ a).imag for phi, a in zip(trial.slopes, self.newton)])
        first = nodes.side_of_row % 2 == 0
        total = np.zeros(nodes.cells.jumps.shape)
        weighted = nodes.weight[first, None] * flux[first]
        np.add.at(total, nodes.side_of_row[first] // 2, weighted)
        D = nodes.cells.jumps.T @ total
        return np.asarray(0.5 * (D + D.T), dtype=np.float64)

    @property
    def sizes(self) -> list[Floats]:
        """Sizes of the coefficients of the Newton basis of each cell, largest over all forms."""
        return [np.abs(a).max(axis=1, initial=0.0) for a in self.newton]


def refined(problem: LeastSquares, goal: float, before: Refined | None = None) -> Refined:
    """Solve until the residual is 10^−goal, or does not fall any more.

    Parameters
    ----------
    problem : LeastSquares
    goal : float
        Wanted decimal digits of the jumps.
    before : Refined, optional
        A solution whose trial functions are the first ones of ``problem``; if it is a good one, its
        jumps are where this one starts.
    """
    nodes = problem.trial.nodes
    expansion = Expansion(problem.trial, precision_of(goal))
    tables = PowerTables(lambda n: [flint.arb(2.0 * s - 1.0) for s in gauss_nodes(n)[0]])
    total = [np.zeros((K, nodes.cells.jumps.shape[1]), np.complex128) for K in problem.trial.size]
    series: Series | None = None
    best: Refined | None = None
    if before is not None and before.residual < -_GOOD_START:
        series = before.series
        for a, b in zip(total, before.newton):
            a[: len(b)] = b
        exponent, values, slopes = _residual(nodes, series, tables, before.residual)
    else:
        exponent, values = 0, _jump_rows(nodes)
        slopes = np.zeros(values.shape, dtype=np.complex128)
    while True:
        update, left = _corrected_solution(problem, values, slopes)
        total = [a + 2.0**exponent * b for a, b in zip(total, update)]
        jumps = np.log10(2.0) * exponent + np.log10(left)
        level, gain = float(jumps.max()), float(left.max())
        # As long as double precision is what limits a step, the next one gains as much.  What it
        # leaves otherwise is what the trial functions cannot do.
        near = level < -_NEARLY * goal
        done = gain > (_LIMITED_AT_FIRST if series is None else _LIMITED if near else np.inf)
        # What is no number ends it as well.
        if best is not None and not level < best.residual:
            return best
        best = Refined(problem, total, jumps, expansion, series, (update, exponent))
        if not (level > -goal and gain <= _LEAST_GAIN) or done:
            return best
        series = expansion.added(series, update, exponent)
        exponent, values, slopes = _residual(nodes, series, tables, level)


def precision_of(goal: float) -> int:
    """Bits in which jumps of 10^−goal are computed."""
    return int(3.33 * (goal + 8)) + 64


def _jump_rows(nodes: InterfaceNodes) -> Floats:
    jumps = np.empty((nodes.n_rows, nodes.cells.jumps.shape[1]))
    side = nodes.side_of_row
    jumps[:] = nodes.cells.jumps[side // 2]
    jumps[side % 2 == 1] *= -1.0
    return jumps


def _corrected_solution(
    problem: LeastSquares, values: Floats, slopes: Complexes
) -> tuple[list[Complexes], Floats]:
    """Solve, and solve again for what is left, in double precision; also the jumps left then.

    Of the jumps the largest on each interface are given.
    """
    update = problem.solve(values, slopes)
    left = _left(problem, update, values, slopes)
    size = _largest(problem, left)
    for _ in range(_CORRECTIONS):
        corrected = [a + b for a, b in zip(update, problem.solve(*left))]
        left = _left(problem, corrected, values, slopes)
        smaller = _largest(problem, left)
        before, after = size.max(), smaller.max()
        if after < before:
            update, size = corrected, smaller
        if not after < _HELP * before:
            break
    return update, size


def _largest(problem: LeastSquares, jumps: tuple[Floats, Complexes]) -> Floats:
    nodes = problem.trial.nodes
    largest = np.full(nodes.cells.n_interfaces, 1e-300)
    for part in jumps:
        np.maximum.at(largest, nodes.side_of_row // 2, np.abs(part).max(axis=1))
    return largest


def _left(
    problem: LeastSquares, newton: list[Complexes], wanted: Floats, slopes: Complexes
) -> tuple[Floats, Complexes]:
    """The jumps that a solution leaves, in double precision, in the rows of both sides."""
    trial, other = problem.trial, problem.trial.nodes.opposite
    values = np.concatenate([(phi @ a).real for phi, a in zip(trial.values, newton)])
    G = np.concatenate([phi @ a for phi, a in zip(trial.slopes, newton)])
    return wanted - values + values[other], slopes - G - G[other]


def _residual(
    nodes: InterfaceNodes, series: Series, tables: PowerTables, level: float
) -> tuple[int, Floats, Complexes]:
    """The jumps that are left, about 10^level, with the digits that a step gains."""
    bits = int(3.33 * (_GAIN - level)) + _GUARD_BITS
    with flint.ctx.workprec(bits + series.excess_bits):
        return _jumps(nodes, series, tables, int(np.rint(level / np.log10(2.0))))


def _jumps(
    nodes: InterfaceNodes, series: Series, tables: PowerTables, expected: int
) -> tuple[int, Floats, Complexes]:
    """The jumps that are left, divided by 2^exponent; rows as ``LeastSquares.solve`` wants them.

    They are about 2^expected, so that divided by that they are floats that do not underflow.
    """
    cells, k = nodes.cells, series.n_forms
    n_nodes = nodes.n_nodes.tolist()
    defects: list[flint.arb_mat | None] = [None] * cells.n_interfaces
    for i, other in star_traces(series, tables, n_nodes):
        defects[i] = _defect(series, tables, i, n_nodes[i], other)
    for i in range(cells.n_chords, cells.n_interfaces):
        other = face_trace(series.on_segment(i, 1), tables, n_nodes[i], 1)
        defects[i] = _defect(series, tables, i, n_nodes[i], other)
    scale = flint.arb(2) ** -expected
    values = np.empty((nodes.n_rows, k))
    slopes = np.empty((nodes.n_rows, k), dtype=np.complex128)
    for i, defect in enumerate(defects):
        entries = [float(x) for x in (defect.mid() * scale).entries()]  # type: ignore[union-attr]
        table = np.array(entries).reshape(-1, 3 * k)
        for side, sign in ((0, 1.0), (1, -1.0)):
            values[nodes.rows(i, side)] = sign * table[:, :k]
            slopes[nodes.rows(i, side)] = table[:, k : 2 * k] + 1j * table[:, 2 * k :]
    largest = max(np.abs(values).max(initial=0.0), np.abs(slopes).max(initial=0.0))
    unit = int(np.frexp(largest)[1])
    return expected + unit, np.ldexp(values, -unit), slopes * 2.0**-unit


def _defect(
    series: Series, tables: PowerTables, i: int, n: int, other: flint.arb_mat
) -> flint.arb_mat:
    """What is missing: J − [u], and minus the sum of the two G, at the nodes of an interface."""
    here = face_trace(series.on_segment(i, 0), tables, n, 0)
    k = series.n_forms
    signs = [-1] * k + [1] * (2 * k)
    jump = [int(j) for j in series.cells.jumps[i]] + [0] * (2 * k)
    rows = [
        [j - a - s * b for a, b, s, j in zip(x, y, signs, jump)]
        for x, y in zip(here.tolist(), other.tolist())
    ]
    return flint.arb_mat(rows)


class Expansion:
    """From coefficients of Newton bases to those of power series.

    Σ a_k φ_k is summed by halves, Σ_{k<m} + (φ_m/φ_0) Σ_{k≥m}, so that few products of long
    polynomials remain, whose factors φ_m/φ_l are the same for all forms and all steps.
    """

    def __init__(self, trial: TrialFunctions, bits: int) -> None:
        """Results will have absolute errors of 2^−bits at most."""
        self.trial, self.bits = trial, bits
        self._factors: list[dict[tuple[int, int], flint.acb_poly]] = []
        self._bits: list[int] = []
        for size in trial.size.tolist():
            self._factors.append({})
            self._bits.append(bits + size)

    def added(self, series: Series | None, update: list[Complexes], exponent: int) -> Series:
        """Add coefficients of Newton bases, times 2^exponent, to power series.

        Raises
        ------
        ComplexError
            If they are no numbers.
        """
        if not all(np.isfinite(a).all() for a in update):
            raise ComplexError("the coefficients of the series are not finite.")
        scale = flint.arb(2) ** exponent
        found = []
        for cell, a in enumerate(update):
            check_time()
            forms = [self._expanded(cell, column) for column in a.T.tolist()]
            # Coefficients may be large and cancel each other; errors are to be small as they are.
            with flint.ctx.workprec(self.bits + max(0, exponent + largest_exponent(chain(*forms)))):
                if series is None:
                    found.append([[(c * scale).mid() for c in form] for form in forms])
                    continue
                before = series.coefficients[cell]
                found.append(
                    [
                        [(b + c * scale).mid() for b, c in zip_longest(x, y, fillvalue=Acb(0))]
                        for x, y in zip(before, forms)
                    ]
                )
        return Series(self.trial.nodes.cells, found)

    def _expanded(self, cell: int, a: list[complex]) -> list[Acb]:
        while True:
            with flint.ctx.workprec(self._bits[cell]):
                c = self._sum(cell, a, 0, len(a)).coeffs()
            if all(max(x.real.rad(), x.imag.rad()) < 2.0**-60 for x in c):
                return c + [Acb(0)] * (len(a) - len(c))
            self._bits[cell] += len(a)
            self._factors[cell].clear()

    def _sum(self, cell: int, a: list[complex], first: int, end: int) -> flint.acb_poly:
        """Σ a_k φ_k / φ_first over first ≤ k < end."""
        if end == first + 1:
            return flint.acb_poly([a[first]])
        middle = (first + end) // 2
        head, tail = self._sum(cell, a, first, middle), self._sum(cell, a, middle, end)
        return head + self._factor(cell, first, middle) * tail

    def _factor(self, cell: int, first: int, end: int) -> flint.acb_poly:
        """φ_end / φ_first."""
        known = self._factors[cell]
        if (first, end) not in known:
            if end == first + 1:
                w, s = self.trial.points[cell][first], float(self.trial.factors[cell][first])
                known[first, end] = flint.acb_poly([-Acb(complex(w)) * s, Acb(s)])
            else:
                middle = (first + end) // 2
                left, right = self._factor(cell, first, middle), self._factor(cell, middle, end)
                known[first, end] = left * right
        return known[first, end]
