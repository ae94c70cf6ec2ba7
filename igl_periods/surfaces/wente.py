r"""Wente's tori: immersed tori of constant mean curvature ½ whose x-lines are planar.

With the metric e^{2ω}(dx² + dy²) and second fundamental form e^ω (sinh ω dx² + cosh ω dy²) the
mean curvature is ½, and Gauss and Codazzi ask for

.. math:: ω_{xx} + ω_{yy} + \sinh ω \cosh ω = 0 .

Lines of curvature y = const are planar iff tanh(ω/2) = A(x) B(y), and then A and B are elliptic
functions: A = √(tan θ tan θ̄) cn(αx | sin²θ), B = cn(βy | sin²θ̄), where α² = sin 2θ̄ / sin 2(θ + θ̄)
and β² = sin 2θ / sin 2(θ + θ̄).  The planes of the x-lines turn about a fixed axis by the angle
φ(y), so that the immersion is a rotation by φ of the vector (h, s), and a height z: closed formulas
in Jacobi's functions and in elliptic integrals of the second and third kind.

Over the period X = 4K/α in x the surface closes iff 2E(sin²θ) = K(sin²θ), which determines θ.  Over
Y = 4K̄/β in y it turns by Φ(θ̄), which increases from 0 to 2π.  So Φ = 2πj/n, j coprime to n,
closes it up with n lobes that wind j times round the axis.  A step by (X/2, Y/2) turns it by
Φ/2 + π, so that the lattice of periods is

* rhombic, spanned by (X, nY)/2 and (−X, nY)/2, if n and j are both odd: τ = exp(2i arctan(X/nY));
* rectangular, spanned by (X, 0) and (0, nY), otherwise: τ = i nY/X.

Wente's torus with three lobes, n = 3 and j = 1, is the one in the paper.

References
----------
Wente, "Counterexample to a conjecture of H. Hopf" (1986).
Walter, "Explicit examples to the H-problem of Heinz Hopf" (1987).
Carlson, "Numerical computation of real or complex elliptic integrals" (1995).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import gcd

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipe, ellipj, ellipk, elliprd, elliprf, elliprj

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import periodic_grid
from igl_periods.errors import MeshError


def wente_torus(N: int, lobes: int = 3, winding: int = 1) -> tuple[Floats, Ints]:
    """Triangulate Wente's torus on an N × N grid of conformal coordinates.

    Parameters
    ----------
    N : int
        Vertices along each of the two generators of the lattice of periods, N ≥ 3.
    lobes, winding : int
        Number n ≥ 2 of lobes, and how often they wind round the axis: 0 < j < n coprime to n.

    Returns
    -------
    V : (N², 3) float
        Vertex ``i N + j`` is the image of (i/N) a + (j/N) b, where a, b generate the periods; the
        modulus of :func:`wente_modulus` refers to the marking (a, b).
    F : (2 N², 3) int
        In the rhombic case the edges across the cells run along a − b, the shorter diagonal.

    Raises
    ------
    MeshError
        If the lobes do not close, or ``N < 3``.

    References
    ----------
    Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 4.2.
    """
    if N < 3:
        raise MeshError(f"a torus mesh of {N} x {N} vertices is not simplicial; take N >= 3.")
    a, b = wente_periods(lobes, winding)
    i, j = np.divmod(np.arange(N * N), N)
    x, y = (np.outer(a, i) + np.outer(b, j)) / N
    return wente_immersion(x, y, lobes, winding), periodic_grid(N, N)


def wente_modulus(lobes: int = 3, winding: int = 1) -> complex:
    """Return the modulus τ = b/a of the smooth torus in the marking of :func:`wente_torus`.

    Raises
    ------
    MeshError
        If the lobes do not close.
    """
    a, b = wente_periods(lobes, winding)
    return complex(*b) / complex(*a)


def wente_periods(lobes: int = 3, winding: int = 1) -> Floats:
    """Return generators a, b of the lattice of periods, as rows; shape (2, 2), det > 0.

    Raises
    ------
    MeshError
        If the lobes do not close.
    """
    c = _constants(lobes, winding)
    if lobes % 2 and winding % 2:
        return 0.5 * np.array([[c.X, lobes * c.Y], [-c.X, lobes * c.Y]])
    return np.array([[c.X, 0.0], [0.0, lobes * c.Y]])


def wente_immersion(x: ArrayLike, y: ArrayLike, lobes: int = 3, winding: int = 1) -> Floats:
    """Evaluate the conformal immersion of mean curvature ½.

    Parameters
    ----------
    x, y : (...) array-like
        Conformal coordinates.
    lobes, winding : int

    Returns
    -------
    (..., 3) float

    Raises
    ------
    MeshError
        If the lobes do not close.
    """
    c = _constants(lobes, winding)
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    px = _Argument.of(c.alpha * x, c.m)
    py = _Argument.of(c.beta * y, c.m_bar)
    t = c.g * px.cn * py.cn
    q = np.sqrt((1 - c.n1 * py.sn**2) * (1 - c.n2 * py.sn**2))
    h = c.beta * py.sn * py.dn / q
    s = (c.s0 + c.s2 * py.cn**2) * py.cn / q - 2 * c.g * px.cn * q / (c.alpha**2 * (1 - t))
    z = 2 * px.second_kind() / c.alpha - x
    z += 2 * c.g * px.sn * px.dn * py.cn / (c.alpha * (1 - t))
    phi = _turn(py, c)
    cos, sin = np.cos(phi), np.sin(phi)
    return np.stack([h * cos - s * sin, h * sin + s * cos, z], axis=-1)


@dataclass(frozen=True)
class _Constants:
    """The constants of the immersion, named as in the module's docstring."""

    m: float  # sin² θ
    m_bar: float  # sin² θ̄
    alpha: float
    beta: float
    g: float  # √(tan θ tan θ̄)
    n1: float  # characteristics of the two integrals of the third kind
    n2: float
    s0: float  # −cos 2θ
    s2: float  # sin 2θ tan θ̄

    @classmethod
    def of(cls, theta: float, theta_bar: float) -> _Constants:
        total = theta + theta_bar
        return cls(
            m=np.sin(theta) ** 2,
            m_bar=np.sin(theta_bar) ** 2,
            alpha=np.sqrt(np.sin(2 * theta_bar) / np.sin(2 * total)),
            beta=np.sqrt(np.sin(2 * theta) / np.sin(2 * total)),
            g=np.sqrt(np.tan(theta) * np.tan(theta_bar)),
            n1=np.cos(theta) * np.sin(theta_bar) / np.sin(total),
            n2=-np.sin(theta) * np.sin(theta_bar) / np.cos(total),
            s0=-np.cos(2 * theta),
            s2=np.sin(2 * theta) * np.tan(theta_bar),
        )

    @property
    def X(self) -> float:
        return float(4 * ellipk(self.m) / self.alpha)

    @property
    def Y(self) -> float:
        return float(4 * ellipk(self.m_bar) / self.beta)


