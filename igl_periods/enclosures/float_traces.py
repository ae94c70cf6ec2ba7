r"""Traces of power series in floating point with proved errors, for all cells at once.

A few digits take short series on many cells, and arithmetic of any precision is slow there.  Here
the coefficients c_k *are* complex doubles, and a row of powers times the coefficients of all forms
is one matrix product, in the longest floating-point numbers that the processor has.  Its errors are
known beforehand.  Let |w| ≤ W on the cell, w known to ε, and let u be the unit of rounding.  A
complex product is off by at most 3u relative to it, so that the computed w^k is off by at most
4ku W^k + kε W^{k−1}, and a sum of K products by γ_n of the sum of their sizes, n = 2K + 4.  Hence

.. math:: |\widetilde F - F| \le \sum_k |c_k|
          \bigl( (\gamma_n + 4ku)\, W^k + k \varepsilon W^{k-1} \bigr),

and the same with k c_k in the place of c_k for Σ k c_k w^k, which gives the derivative.

Constants c_0 are kept apart.  The flux of a harmonic function out of a cell is 0, so that the
energy of a cell does not see the constant, and errors are those of functions as small as the cell.
"""

from __future__ import annotations

from dataclasses import dataclass

import flint
import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.errors import ComplexError
from igl_periods.proofs import UNIT

from .cells import Cells
from .limits import check_time
from .trial_functions import TrialFunctions

# Factor that covers the rounding of sums of positive numbers, and of bounds of bounds.
UP = 1.0 + 2.0**-30
TINY = 2.0**-1000
LongFloats = NDArray[np.longdouble]
LongComplexes = NDArray[np.clongdouble]
# Rounding of the processor's longest floating-point numbers.
LONG_UNIT = float(np.finfo(np.longdouble).eps) / 2.0
# Errors of w in faces, a linear function of a node: few roundings of numbers up to 1; in stars, of
# a ball that is rounded; and of what turns sums into derivatives.
_FACE_ERROR, _STAR_ERROR = 12.0 * LONG_UNIT, 4.0 * LONG_UNIT
STAR_BITS = 96
_LEAST_STAR_BITS = 68


def coefficients_in_floats(trial: TrialFunctions, newton: list[Complexes]) -> list[Complexes]:
    """Power series of the Newton bases' sums, rounded to doubles; (K, k) for each cell."""
    found: list[Complexes] = list(newton)
    for K in np.unique(trial.size):
        alike = np.flatnonzero(trial.size == K)
        points = np.array([trial.points[c] for c in alike])
        factors = np.array([trial.factors[c] for c in alike])
        a = np.array([newton[c] for c in alike])
        # Horner's rule for polynomials: total ← total · σ_k (w − w_k) + a_k.
        total = np.zeros_like(a)
        total[:, 0] = a[:, K - 1]
        for k in range(K - 2, -1, -1):
            shifted = np.zeros_like(total)
            shifted[:, 1:] = total[:, :-1]
            total = factors[:, k, None, None] * (shifted - points[:, k, None, None] * total)
            total[:, 0] += a[:, k]
        for c, series in zip(alike.tolist(), total):
            found[c] = series
    return found


@dataclass(frozen=True, eq=False)
class Points:
    """Points of cells: w within ``error``, and what turns Σ k c_k w^k (w^{k−1}) into dF/ds.

    Attributes
    ----------
    cell : (n,) int
    w : (n,) long complex
    error : float
    factor : (n,) long complex
        dw/ds in faces, (dw/ds)/w in stars.
    factor_error : (n,) float
    """

    cell: Ints
    w: LongComplexes
    error: float
    factor: LongComplexes
    factor_error: Floats


@dataclass(frozen=True, eq=False)
class Traces:
    """u − Re c_0 and G = dF/ds of all forms at some points, with bounds of their errors.

    Attributes
    ----------
    u : (n, k) float
    u_error : (n, k) float
    G : (n, k) complex
    G_error : (n, k) float
        Of the real and of the imaginary part.
    """

    u: Floats
    u_error: Floats
    G: Complexes
    G_error: Floats


