r"""Power series of all cells in balls, and their traces on segments.

On every cell a form has a function u = Re F, F = Σ c_k w^k, with exact midpoints c_k; there is no
truncation, since F *is* this polynomial.  On a segment with parameter s in [0, 1], counterclockwise
around the cell, G = dF/ds gives both derivatives: ∂_s u = Re G, and Im G ds is the flux of the
gradient out of the cell.  The *trace* of k forms at a node is the row

.. math:: (u_1, \dots, u_k,\ \mathrm{Re}\, G_1, \dots, \mathrm{Re}\, G_k,\
           \mathrm{Im}\, G_1, \dots, \mathrm{Im}\, G_k).

In a face F is a polynomial of t = 2s − 1 on the segment, found by composition; all segments share
the powers of the nodes.  In a star the powers of w are not polynomials of s.  They are taken about
the chord's own triangle, ω = (ζ/R)^κ, the turn φ₀ passing to the coefficients, so that congruent
chords share one table.  The powers are found by halving the exponent, ω^k = ω^⌊k/2⌋ ω^⌈k/2⌉:
rectangular balls grow by up to √2 with every product, so repeated multiplication by ω would blow
them up exponentially.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import zip_longest

import flint
import numpy as np

from igl_periods.arrays import Floats

from .cells import Cells
from .exact_arithmetic import exponent_of
from .limits import check_time

Arb = flint.arb
Acb = flint.acb
ArbMat = flint.arb_mat

# The rows of a table that are held at once, times their length.
_ENTRIES_AT_ONCE = 1_000_000
# Polynomials are filled up with zeros to multiples of this, so that they share tables.
_LENGTH_UNIT = 16


@dataclass(frozen=True, eq=False)
class Series:
    """Power series on the cells of a surface.

    Attributes
    ----------
    cells : Cells
    coefficients : list of list of list of acb
        c_k of each form on each cell: cell, form, k.
    """

    cells: Cells
    coefficients: list[list[list[Acb]]]

    @property
    def n_forms(self) -> int:
        """Number of forms."""
        return self.cells.jumps.shape[1]

    @cached_property
    def excess_bits(self) -> int:
        """Bits by which terms are larger than the functions: they cancel each other.

        Where a vertex is closer to the origin of a cell than the farthest corner of the cell is,
        the coefficients grow with k.  On a side of a face they become those of a polynomial of t,
        from terms c_k (α + βt)^k as large as |c_k| (|α| + |β|)^k, and |α| + |β| may be above 1.
        Whoever evaluates a series needs so many bits more.
        """
        bits = 0.0
        for forms, reach in zip(self.coefficients, self._reaches().tolist()):
            sizes = [largest_exponent(column) for column in zip_longest(*forms, fillvalue=Acb(0))]
            terms = np.array(sizes) + np.log2(reach) * np.arange(len(sizes))
            bits = max(bits, float(terms.max()))
        return math.ceil(bits)

    def _reaches(self) -> Floats:
        """The largest |α| + |β| on the sides of each cell; 1 for stars, whose w is at most 1."""
        cells = self.cells
        a, b = cells.ends[..., 0], cells.ends[..., 1]
        reach = (0.5 * (abs(a + b) + abs(b - a)) / cells.scale[cells.cell]).ravel()
        largest = np.ones(cells.n_cells)
        np.maximum.at(largest, cells.cell.ravel(), reach)
        largest[: cells.n_stars] = 1.0
        return largest

    def length(self, cell: int) -> int:
        """The number K of coefficients on a cell."""
        return len(self.coefficients[cell][0])

    def on_segment(self, i: int, side: int) -> list[flint.acb_poly]:
        """The polynomials F(t) of the forms of a face, t = 2s − 1 along the first side."""
        cells = self.cells
        cell = cells.cell[i, side]
        a, b = cells.start[i][side], cells.end[i][side]
        if side == 1:
            a, b = b, a
        size = 2 * Arb(float(cells.scale[cell]))
        return _composed(self.coefficients[cell], (a + b) / size, (b - a) / size)


def _composed(forms: list[list[Acb]], alpha: Acb, beta: Acb) -> list[flint.acb_poly]:
    """The polynomials Σ c_k (α + βt)^k of several forms with equally many coefficients.

    Their coefficients are β^j / j! Σ_k (k! c_k) α^(k−j) / (k−j)!, for each form one product.
    """
    length = len(forms[0])
    factorials = [Arb(math.factorial(k)) for k in range(length)]
    shift = flint.acb_poly([x / f for x, f in zip(powers_of(alpha, length), factorials)])
    scale = [x / f for x, f in zip(powers_of(beta, length), factorials)][::-1]
    composed = []
    for form in forms:
        backwards = flint.acb_poly([c * f for c, f in zip(form, factorials)][::-1])
        product = backwards * shift
        found = [product[j] * scale[j] for j in range(length)]
        composed.append(flint.acb_poly(found[::-1]))
    return composed


def largest_exponent(numbers: Iterable[Acb]) -> int:
    """The least e with real and imaginary parts below 2^e; 0 for none."""
    parts = (x for c in numbers for x in (c.real, c.imag))
    return max((exponent_of(x) for x in parts), default=0)


class PowerTables:
    """Powers of nodes t in [−1, 1], made once for each number of nodes and precision."""

    def __init__(self, nodes: Callable[[int], Sequence[Arb]]) -> None:
        """``nodes(n)`` gives the values of t on an interface with n nodes."""
        self.nodes = nodes
        self._tables: dict[tuple[int, int, int], ArbMat] = {}

    def table(self, n: int, length: int) -> ArbMat:
        """t^k for all nodes t and k < length."""
        key = n, length, flint.ctx.prec
        if key not in self._tables:
            t = list(self.nodes(n))
            columns = [[Arb(1)] * len(t)]
            for _ in range(1, length):
                columns.append([x * y for x, y in zip(columns[-1], t)])
            self._tables[key] = ArbMat(columns).transpose()
        return self._tables[key]


def face_trace(polynomials: list[flint.acb_poly], powers: PowerTables, n: int, side: int) -> ArbMat:
    """The traces of a face on a side, in the nodes' order along the first side; (n, 3 k)."""
    check_time()
    # s runs against t on the second side.
    slopes = [(2 if side == 0 else -2) * p.derivative() for p in polynomials]
    length = max(1, *(p.length() for p in polynomials))
    length += -length % _LENGTH_UNIT
    columns = [_padded([c.real for c in p.coeffs()], length) for p in polynomials]
    derivatives = [p.coeffs() for p in slopes]
    columns += [_padded([c.real for c in d], length) for d in derivatives]
    columns += [_padded([c.imag for c in d], length) for d in derivatives]
    return powers.table(n, length) * ArbMat(columns).transpose()


