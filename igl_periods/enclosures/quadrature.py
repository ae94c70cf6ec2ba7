r"""Gauss quadrature in balls, with a proved error.

On the sides of faces the integrands are polynomials of degree 2K − 3, for which n ≥ K − 1 nodes
are exact.  On a chord seen from its star, the integrand f continues analytically to the ellipse
with foci at the ends of [0, 1] and half axes adding up to ρ/2, as long as that ellipse does not
meet the vertex, a branch point of ζ^κ.  If |f| ≤ M there, then n nodes are wrong by at most

.. math:: 2 M \Bigl(1 + \frac{1}{4n^2 - 1}\Bigr) \frac{\rho^{-2n}}{1 - \rho^{-2}},

because the Chebyshev coefficients of f are at most 2Mρ^−k, the rule is exact up to degree 2n − 1,
its weights are positive, and odd functions are integrated exactly.

For the bound M: points of the ellipse have distances from the ends a, b of the chord that add up
to at most S = |e| (ρ + 1/ρ)/2, hence (|a| + |b| − S)/2 ≤ |ζ| ≤ (|a| + |b| + S)/2, and there

.. math:: |F| \le \sum |c_k| |w|^k, \qquad
          |dF/ds| \le \frac{\kappa |e|}{|\zeta|} \sum k |c_k| |w|^k.

The face's polynomial in t = 2s − 1 is bounded with |t| ≤ (ρ + 1/ρ)/2.  The real part of an analytic
function on the segment continues to one bounded by the same number.  How many nodes and which ρ are
good is chosen in floating point; the bound is computed in balls of 64 bits.
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
class ChordRule:
    """How a chord is integrated.

    Attributes
    ----------
    n_nodes : int
    ellipse : float
        ρ, or 0 where no number of nodes is enough.
    """

    n_nodes: int
    ellipse: float


class ChordBounds:
    """Bounds of the integrands on the chords of a surface."""

    def __init__(self, series: Series) -> None:
        """Take absolute values of all coefficients of stars, once."""
        self.series = series
        stars = series.coefficients[: series.cells.n_stars]
        with flint.ctx.workprec(_BOUND_BITS):
            self._sizes = [[[c.abs_upper() for c in form] for form in forms] for forms in stars]
        self._logs = [_logs(forms) for forms in self._sizes]

    def rule(
        self, i: int, polynomials: list[flint.acb_poly], least: int, accuracy: float
    ) -> ChordRule:
        """Choose nodes for an error of about e^accuracy, and no fewer than ``least``."""
        cells = self.series.cells
        a, b = (abs(complex(z)) for z in cells.ends[i, 1])
        edge = abs(complex(cells.ends[i, 1, 1] - cells.ends[i, 1, 0]))
        star = int(cells.cell[i, 1])
        kappa, scale, c = cells.exponents[star], float(cells.scale[star]), self._logs[star]
        p = _logs([[x.abs_upper() for x in q.coeffs()] for q in polynomials])
        largest = (a + b) / edge
        best = ChordRule(0, 0.0)
        for tau in 1.0 + _FRACTIONS * (largest - 1.0):
            far, close = (a + b + edge * tau) / 2, (a + b - edge * tau) / 2
            k = np.arange(c.size)
            terms = c + kappa * k * np.log(far / scale)
            size = np.logaddexp(_log_sum(terms), _log_sum(p + np.arange(p.size) * np.log(tau)))
            slope = _log_sum(terms + np.log(np.maximum(k, 1))) + np.log(kappa * edge / close)
            # The flux may be larger than the value, and the mismatch contains both.
            size = 2.0 * np.logaddexp(size, slope) + 2.0
            rho = tau + np.sqrt(tau * tau - 1.0)
            wanted = (size - accuracy) / (2.0 * np.log(rho))
            n = max(least, 2, int(np.ceil(wanted)))
            if best.n_nodes == 0 or n < best.n_nodes:
                best = ChordRule(n, float(rho))
        return ChordRule(best.n_nodes + -best.n_nodes % _NODE_UNIT, best.ellipse)

    def error(
        self,
        i: int,
        polynomials: list[flint.acb_poly],
        correction: tuple[list[Arb], list[Arb]],
        rule: ChordRule,
    ) -> flint.arb_mat:
        """Bounds of the errors of the integrals on the star's side of a chord; (k, k)."""
        with flint.ctx.workprec(_BOUND_BITS):
            return self._error(i, polynomials, correction, rule)

    def _error(
        self,
        i: int,
        polynomials: list[flint.acb_poly],
        correction: tuple[list[Arb], list[Arb]],
        rule: ChordRule,
    ) -> flint.arb_mat:
        cells = self.series.cells
        star = int(cells.cell[i, 1])
        za, zb = cells.start[i][1], cells.end[i][1]
        edge, reach = abs(zb - za), abs(za) + abs(zb)
        rho = Arb(rule.ellipse)
        tau = (rho + 1 / rho) / 2
        far, close = (reach + edge * tau) / 2, (reach - edge * tau) / 2
        if not close > 0:
            raise AssertionError("the ellipse was chosen so that it does not meet the vertex")
        kappa = cells.exponent[star]
        w = ((far / Arb(float(cells.scale[star]))).log() * kappa).exp().upper()
        powers = _ascending(w, max(len(form) for form in self._sizes[star]))
        slope_factor = kappa * edge / close
        values, slopes = _sums(self._sizes[star], powers)
        slopes = [slope_factor * x for x in slopes]
        face = [[c.abs_upper() for c in p.coeffs()] for p in polynomials]
        powers = _ascending(tau.upper(), max(len(c) for c in face) or 1)
        traces, trace_slopes = _sums(face, powers)
        # d/ds = 2 d/dt; the correction is α + β s with |s| ≤ (1 + τ)/2.
        alpha, beta = ([abs(x) for x in part] for part in correction)
        reach_s = (1 + tau) / 2
        masters = [g + a + reach_s * b for g, a, b in zip(traces, alpha, beta)]
        master_slopes = [2 * g / tau + b for g, b in zip(trace_slopes, beta)]
        height, foot = shape(za, zb)
        delta = [g + u for g, u in zip(masters, values)]
        delta_slope = [g + u for g, u in zip(master_slopes, slopes)]
        lever = tau / 2 + abs(foot - Arb(0.5))
        A = [d + lever * e for d, e in zip(delta, delta_slope)]
        H = [g + u / 2 for g, u in zip(masters, values)]
        n = rule.n_nodes
        factor = 2 * (1 + Arb(1) / (4 * n * n - 1)) * rho ** (-2 * n) / (1 - rho**-2)
        k = len(H)
        return flint.arb_mat(
            [
                [
                    factor
                    * (
                        H[p] * slopes[q]
                        + H[q] * slopes[p]
                        + (A[p] * A[q] / height + height * delta_slope[p] * delta_slope[q]) / 2
                    )
                    for q in range(k)
                ]
                for p in range(k)
            ]
        )


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
