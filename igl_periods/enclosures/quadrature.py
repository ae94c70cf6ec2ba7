r"""Gauss quadrature in balls, with a proved error.

On the sides of faces the integrands are polynomials of degree up to 2K, for which n ≥ K + 1 nodes
are exact; fewer are enough where their high coefficients are small.  On a chord seen from its star,
the integrand f continues analytically to the ellipse with foci at the ends of [0, 1] and half axes
adding up to ρ/2, as long as that ellipse does not meet the vertex, a branch point of ζ^κ.  If
|f| ≤ M there, then n nodes are wrong by at most

.. math:: 2 M \Bigl(1 + \frac{1}{4n^2 - 1}\Bigr) \frac{\rho^{-2n}}{1 - \rho^{-2}},

because the Chebyshev coefficients of f are at most 2Mρ^−k, the rule is exact up to degree 2n − 1,
its weights are positive, and odd functions are integrated exactly.

For the bound M: points of the ellipse have distances from the ends a, b of the chord that add up
to at most S = |e| (ρ + 1/ρ)/2, hence (|a| + |b| − S)/2 ≤ |ζ| ≤ (|a| + |b| + S)/2, and there

.. math:: |F| \le \sum |c_k| |w|^k, \qquad
          |dF/ds| \le \frac{\kappa |e|}{|\zeta|} \sum k |c_k| |w|^k.

A face's polynomial in t = 2s − 1 is bounded with |t| ≤ τ = (ρ + 1/ρ)/2 on any ellipse.  The real
part of an analytic function on the segment continues to one bounded by the same number.  How many
nodes and which ρ are good is chosen in floating point; the bound is computed in balls of 64 bits.
"""

from __future__ import annotations

from dataclasses import dataclass

import flint
import numpy as np

from igl_periods.arrays import Floats

from .series import Series

Arb = flint.arb

_BOUND_BITS = 64
_FRACTIONS = np.linspace(0.25, 0.95, 15)
_NODE_UNIT = 4
# τ of the ellipses that are tried on gaps.
_GAP_ELLIPSES = np.linspace(1.1, 3.5, 13)

_known: dict[tuple[int, int], tuple[list[Arb], list[Arb]]] = {}


def gauss_balls(n: int) -> tuple[list[Arb], list[Arb]]:
    """The nodes in [−1, 1], increasing, and the weights for [0, 1], at the working precision."""
    key = n, flint.ctx.prec
    if key not in _known:
        if len(_known) > 400:
            _known.clear()
        pairs = [Arb.legendre_p_root(n, k, weight=True) for k in range(n)]
        _known[key] = [x for x, _ in reversed(pairs)], [w / 2 for _, w in reversed(pairs)]
    return _known[key]


@dataclass(frozen=True, eq=False)
class Rule:
    """How a segment is integrated.

    Attributes
    ----------
    n_nodes : int
    ellipse : float
        ρ, or 0 where no number of nodes is enough.
    """

    n_nodes: int
    ellipse: float


@dataclass(frozen=True, eq=False)
class _Sizes:
    """Bounds of u and of dF/ds of all forms on an ellipse, seen from one cell."""

    values: list[Arb]
    slopes: list[Arb]


