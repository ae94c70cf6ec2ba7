r"""The energies of conforming forms for a few digits, in midpoint–radius arithmetic.

The formulas are those of :mod:`igl_periods.enclosures.conforming_forms`, on arrays of all chords
and all gaps at once: u and G come from :mod:`igl_periods.enclosures.float_traces`, everything after
them is arithmetic of :class:`~igl_periods.proofs.midpoint_radius.Balls`, and the energies are
Gram matrices.  This proves about 13 digits and takes microseconds a node.

The bound of the quadrature is that of :mod:`igl_periods.enclosures.quadrature`, with the face's
series bounded about its own origin.  It is made of sums of products of positive numbers, whose
rounding is covered by a factor; logarithms and powers that are not integer come from balls.
"""

from __future__ import annotations

from dataclasses import dataclass

import flint
import numpy as np

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.errors import ComplexError
from igl_periods.proofs import UNIT, Balls, check_arithmetic, norms, total

from .cells import Cells
from .conforming_forms import shared_ends
from .float_traces import (
    LONG_UNIT,
    STAR_BITS,
    TINY,
    UP,
    LongEnds,
    LongFloats,
    Traces,
    long_nodes,
    traces,
)
from .quadrature import gauss_balls
from .triangulation import Triangulation, following

_FRACTIONS = np.linspace(0.3, 0.9, 9)
_CHORDS_AT_ONCE = 12_000
_ROWS_AT_ONCE = 64
_MOST_NODES = 400
_NODE_UNIT = 4
# Shapes beyond this would be known to less than a factor UP.
_LEAST_HEIGHT = 1e-5


def float_dirichlet_enclosure(
    surface: Triangulation,
    cells: Cells,
    coefficients: list[Complexes],
    accuracy: float,
    combination: Floats | None = None,
) -> flint.arb_mat:
    """The energies of the conforming forms, in balls; (k, k).

    Parameters
    ----------
    surface : Triangulation
        The one that was cut into ``cells``.
    cells : Cells
    coefficients : list of (K, k) complex
        Power series on each cell, exact.
    accuracy : float
        The natural logarithm of the error of a quadrature that does not matter.
    combination : (k, k) float, optional
        W: the forms are in the classes W c of the cochains c; sums of integer multiples of entries
        of one row are exact.  The identity by default.

    Raises
    ------
    ComplexError
        If angles or shapes are too extreme for double precision.
    """
    check_arithmetic()
    jumps = cells.jumps.astype(np.float64)
    jumps = jumps if combination is None else jumps @ combination.T
    energies = _Energies(surface, cells, coefficients, jumps, accuracy)
    D = energies.total()
    rows = zip(D.mid.tolist(), D.rad.tolist())
    return flint.arb_mat([[flint.arb(m, r) for m, r in zip(*row)] for row in rows])


@dataclass(frozen=True, eq=False)
class _Rule:
    """Nodes on each chord, ρ of its ellipse, and log τ that belongs to it."""

    counts: Ints
    tau: Floats


