r"""Closed forms on the whole surface, and their energies in balls.

The series of neighbouring cells do not quite agree.  They are made to: on each segment one trace g
is the *master*, and in the triangle from the origin of a cell to the segment R(s) the function
u + t δ(s), at the point t R(s), with δ = g − u, takes the place of u.  It is continuous over the
whole surface, up to the integer jumps of the cochain, and piecewise smooth, so its differential is
a closed form in the class of the cochain: Dirichlet's principle applies whatever u is.

* On a gap the master is the trace of the face of the first side.
* On a chord it is the trace of the face, plus the linear function that gives it the right values
  at both ends.  The value at a point of an edge is that of one of the two faces there, the face of
  the smaller half-edge.

As u is harmonic in its cell, the energy of u + tδ is an integral over its boundary,

.. math:: D_{ij} = \sum \int_0^1 \bigl[ g_i \,\mathrm{Im}\, G_j + g_j \,\mathrm{Im}\, G_i
          - \tfrac12 (u_i \,\mathrm{Im}\, G_j + u_j \,\mathrm{Im}\, G_i) \bigr] ds + E_{ij},

.. math:: E_{ij} = \sum \tfrac12 \int_0^1 \Bigl[
          \frac{(\delta_i - (s - x) \delta_i')(\delta_j - (s - x)\delta_j')}{\lambda}
          + \lambda\, \delta_i' \delta_j' \Bigr] ds,

λ the height of the triangle over its base and x the foot of the height.  Everything here is in
balls; the quadrature is that of :mod:`igl_periods.enclosures.quadrature`.
"""

from __future__ import annotations

from collections.abc import Iterator

import flint

from igl_periods.run_log import progress

from .quadrature import SegmentBounds, gauss_balls, shape
from .series import PowerTables, Series, face_trace, star_traces
from .triangulation import Triangulation, following

Arb = flint.arb
ArbMat = flint.arb_mat
Polynomials = list[flint.acb_poly]
Correction = tuple[list[Arb], list[Arb]]
Rows = list[list[Arb]]

# The energy of the mismatch is small, and needs few digits.
_MISMATCH_BITS = 64
_ROWS_AT_ONCE = 4_000


def dirichlet_enclosure(surface: Triangulation, series: Series, accuracy: float) -> ArbMat:
    """The energies of the conforming forms, in balls; (k, k).

    Parameters
    ----------
    surface : Triangulation
        The one that was cut into the cells of ``series``.
    series : Series
    accuracy : float
        The natural logarithm of the error of a quadrature that does not matter.
    """
    energies = _Energies(surface, series, accuracy)
    return energies.total()