class SegmentBounds:
    """Bounds of the integrands on the segments of a surface."""

    def __init__(self, series: Series) -> None:
        """Take absolute values of all coefficients of stars, once."""
        self.series = series
        stars = series.coefficients[: series.cells.n_stars]
        with flint.ctx.workprec(_BOUND_BITS):
            self._sizes = [[[c.abs_upper() for c in form] for form in forms] for forms in stars]
        self._logs = [_logs(forms) for forms in self._sizes]

    def chord_rule(self, i: int, face: list[flint.acb_poly], accuracy: float) -> Rule:
        """Choose nodes on a chord for an error of about e^accuracy."""
        cells = self.series.cells
        a, b = (abs(complex(z)) for z in cells.ends[i, 1])
        edge = abs(complex(cells.ends[i, 1, 1] - cells.ends[i, 1, 0]))
        star = int(cells.cell[i, 1])
        kappa, scale, c = cells.exponents[star], float(cells.scale[star]), self._logs[star]
        p, k = _polynomial_logs(face), np.arange(c.size)
        found = []
        for tau in 1.0 + _FRACTIONS * ((a + b) / edge - 1.0):
            far, close = (a + b + edge * tau) / 2, (a + b - edge * tau) / 2
            terms = c + kappa * k * np.log(far / scale)
            slope = _log_sum(terms + np.log(np.maximum(k, 1))) + np.log(kappa * edge / close)
            # The flux may be larger than the value, and the mismatch contains both.
            star_size = np.logaddexp(_log_sum(terms), slope)
            value, slope = _face_logs(p, tau)
            inexact = _count(np.logaddexp(star_size, np.logaddexp(value, slope)), tau, accuracy)
            exact = max(_exact_count(face), _count(np.logaddexp(star_size, value), tau, accuracy))
            found.append((min(exact, inexact), _rho(tau)))
        return _fewest(found)

    def gap_rule(
        self, first: list[flint.acb_poly], second: list[flint.acb_poly], accuracy: float
    ) -> Rule:
        """Choose nodes on a gap for an error of about e^accuracy."""
        exact = _exact_count(first + second)
        logs = [_polynomial_logs(side) for side in (first, second)]
        found = [(exact, _rho(2.0))]
        for tau in _GAP_ELLIPSES:
            parts = [size for p in logs for size in _face_logs(p, tau)]
            size = _log_sum(np.array(parts))
            found.append((_count(size, tau, accuracy), _rho(tau)))
        return _fewest(found)

    def chord_error(
        self,
        i: int,
        face: list[flint.acb_poly],
        correction: tuple[list[Arb], list[Arb]],
        rule: Rule,
    ) -> flint.arb_mat:
        """Bounds of the errors of the integrals on both sides of a chord; (k, k)."""
        with flint.ctx.workprec(_BOUND_BITS):
            tau = _tau(rule)
            own, other = _face_sizes(face, tau), self._star_sizes(i, tau)
            corrections = [abs(a) + (1 + tau) / 2 * abs(b) for a, b in zip(*correction)]
            master = _Sizes(
                [g + c for g, c in zip(own.values, corrections)],
                [g + abs(b) for g, b in zip(own.slopes, correction[1])],
            )
            error = self._other_side(i, master, other, tau)
            if rule.n_nodes < _exact_count(face):
                half = [x / 2 + c for x, c in zip(own.values, corrections)]
                error += _both_ways(half, own.slopes)
            return _quadrature_factor(rule) * error

    def gap_error(
        self, i: int, first: list[flint.acb_poly], second: list[flint.acb_poly], rule: Rule
    ) -> flint.arb_mat:
        """Bounds of the errors of the integrals on both sides of a gap; (k, k)."""
        k = len(first)
        if rule.n_nodes >= _exact_count(first + second):
            return flint.arb_mat(k, k)
        with flint.ctx.workprec(_BOUND_BITS):
            tau = _tau(rule)
            own, other = _face_sizes(first, tau), _face_sizes(second, tau)
            error = self._other_side(i, own, other, tau)
            error += _both_ways([x / 2 for x in own.values], own.slopes)
            return _quadrature_factor(rule) * error

    def _star_sizes(self, i: int, tau: Arb) -> _Sizes:
        cells = self.series.cells
        star = int(cells.cell[i, 1])
        za, zb = cells.start[i][1], cells.end[i][1]
        edge, reach = abs(zb - za), abs(za) + abs(zb)
        far, close = (reach + edge * tau) / 2, (reach - edge * tau) / 2
        if not close > 0:
            raise AssertionError("the ellipse was chosen so that it does not meet the vertex")
        kappa = cells.exponent[star]
        w = ((far / Arb(float(cells.scale[star]))).log() * kappa).exp().upper()
        powers = _ascending(w, max(len(form) for form in self._sizes[star]))
        values, slopes = _sums(self._sizes[star], powers)
        return _Sizes(values, [kappa * edge / close * x for x in slopes])

    def _other_side(self, i: int, master: _Sizes, cell: _Sizes, tau: Arb) -> flint.arb_mat:
        """Bounds of the integrand on the side whose function gives way to the master's."""
        cells = self.series.cells
        jumps = [abs(int(j)) for j in cells.jumps[i]]
        masters = [g + j for g, j in zip(master.values, jumps)]
        slopes = [g + u for g, u in zip(master.slopes, cell.slopes)]
        height, foot = shape(cells.start[i][1], cells.end[i][1])
        lever = tau / 2 + abs(foot - Arb(0.5))
        A = [g + u + lever * e for g, u, e in zip(masters, cell.values, slopes)]
        flux = _both_ways([g + u / 2 for g, u in zip(masters, cell.values)], cell.slopes)
        return flux + _outer(A, A) / (2 * height) + _outer(slopes, slopes) * (height / 2)