def _padded(values: list[Arb], length: int) -> list[Arb]:
    return values + [Arb(0)] * (length - len(values))


def star_traces(
    series: Series, powers: PowerTables, n_nodes: Sequence[int]
) -> Iterator[tuple[int, ArbMat]]:
    """The traces of the stars on all chords, in the nodes' order along the first side.

    Parameters
    ----------
    n_nodes : sequence of int
        The number of nodes of each interface.

    Yields
    ------
    i, trace : int, (n, 3 k) arb_mat
    """
    for alike in _congruent_chords(series.cells, n_nodes):
        rays = _Rays.of(series.cells, alike[0], powers.nodes(n_nodes[alike[0]]))
        length = max(series.length(int(series.cells.cell[i, 1])) for i in alike)
        products = _products(rays, [_rotated(series, i, length) for i in alike], length)
        for i, product in zip(alike, products):
            yield i, _with_slopes(product, rays.slope, series.n_forms)


def _congruent_chords(cells: Cells, n_nodes: Sequence[int]) -> list[list[int]]:
    """Chords whose stars see the same powers at their nodes, bit by bit."""
    alike: dict[object, list[int]] = {}
    for i in range(cells.n_chords):
        star = int(cells.cell[i, 1])
        ends = cells.start[i][1], cells.end[i][1]
        key = (
            n_nodes[i],
            float(cells.scale[star]),
            _bits(cells.exponent[star]),
            *(_bits(x) for z in ends for x in (z.real, z.imag)),
        )
        alike.setdefault(key, []).append(i)
    return list(alike.values())