class _Energies:
    """The sum over all segments, in portions."""

    def __init__(self, surface: Triangulation, series: Series, accuracy: float) -> None:
        self.series, self.cells = series, series.cells
        self.k = series.n_forms
        self.tables = PowerTables(lambda n: gauss_balls(n)[0])
        n = self.cells.n_chords
        self.traces = [series.on_segment(i, 0) for i in range(n)]
        self.corrections = _corrections(surface, series, self.traces)
        self.accuracy = accuracy
        self.bounds = SegmentBounds(series)
        self.rules = [
            self.bounds.chord_rule(i, face, accuracy) for i, face in enumerate(self.traces)
        ]
        self.left: Rows = []
        self.right: Rows = []
        self.half = ArbMat(self.k, self.k)
        self.mismatch = ArbMat(self.k, self.k)
        self.error = ArbMat(self.k, self.k)

    def total(self) -> ArbMat:
        """Add up everything."""
        counts = [rule.n_nodes for rule in self.rules]
        for done, (i, star) in enumerate(star_traces(self.series, self.tables, counts)):
            progress("chords", done, self.cells.n_chords)
            self._chord(i, star)
        for i in range(self.cells.n_chords, self.cells.n_interfaces):
            progress("gaps", i - self.cells.n_chords, self.cells.n_interfaces - self.cells.n_chords)
            self._gap(i)
        self._flush()
        D = self.half + self.half.transpose() + self.mismatch
        return ArbMat(
            [
                [x + Arb(0, e) for x, e in zip(row, errors)]
                for row, errors in zip(D.tolist(), self.error.tolist())
            ]
        )

    def _chord(self, i: int, star: ArbMat) -> None:
        k, rule = self.k, self.rules[i]
        polynomials, (alpha, beta) = self.traces[i], self.corrections[i]
        jump = [int(j) for j in self.cells.jumps[i]]
        nodes, weights = gauss_balls(rule.n_nodes)
        face = face_trace(polynomials, self.tables, rule.n_nodes, 0).tolist()
        height, foot = shape(self.cells.start[i][1], self.cells.end[i][1])
        slanted, sloping = [], []
        for t, w, here, there in zip(nodes, weights, face, star.tolist()):
            s = (1 + t) / 2
            correction = [a + b * s for a, b in zip(alpha, beta)]
            delta = [u + c - j - v for u, c, j, v in zip(here, correction, jump, there)]
            # Along the star's side, which runs the other way, −δ′.
            slope = [x + b + y for x, b, y in zip(here[k : 2 * k], beta, there[k : 2 * k])]
            self.left.append([w * (u / 2 + c) for u, c in zip(here, correction)])
            self.left.append([w * (d + v / 2) for d, v in zip(delta, there)])
            self.right += [here[2 * k :], there[2 * k :]]
            slanted.append((w, [d + (1 - s - foot) * e for d, e in zip(delta, slope)]))
            sloping.append((w, slope))
        self._add_mismatch(slanted, sloping, height)
        self.error += self.bounds.chord_error(i, polynomials, (alpha, beta), rule)
        height, foot = shape(self.cells.start[i][0], self.cells.end[i][0])
        tilted = [a + b * foot for a, b in zip(alpha, beta)]
        self._add_mismatch([(Arb(1), tilted)], [(Arb(1), beta)], height)
        self._flush(_ROWS_AT_ONCE)

    def _gap(self, i: int) -> None:
        k = self.k
        first, second = self.series.on_segment(i, 0), self.series.on_segment(i, 1)
        jump = [int(j) for j in self.cells.jumps[i]]
        rule = self.bounds.gap_rule(first, second, self.accuracy)
        n = rule.n_nodes
        nodes, weights = gauss_balls(n)
        height, foot = shape(self.cells.start[i][1], self.cells.end[i][1])
        here_rows = face_trace(first, self.tables, n, 0).tolist()
        there_rows = face_trace(second, self.tables, n, 1).tolist()
        slanted, sloping = [], []
        for t, w, here, there in zip(nodes, weights, here_rows, there_rows):
            s = (1 + t) / 2
            delta = [u - j - v for u, j, v in zip(here, jump, there)]
            slope = [x + y for x, y in zip(here[k : 2 * k], there[k : 2 * k])]
            self.left.append([w * u / 2 for u in here[:k]])
            self.left.append([w * (d + v / 2) for d, v in zip(delta, there)])
            self.right += [here[2 * k :], there[2 * k :]]
            slanted.append((w, [d + (1 - s - foot) * e for d, e in zip(delta, slope)]))
            sloping.append((w, slope))
        self._add_mismatch(slanted, sloping, height)
        self.error += self.bounds.gap_error(i, first, second, rule)
        self._flush(_ROWS_AT_ONCE)

    def _add_mismatch(
        self,
        slanted: list[tuple[Arb, list[Arb]]],
        sloping: list[tuple[Arb, list[Arb]]],
        height: Arb,
    ) -> None:
        """E of one segment, from δ − (s − x) δ′ and δ′ at the nodes, with weights."""
        with flint.ctx.workprec(_MISMATCH_BITS):
            for rows, factor in ((slanted, 1 / (2 * height)), (sloping, height / 2)):
                right = ArbMat([row for _, row in rows])
                left = ArbMat([[factor * w * x for x in row] for w, row in rows])
                self.mismatch += left.transpose() * right

    def _flush(self, at_least: int = 1) -> None:
        if len(self.left) >= at_least:
            self.half += ArbMat(self.left).transpose() * ArbMat(self.right)
            self.left, self.right = [], []


def _corrections(
    surface: Triangulation, series: Series, traces: list[Polynomials]
) -> list[Correction]:
    """α and β of the linear function α + β s that corrects the face's trace on each chord."""
    jumps = series.cells.jumps.tolist()
    zero = [Arb(0)] * series.n_forms
    at_start, at_end = [zero] * len(traces), [zero] * len(traces)
    ends = [
        [[p(flint.acb(t)).real for p in polynomials] for t in (-1, 1)] for polynomials in traces
    ]
    for corner, other in shared_ends(surface):
        # The end of the chord at ``corner`` is the start of the one at ``other``.
        here, there = ends[corner][1], ends[other][0]
        excess = [a - j - (b - m) for a, b, j, m in zip(here, there, jumps[corner], jumps[other])]
        if following(following(corner)) < following(other):
            at_start[other] = excess
        else:
            at_end[corner] = [-x for x in excess]
    return [(a, [y - x for x, y in zip(a, b)]) for a, b in zip(at_start, at_end)]


def shared_ends(surface: Triangulation) -> Iterator[tuple[int, int]]:
    """Each corner with the one before it around the vertex, across the side that leaves it."""
    for corner in range(len(surface.twin)):
        leaving = following(following(corner))
        yield corner, following(following(surface.twin[leaving]))