class _Energies:
    def __init__(
        self,
        surface: Triangulation,
        cells: Cells,
        coefficients: list[Complexes],
        jumps: Floats,
        accuracy: float,
    ) -> None:
        self.cells, self.coefficients, self.jumps = cells, coefficients, jumps
        self.k = coefficients[0].shape[1]
        self.constants = np.array([c[0].real for c in coefficients])
        self.bounds = _ChordBounds(cells, coefficients, jumps)
        self.rule = self.bounds.rule(accuracy)
        self.long = LongEnds(cells)
        self.alpha, self.beta = self._corrections(surface)
        with flint.ctx.workprec(STAR_BITS):
            lengths = np.array([len(c) for c in coefficients])[cells.cell]
            gaps = lengths[cells.n_chords :].max(axis=1) + 1
            self.gap_counts = gaps + -gaps % _NODE_UNIT
            used = np.unique(np.concatenate([self.rule.counts, self.gap_counts])).tolist()
            self.nodes = {n: gauss_balls(n) for n in used}
        self.long_nodes = {n: long_nodes(nodes) for n, (nodes, _) in self.nodes.items()}
        self.weights = {n: _midpoints(weights) for n, (_, weights) in self.nodes.items()}

    def total(self) -> Balls:
        """Add up everything."""
        cells = self.cells
        parts = []
        for first in range(0, cells.n_chords, _CHORDS_AT_ONCE):
            chords = np.arange(first, min(first + _CHORDS_AT_ONCE, cells.n_chords))
            parts += self._chords(chords)
        for first in range(cells.n_chords, cells.n_interfaces, _CHORDS_AT_ONCE):
            parts += self._gaps(np.arange(first, min(first + _CHORDS_AT_ONCE, cells.n_interfaces)))
        D = total(parts)
        error = self.bounds.error(self.rule, self.alpha.upper, self.beta.upper)
        return Balls(D.mid, (D.rad + error) * UP)

    def _chords(self, chords: Ints) -> list[Balls]:
        cells, counts = self.cells, self.rule.counts[chords]
        row = np.repeat(chords, counts)
        long_t, s, weight = self._nodes(counts)
        face = traces(self.long.face_points(row, 0, long_t), self.coefficients, of_stars=False)
        nodes = {n: balls[0] for n, balls in self.nodes.items()}
        points = self.long.star_points(chords, counts, nodes, long_t)
        star = traces(points, self.coefficients, of_stars=True)
        correction = self.alpha[row] + self.beta[row] * s
        here, there = Balls(face.u, face.u_error), Balls(star.u, star.u_error)
        delta = here + correction - there + self._steps(chords)[row - chords[0]]
        slope = _real(face) + self.beta[row] + _real(star)
        on_face = here.scaled(0.5) + correction
        on_star = delta + there.scaled(0.5)
        # The face's own correction is linear along the chord: its energy is a closed form.
        height, foot = _shapes(cells, chords, 0)
        tilted = self.alpha[chords] + self.beta[chords] * foot
        return [
            *_flux(on_face, face, weight),
            *_flux(on_star, star, weight),
            *_mismatch(delta, slope, s, weight, _shapes(cells, row, 1)),
            *_squares(tilted, self.beta[chords], height),
        ]

    def _gaps(self, gaps: Ints) -> list[Balls]:
        cells, counts = self.cells, self.gap_counts[gaps - self.cells.n_chords]
        row = np.repeat(gaps, counts)
        long_t, s, weight = self._nodes(counts)
        first, second = (
            traces(self.long.face_points(row, side, long_t), self.coefficients, of_stars=False)
            for side in range(2)
        )
        here, there = Balls(first.u, first.u_error), Balls(second.u, second.u_error)
        delta = here - there + self._steps(gaps)[row - gaps[0]]
        slope = _real(first) + _real(second)
        return [
            *_flux(here.scaled(0.5), first, weight),
            *_flux(delta + there.scaled(0.5), second, weight),
            *_mismatch(delta, slope, s, weight, _shapes(cells, row, 1)),
        ]

    def _steps(self, interfaces: Ints) -> Balls:
        """How the constants of the cells jump, beyond the jumps of the cochains."""
        first, second = (
            Balls.exact(self.constants[self.cells.cell[interfaces, side]]) for side in range(2)
        )
        return first - second - Balls.exact(self.jumps[interfaces])

    def _nodes(self, counts: Ints) -> tuple[LongFloats, Balls, Balls]:
        """t, s and the weights of the rows of segments with so many nodes; balls (rows, 1)."""
        t = np.concatenate([self.long_nodes[n] for n in counts.tolist()])
        weight = np.concatenate([self.weights[n] for n in counts.tolist()])[:, None]
        s = (0.5 * (1.0 + t.astype(np.float64)))[:, None]
        return t, Balls(s, np.full_like(s, 2.0**-51)), Balls(weight, 2.0**-51 * weight)

    def _corrections(self, surface: Triangulation) -> tuple[Balls, Balls]:
        """α and β of the linear functions that correct the faces' traces; (chords, k) each."""
        n = self.cells.n_chords
        chords = np.repeat(np.arange(n), 2)
        ends = np.tile(np.array([-1.0, 1.0], dtype=np.longdouble), n)
        points = self.long.face_points(chords, 0, ends)
        found = traces(points, self.coefficients, of_stars=False)
        u = Balls(found.u, found.u_error).reshape(n, 2, self.k)
        corner, other = np.array(list(shared_ends(surface))).T
        steps = self._steps(np.arange(n))
        # Both chords lead to one star, so that its constant drops out.
        excess = (u[corner, 1] + steps[corner]) - (u[other, 0] + steps[other])
        leaves = [following(following(c)) < following(o) for c, o in zip(corner, other)]
        at_start, at_end = (Balls(np.zeros((n, self.k)), np.zeros((n, self.k))) for _ in range(2))
        first, second = np.flatnonzero(leaves), np.flatnonzero(~np.array(leaves))
        at_start.mid[other[first]] = excess.mid[first]
        at_start.rad[other[first]] = excess.rad[first]
        at_end.mid[corner[second]] = -excess.mid[second]
        at_end.rad[corner[second]] = excess.rad[second]
        return at_start, at_end - at_start