def _quadrature_factor(rule: Rule) -> Arb:
    n, rho = rule.n_nodes, Arb(rule.ellipse)
    return 2 * (1 + Arb(1) / (4 * n * n - 1)) * rho ** (-2 * n) / (1 - rho**-2)


def _tau(rule: Rule) -> Arb:
    rho = Arb(rule.ellipse)
    return (rho + 1 / rho) / 2


def _rho(tau: float) -> float:
    return float(tau + np.sqrt(tau * tau - 1.0))


def _exact_count(polynomials: list[flint.acb_poly]) -> int:
    """Nodes with which products of two such polynomials, or their slopes, are exact."""
    return max(p.length() for p in polynomials) + 1


def _count(size: float, tau: float, accuracy: float) -> int:
    """Nodes for an error of e^accuracy of a product of two functions of size e^size."""
    return max(2, int(np.ceil((2.0 * size + 2.0 - accuracy) / (2.0 * np.log(_rho(tau))))))


def _fewest(found: list[tuple[int, float]]) -> Rule:
    n, ellipse = min(found, key=lambda rule: rule[0])
    return Rule(n + -n % _NODE_UNIT, ellipse)


def _face_sizes(polynomials: list[flint.acb_poly], tau: Arb) -> _Sizes:
    sizes = [[c.abs_upper() for c in p.coeffs()] for p in polynomials]
    powers = _ascending(tau.upper(), max(len(c) for c in sizes) or 1)
    values, slopes = _sums(sizes, powers)
    # d/ds = 2 d/dt.
    return _Sizes(values, [2 * x / tau for x in slopes])


def _polynomial_logs(polynomials: list[flint.acb_poly]) -> Floats:
    return _logs([[x.abs_upper() for x in q.coeffs()] for q in polynomials])


def _face_logs(p: Floats, tau: float) -> tuple[float, float]:
    """Logarithms of the sizes of a value and of a slope, from those of the coefficients."""
    k = np.arange(p.size)
    terms = p + k * np.log(tau)
    return _log_sum(terms), _log_sum(terms + np.log(np.maximum(k, 1))) + float(np.log(2.0 / tau))


def _outer(x: list[Arb], y: list[Arb]) -> flint.arb_mat:
    return flint.arb_mat([[a * b for b in y] for a in x])


def _both_ways(x: list[Arb], y: list[Arb]) -> flint.arb_mat:
    product = _outer(x, y)
    return product + product.transpose()


def shape(a: flint.acb, b: flint.acb) -> tuple[Arb, Arb]:
    """Height over length of the triangle 0 a b with base a b, and the foot of the height.

    The foot is the s in [0, 1] of the point of the line closest to 0.
    """
    edge = b - a
    square = edge.real * edge.real + edge.imag * edge.imag
    return (a.conjugate() * b).imag / square, -(edge.conjugate() * a).real / square


def _ascending(x: Arb, n: int) -> list[Arb]:
    """Upper bounds of the powers of a positive number."""
    powers = [Arb(1)]
    for _ in range(1, n):
        powers.append((powers[-1] * x).upper())
    return powers


def _sums(forms: list[list[Arb]], powers: list[Arb]) -> tuple[list[Arb], list[Arb]]:
    """Σ |c_k| x^k and Σ k |c_k| x^k of each form."""
    values, slopes = [], []
    for form in forms:
        terms = [c * x for c, x in zip(form, powers)]
        values.append(sum(terms, Arb(0)))
        slopes.append(sum((k * term for k, term in enumerate(terms)), Arb(0)))
    return values, slopes


def _logs(forms: list[list[Arb]]) -> Floats:
    """Logarithms of the largest of the k-th coefficients of several forms."""
    length = max((len(form) for form in forms), default=0)
    logs = np.full(max(length, 1), -1e300)
    for form in forms:
        if form:
            found = np.array([_log(c) for c in form])
            logs[: found.size] = np.maximum(logs[: found.size], found)
    return logs


def _log(c: Arb) -> float:
    mantissa, exponent = c.mid().man_exp()
    m = abs(int(mantissa))
    if m == 0:
        return -1e300
    shift = max(m.bit_length() - 53, 0)
    return float(np.log(float(m >> shift)) + (int(exponent) + shift) * np.log(2.0))


def _log_sum(terms: Floats) -> float:
    largest = float(terms.max())
    return largest + float(np.log(np.exp(terms - largest).sum()))