class LongEnds:
    """The corners of all cells, as long floating-point numbers; rounded balls."""

    def __init__(self, cells: Cells) -> None:
        """Round the ends of all sides, and κ of all stars."""
        self.cells = cells
        ends = [
            z
            for pair in zip(cells.start, cells.end)
            for side in range(2)
            for z in _side(pair, side)
        ]
        self.ends = _long_complex(ends).reshape(-1, 2, 2)
        self.exponents = _long([kappa.mid() for kappa in cells.exponent])

    def face_points(self, interface: Ints, side: int, t: LongFloats) -> Points:
        """Points of faces, at t along the first side of an interface."""
        cell = self.cells.cell[interface, side]
        start, end = self.ends[interface, side].T
        if side == 1:
            start, end = end, start
        scale = self.cells.scale[cell]
        edge = end - start
        w = (start + end + t * edge) / (2 * scale)
        # s runs against t on the second side.
        factor = (edge if side == 0 else -edge) / scale
        return Points(cell, w, _FACE_ERROR, factor, np.full(t.size, _FACE_ERROR))

    def star_points(
        self, chords: Ints, counts: Ints, nodes: dict[int, list[flint.arb]], t: LongFloats
    ) -> Points:
        """Points of stars, at the nodes of some chords along their first sides."""
        cells, w = self.cells, []
        with flint.ctx.workprec(STAR_BITS):
            for i, n in zip(chords.tolist(), counts.tolist()):
                check_time()
                star = int(cells.cell[i, 1])
                kappa, turn = cells.exponent[star], flint.acb(0, cells.turn[i])
                a, b = cells.start[i][1], cells.end[i][1]
                size = 2 * flint.arb(float(cells.scale[star]))
                middle, half = (a + b) / size, (a - b) / size
                balls = [(((middle + x * half).log() + turn) * kappa).exp() for x in nodes[n]]
                if min(z.rel_accuracy_bits() for z in balls) < _LEAST_STAR_BITS:
                    raise ComplexError(f"the angle at vertex {star} is too small for few digits.")
                w += balls
        row = np.repeat(chords, counts)
        star = cells.cell[row, 1]
        start, end = self.ends[row, 1].T
        zeta = (start + end - t * (end - start)) / 2
        factor = self.exponents[star] * (end - start) / zeta
        # ζ and e have errors of a few units relative to the size of the cell.
        kappa, relative = cells.exponents[star], cells.scale[star] / np.abs(zeta).astype(float)
        error = 64.0 * LONG_UNIT * (kappa + np.abs(factor).astype(float)) * (1.0 + relative)
        return Points(star, _long_complex(w), _STAR_ERROR, factor, error)


def _side(pair: tuple[tuple[flint.acb, flint.acb], ...], side: int) -> list[flint.acb]:
    return [pair[0][side], pair[1][side]]


def long_nodes(balls: list[flint.arb]) -> LongFloats:
    """Midpoints of balls as long floating-point numbers."""
    return _long([x.mid() for x in balls])


def _long(exact: list[flint.arb]) -> LongFloats:
    """Numbers rounded to long floating point, from two doubles each."""
    with flint.ctx.workprec(2 * STAR_BITS):
        high = [float(x) for x in exact]
        low = [float((x - h).mid()) for x, h in zip(exact, high)]
    return np.array(high, dtype=np.longdouble) + np.array(low, dtype=np.longdouble)


def _long_complex(balls: list[flint.acb]) -> LongComplexes:
    real, imag = _long([z.real.mid() for z in balls]), _long([z.imag.mid() for z in balls])
    return real + 1j * imag


def traces(points: Points, coefficients: list[Complexes], of_stars: bool) -> Traces:
    """The traces of power series at some points, cell by cell."""
    k = coefficients[0].shape[1]
    n = points.w.size
    u, G = np.empty((n, k)), np.empty((n, k), dtype=np.complex128)
    u_error, G_error = np.empty((n, k)), np.empty((n, k))
    order = np.argsort(points.cell, kind="stable")
    ends = np.flatnonzero(np.diff(points.cell[order])) + 1
    for rows in np.split(order, ends):
        check_time()
        if rows.size == 0:
            continue
        c = coefficients[int(points.cell[rows[0]])].astype(np.clongdouble)
        c[0] = 0.0
        w, factor = points.w[rows], points.factor[rows, None]
        K = len(c)
        table = np.empty((rows.size, K), dtype=np.clongdouble)
        table[:, 0], table[:, 1:] = 1.0, w[:, None]
        np.multiply.accumulate(table, axis=1, out=table)
        slopes = np.arange(K)[:, None] * c
        # Where w^{k−1} stands for w^k the same bounds hold, since W ≥ 1.
        W = max((float(np.abs(w).max()) + points.error) * UP, 1.0)
        value_error, slope_error = _errors(_sizes(c), _sizes(slopes), W, points.error)
        values = (table @ c).real
        H = table @ slopes if of_stars else table[:, : K - 1] @ slopes[1:]
        size, q = np.abs(H).astype(np.float64), np.abs(factor).astype(np.float64)
        e_q = points.factor_error[rows, None]
        u[rows], G[rows] = values, H * factor
        # Rounding to double is part of the errors.
        u_error[rows] = (value_error + UNIT * np.abs(u[rows])) * UP
        rounded = (4 * LONG_UNIT + UNIT) * size * q
        G_error[rows] = (slope_error * (q + e_q) + size * e_q + rounded) * UP + TINY
    return Traces(u, u_error, G, G_error)


def _sizes(c: LongComplexes) -> Floats:
    return np.abs(c).astype(np.float64) * UP


def _errors(c: Floats, slopes: Floats, W: float, error: float) -> tuple[Floats, Floats]:
    """Bounds of the errors of Σ c_k w^k and Σ k c_k w^k, of each form."""
    K = len(c)
    k = np.arange(K)
    powers = np.multiply.accumulate(np.r_[1.0, np.full(K - 1, W)])
    weight = (2 * K + 8 + 4 * k) * LONG_UNIT * powers
    weight[1:] += k[1:] * error * powers[:-1]
    return (weight @ c) * UP + TINY, (weight @ slopes) * UP + TINY