def _midpoints(balls: list[flint.arb]) -> Floats:
    return np.array([float(x.mid()) for x in balls])


def _real(trace: Traces) -> Balls:
    return Balls(np.ascontiguousarray(trace.G.real), trace.G_error)


def _flux(h: Balls, trace: Traces, weight: Balls) -> list[Balls]:
    """∫ h_i Im G_j + h_j Im G_i."""
    root = weight.sqrt()
    flux = Balls(np.ascontiguousarray(trace.G.imag), trace.G_error)
    half = _products(h * root, flux * root)
    return [half, Balls(half.mid.T, half.rad.T)]


def _mismatch(
    delta: Balls, slope: Balls, s: Balls, weight: Balls, shapes: tuple[Balls, Balls]
) -> list[Balls]:
    """E, on second sides, where s′ = 1 − s and ``slope`` is −δ′."""
    height, foot = shapes
    one = Balls.exact(np.ones_like(s.mid))
    root = weight.sqrt()
    return _squares((delta + (one - s - foot) * slope) * root, slope * root, height)


def _squares(slanted: Balls, slope: Balls, height: Balls) -> list[Balls]:
    """½ (A Aᵀ/λ + λ B Bᵀ), summed over the rows."""
    root = height.scaled(0.5).sqrt()
    half = Balls.exact(np.full_like(height.mid, 0.5))
    A, B = slanted * (half / root), slope * root
    return [_products(A, A), _products(B, B)]


def _products(X: Balls, Y: Balls) -> Balls:
    """Xᵀ Y, as ``inner_products``, but with sums in long floating point."""
    n, k = X.shape
    padding = -n % _ROWS_AT_ONCE
    long = [np.concatenate([Z.mid, np.zeros((padding, k))]).astype(np.longdouble) for Z in (X, Y)]
    parts = np.einsum("pni,pnj->pij", *(z.reshape(-1, _ROWS_AT_ONCE, k) for z in long))
    n_terms = _ROWS_AT_ONCE
    while len(parts) > 1:
        if len(parts) % 2:
            parts = np.concatenate([parts, np.zeros((1, k, k), dtype=np.longdouble)])
        parts = parts[0::2] + parts[1::2]
        n_terms += 1
    size_X, size_Y, r_X, r_Y = (norms(z) for z in (X.mid, Y.mid, X.rad, Y.rad))
    mid = parts[0].astype(np.float64)
    rad = np.outer(size_X, r_Y + 2.0 * n_terms * LONG_UNIT * size_Y)
    rad += np.outer(r_X, size_Y + r_Y) + UNIT * np.abs(mid)
    return Balls(mid, np.asarray(rad * UP + (n + 1) * TINY, dtype=np.float64))