@dataclass(frozen=True)
class _Argument:
    """Jacobi's functions of u = 2K·turns + v, |v| ≤ K, with modulus m.

    The incomplete integrals are Carlson forms in sn v, cn v, dn v, which are accurate everywhere;
    scipy's ``ellipeinc`` is wrong at isolated arguments (by 0.14 at φ = 0.7934947587685265,
    m = 0.8261147659849701, which the 80 × 80 grid meets).
    """

    turns: Floats
    sn: Floats
    cn: Floats
    dn: Floats
    m: float

    @classmethod
    def of(cls, u: Floats, m: float) -> _Argument:
        half_period = 2 * ellipk(m)
        turns = np.round(u / half_period)
        sn, cn, dn, _ = ellipj(u - turns * half_period, m)
        sign = 1 - 2 * (turns % 2)
        return cls(turns, sign * sn, sign * cn, dn, m)

    def second_kind(self) -> Floats:
        """E(am u | m)."""
        sn = self._first_sn()
        c2, d2 = self.cn**2, self.dn**2
        part = sn * elliprf(c2, d2, 1.0) - self.m * sn**3 * elliprd(c2, d2, 1.0) / 3
        return np.asarray(2 * ellipe(self.m) * self.turns + part)

    def third_kind(self, n: float) -> Floats:
        """Π(n; am u | m) = ∫ dt / ((1 − n sin²t) √(1 − m sin²t))."""
        sn = self._first_sn()
        c2, d2 = self.cn**2, self.dn**2
        part = sn * elliprf(c2, d2, 1.0) + n * sn**3 * elliprj(c2, d2, 1.0, 1 - n * sn**2) / 3
        return np.asarray(2 * _complete_third_kind(n, self.m) * self.turns + part)

    def _first_sn(self) -> Floats:
        """The function sn of the remainder v."""
        return self.sn * (1 - 2 * (self.turns % 2))


def _complete_third_kind(n: float, m: float) -> float:
    return float(elliprf(0.0, 1 - m, 1.0) + n * elliprj(0.0, 1 - m, 1.0, 1 - n) / 3)


def _turn(y: _Argument, c: _Constants) -> Floats:
    """The angle φ(y) by which the plane of an x-line has turned."""
    return ((1 - c.n2) * y.third_kind(c.n2) - (1 - c.n1) * y.third_kind(c.n1)) / c.beta


def _turn_of_period(theta: float, theta_bar: float) -> float:
    """The angle Φ by which the surface turns over one period in y."""
    c = _Constants.of(theta, theta_bar)
    second = (1 - c.n2) * _complete_third_kind(c.n2, c.m_bar)
    return float(4 * (second - (1 - c.n1) * _complete_third_kind(c.n1, c.m_bar)) / c.beta)


@lru_cache(maxsize=32)
def _constants(lobes: int, winding: int) -> _Constants:
    if lobes < 2 or not 0 < winding < lobes or gcd(lobes, winding) != 1:
        raise MeshError(
            f"{lobes} lobes that wind {winding} times round the axis do not close up to a torus: "
            "lobes must be >= 2, and 0 < winding < lobes coprime to it."
        )
    # The root is simple, and what rounding leaves of 2E - K is below 1e-15.
    from scipy.optimize import brentq  # slow to import, and seldom needed

    modulus = brentq(lambda m: 2 * ellipe(m) - ellipk(m), 0.5, 0.95, xtol=1e-16, rtol=1e-15)
    theta = float(np.arcsin(np.sqrt(modulus)))
    goal = 2 * np.pi * winding / lobes
    theta_bar = brentq(
        lambda t: _turn_of_period(theta, t) - goal,
        1e-9, np.pi / 2 - theta - 1e-9, xtol=1e-16, rtol=1e-15,
    )  # fmt: skip
    return _Constants.of(theta, float(theta_bar))