def _bits(x: Arb) -> tuple[object, ...]:
    return *(int(m) for m in x.mid().man_exp()), *(int(m) for m in x.rad().man_exp())


@dataclass(frozen=True, eq=False)
class _Rays:
    """The points of a chord as seen from the vertex: ω = (ζ/R)^κ, and (dω/ds)/ω = κ e/ζ."""

    omega: list[Acb]
    slope: list[Acb]

    @classmethod
    def of(cls, cells: Cells, i: int, nodes: Sequence[Arb]) -> _Rays:
        star = int(cells.cell[i, 1])
        a, b = cells.start[i][1], cells.end[i][1]
        kappa, unit = cells.exponent[star], Arb(float(cells.scale[star]))
        # The second side runs against the first one: s = (1 − t)/2.
        middle, half = (a + b) / 2, (a - b) / 2
        zeta = [middle + t * half for t in nodes]
        rate = kappa * (b - a)
        return cls([((z / unit).log() * kappa).exp() for z in zeta], [rate / z for z in zeta])


def _rotated(series: Series, i: int, length: int) -> list[list[Acb]]:
    """The coefficients in terms of ω: c_k exp(i k κ φ₀)."""
    star = int(series.cells.cell[i, 1])
    angle = series.cells.exponent[star] * series.cells.turn[i]
    rotation = powers_of(Acb(angle.cos(), angle.sin()), length)
    return [
        [c * r for c, r in zip(form, rotation)] + [Acb(0)] * (length - len(form))
        for form in series.coefficients[star]
    ]


def powers_of(x: Acb, n: int) -> list[Acb]:
    """x^0 … x^(n−1), each from two powers of about half the exponent."""
    powers = [Acb(1), x]
    for k in range(2, n):
        powers.append(powers[k // 2] * powers[k - k // 2])
    return powers[:n]


def _products(
    rays: _Rays, coefficients: list[list[list[Acb]]], length: int
) -> list[list[list[Arb]]]:
    """U and dF/dlog ω of the forms of several stars at the same points; (n, 3 k) each."""
    columns = [column for forms in coefficients for column in _real_columns(forms)]
    right = ArbMat(columns).transpose()
    width = len(columns) // len(coefficients)
    rows: list[list[Arb]] = []
    portion = max(1, _ENTRIES_AT_ONCE // (2 * length))
    for first in range(0, len(rays.omega), portion):
        check_time()
        table = _table(rays.omega[first : first + portion], length)
        rows += (table * right).tolist()
    starts = range(0, len(columns), width)
    return [[row[first : first + width] for row in rows] for first in starts]


def _table(omega: list[Acb], length: int) -> ArbMat:
    """Real and imaginary parts of the powers of some points; (n, 2 length)."""
    columns: list[list[Acb]] = [[Acb(1)] * len(omega), omega][:length]
    for k in range(2, length):
        columns.append([x * y for x, y in zip(columns[k // 2], columns[k - k // 2])])
    rows = [[x.real for x in column] for column in columns]
    rows += [[x.imag for x in column] for column in columns]
    return ArbMat(rows).transpose()


def _real_columns(forms: list[list[Acb]]) -> list[list[Arb]]:
    """Columns that take the real rows of the table to u, Re H and Im H, H = Σ k c_k ω^k."""
    slopes = [[k * c for k, c in enumerate(form)] for form in forms]
    values = [[c.real for c in form] + [-c.imag for c in form] for form in forms]
    real = [[c.real for c in form] + [-c.imag for c in form] for form in slopes]
    imaginary = [[c.imag for c in form] + [c.real for c in form] for form in slopes]
    return values + real + imaginary


def _with_slopes(rows: list[list[Arb]], slope: list[Acb], k: int) -> ArbMat:
    """Multiply H by κ e/ζ, so that it becomes G."""
    traces = []
    for row, rate in zip(rows, slope):
        G = [Acb(x, y) * rate for x, y in zip(row[k : 2 * k], row[2 * k :])]
        traces.append(row[:k] + [z.real for z in G] + [z.imag for z in G])
    return ArbMat(traces)