def _shapes(cells: Cells, interfaces: Ints, side: int) -> tuple[Balls, Balls]:
    """λ and x of the triangles from the origins of cells to segments; (rows, 1) each."""
    start, end = cells.ends[interfaces, side].T
    size = np.maximum(np.abs(start), np.abs(end))
    # Every coordinate is a rounded ball: off by less than two units of the larger end.
    error = (2.0**-51 * size)[:, None]
    a, b = (
        [Balls(np.ascontiguousarray(part)[:, None], error) for part in (z.real, z.imag)]
        for z in (start, end)
    )
    edge = [b[0] - a[0], b[1] - a[1]]
    square = edge[0] * edge[0] + edge[1] * edge[1]
    height = (a[0] * b[1] - a[1] * b[0]) / square
    foot = -((edge[0] * a[0] + edge[1] * a[1]) / square)
    if not height.is_positive().all():
        raise ComplexError("the triangles are too flat for double precision.")
    return height, foot


class _ChordBounds:
    """Bounds of the integrands on the chords, on ellipses; arrays over chords and forms."""

    def __init__(self, cells: Cells, coefficients: list[Complexes], jumps: Floats) -> None:
        self.cells = cells
        n = cells.n_chords
        self.steps = np.abs(jumps[:n])
        longest = max(len(c) for c in coefficients)
        self.sizes = np.zeros((cells.n_cells, longest, coefficients[0].shape[1]))
        for cell, c in enumerate(coefficients):
            self.sizes[cell, : len(c)] = np.abs(c) * UP
        ends = np.abs(cells.ends[:n])
        # Rounded upwards, or downwards, by much more than the errors of the corners.
        self.edge = np.abs(cells.ends[:n, :, 1] - cells.ends[:n, :, 0])
        self.reach = ends.sum(axis=2)
        self.star, self.face = cells.cell[:n, 1], cells.cell[:n, 0]
        self.least = np.array([len(c) for c in coefficients])[self.face] + 1

    def rule(self, accuracy: float) -> _Rule:
        """Numbers of nodes for errors of about e^accuracy on each chord."""
        n = self.cells.n_chords
        counts, best = np.full(n, np.iinfo(np.int64).max), np.zeros(n)
        for fraction in _FRACTIONS:
            tau = 1.0 + fraction * (self.reach[:, 1] / self.edge[:, 1] - 1.0)
            with np.errstate(over="ignore", invalid="ignore"):
                size = np.log(self._integrand(tau, None, None).max(axis=1) + 1e-300)
            rho = tau + np.sqrt(tau * tau - 1.0)
            with np.errstate(divide="ignore", invalid="ignore"):
                wanted = np.ceil((size + 1.5 - accuracy) / (2.0 * np.log(rho)))
            wanted = np.where(np.isfinite(wanted), np.maximum(wanted, self.least), 1e9)
            better = wanted < counts
            counts[better], best[better] = wanted[better], tau[better]
        if counts.max() > _MOST_NODES:
            raise ComplexError("angles are too large for a quadrature with few nodes.")
        return _Rule(counts + -counts % _NODE_UNIT, best)

    def error(self, rule: _Rule, alpha: Floats, beta: Floats) -> Floats:
        """The sum of the errors of all chords; (k, k)."""
        H, G, A, B, height = self._parts(rule.tau, alpha, beta)
        tau, n = rule.tau, rule.counts
        # A lower bound of ρ, and ρ^−2n by repeated products.
        rho = (tau + np.sqrt(tau * tau - 1.0)) / UP
        decay = np.ones_like(rho)
        for k in range(int(n.max())):
            decay = np.where(k < n, decay / (rho * rho), decay)
        factor = 2.0 * (1.0 + 1.0 / (4.0 * n * n - 1.0)) * decay / (1.0 - rho**-2) * UP
        low, high = height / UP, height * UP
        flux = np.einsum("c,ci,cj->ij", factor, H, G)
        tilt = np.einsum("c,ci,cj->ij", factor / (2.0 * low), A, A)
        slope = np.einsum("c,ci,cj->ij", factor * high / 2.0, B, B)
        return (flux + flux.T + tilt + slope) * UP

    def _integrand(self, tau: Floats, alpha: Floats | None, beta: Floats | None) -> Floats:
        H, G, A, B, height = self._parts(tau, alpha, beta)
        return 2.0 * H * G + 0.5 * (A * A / height[:, None] + height[:, None] * B * B)

    def _parts(
        self, tau: Floats, alpha: Floats | None, beta: Floats | None
    ) -> tuple[Floats, Floats, Floats, Floats, Floats]:
        """Bounds of |g − u/2|, |G|, |δ − (s − x) δ′| and |δ′| of each form, and λ."""
        cells = self.cells
        reach, edge = self.reach * UP, self.edge * UP
        far = (reach + edge * tau[:, None]) / 2.0 * UP
        close = (self.reach[:, 1] / UP - edge[:, 1] * tau) / 2.0 / UP
        if not (close > 0.0).all():
            raise ComplexError("angles are too close to 180 degrees for double precision.")
        kappa = cells.exponents[self.star] * UP
        w = self._star_size(far[:, 1] / cells.scale[self.star], alpha is not None)
        values, slopes = _horner(self.sizes[self.star], w)
        slopes *= (kappa * edge[:, 1] / close * UP)[:, None]
        z = far[:, 0] / cells.scale[self.face] * UP
        traces, trace_slopes = _horner(self.sizes[self.face], z)
        trace_slopes *= (edge[:, 0] / (far[:, 0] / UP))[:, None] * UP
        if alpha is not None and beta is not None:
            traces = traces + alpha + 0.5 * (1.0 + tau[:, None]) * beta
            trace_slopes = trace_slopes + beta
        start, end = cells.ends[: cells.n_chords, 1].T
        square = self.edge[:, 1] ** 2
        height = (start.conj() * end).imag / square
        foot = -((end - start).conj() * start).real / square
        if not (height > _LEAST_HEIGHT).all() or (reach > edge / _LEAST_HEIGHT).any():
            raise ComplexError("triangles are too flat or too thin for double precision.")
        lever = (0.5 * tau + np.abs(foot - 0.5)) * UP
        # In the branch of the star.
        traces = traces + self.steps
        B = (trace_slopes + slopes) * UP
        A = (traces + values + lever[:, None] * B) * UP
        return (traces + 0.5 * values) * UP, slopes * UP, A, B, height

    def _star_size(self, ratio: Floats, proved: bool) -> Floats:
        """(|ζ|/R)^κ, as an upper bound where that is wanted."""
        exponent = self.cells.exponents[self.star]
        if not proved:
            return np.asarray(ratio**exponent, dtype=np.float64)
        with flint.ctx.workprec(STAR_BITS):
            exact = self.cells.exponent
            return np.array(
                [
                    float(((flint.arb(r) * UP).log() * exact[v]).exp().upper()) * UP
                    for r, v in zip(ratio.tolist(), self.star.tolist())
                ]
            )


def _horner(sizes: Floats, x: Floats) -> tuple[Floats, Floats]:
    """Σ c_k x^k and Σ k c_k x^k for c_k, x ≥ 0, rounded up; (n, forms) each."""
    values, slopes = np.zeros((2, len(x), sizes.shape[2]))
    for k in range(sizes.shape[1] - 1, -1, -1):
        values = values * x[:, None] + sizes[:, k]
        slopes = slopes * x[:, None] + k * sizes[:, k]
    return values * UP, slopes * UP
