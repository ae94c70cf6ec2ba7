r"""The holomorphic differential of most even length.

A differential has 2g − 2 zeros and may be tiny on whole handles, where a texture is then magnified.
How even it is can be said by one number between 0 and 1, the geometric over the arithmetic mean of
|ζ|² on the surface; it is 1 iff |ζ| is constant.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike, NDArray

from igl_periods.arrays import Complexes, Floats
from igl_periods.harmonic import face_areas, linear_parts
from igl_periods.periods import PeriodMatrix, check_period_matrix
from igl_periods.run_log import stage

from .normalised import normalised_differentials
from .parametrization import checked_coefficients

_SAMPLED_FACES = 20_000
_STARTS, _DESCENTS = 64, 4


def most_even_form(pm: PeriodMatrix) -> Complexes:
    """Coefficients of the differential of most even |ζ|, of mean |ζ|² equal to 1; (g,) complex.

    The best of several descents from random starts, which are always the same.

    Raises
    ------
    ComplexError
        If the surface is a sphere, or its triangles are so thin that their Laplacian is singular
        to rounding.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> pm = ip.period_matrix(V, F)
    >>> ip.most_even_form(pm).shape
    (1,)
    """
    check_period_matrix(pm)
    checked_coefficients(pm, np.ones(pm.genus))
    densities = _Densities.of(pm)
    with stage("most even form"):
        return densities.most_even()


def evenness(pm: PeriodMatrix, coefficients: ArrayLike) -> float:
    """Geometric over arithmetic mean of |ζ|² on the surface, between 0 and 1.

    Raises
    ------
    ValueError
        If the number of coefficients is not g, or all are 0 or one is not finite.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> pm = ip.period_matrix(V, F)
    >>> ip.evenness(pm, [1.0]) >= 0
    True
    """
    s = checked_coefficients(pm, coefficients)
    p, q = linear_parts(pm.complex, s @ normalised_differentials(pm))
    density, area = np.abs(p) ** 2 + np.abs(q) ** 2, face_areas(pm.complex)
    with np.errstate(divide="ignore"):
        geometric = np.exp(np.average(np.log(density), weights=area))
    return float(geometric / np.average(density, weights=area))


@dataclass(frozen=True, eq=False)
class _Densities:
    """|ζ|² on faces, as a function of the coefficients t of ζ in an orthonormal basis.

    |ζ|² = |P t|² + |Q t|² on each face, Σ weight |ζ|² = |t|², s = basis t.
    """

    P: Complexes
    Q: Complexes
    weight: Floats
    basis: Complexes

    @classmethod
    def of(cls, pm: PeriodMatrix) -> _Densities:
        area = face_areas(pm.complex)
        p, q = linear_parts(pm.complex, normalised_differentials(pm))
        chosen: NDArray[np.int64] = np.arange(area.size)
        if chosen.size > _SAMPLED_FACES:
            chosen = np.random.default_rng(0).choice(chosen, _SAMPLED_FACES, p=area / area.sum())
            weight = np.full(chosen.size, 1.0 / chosen.size)
        else:
            weight = area / area.sum()
        P, Q = p.T[chosen], q.T[chosen]
        energy = (P.conj().T * weight) @ P + (Q.conj().T * weight) @ Q
        basis = scipy.linalg.inv(scipy.linalg.cholesky(energy))
        return cls(P @ basis, Q @ basis, weight, basis)

    def unevenness(self, reals: Floats) -> tuple[float, Floats]:
        """Log of arithmetic over geometric mean of |ζ|², and its gradient; t = (re, im)."""
        t = reals.reshape(2, -1)[0] + 1j * reals.reshape(2, -1)[1]
        on_p, on_q = self.P @ t, self.Q @ t
        density = np.maximum(np.abs(on_p) ** 2 + np.abs(on_q) ** 2, 1e-300)
        norm = float(np.vdot(t, t).real)
        value = np.log(norm) - float(self.weight @ np.log(density))
        share = self.weight / density
        slope = t / norm - (self.P.conj().T @ (share * on_p) + self.Q.conj().T @ (share * on_q))
        return value, 2.0 * np.concatenate([slope.real, slope.imag])

    def most_even(self) -> Complexes:
        g = len(self.basis)
        starts = np.random.default_rng(0).normal(size=(_STARTS, 2 * g))
        promising = sorted(starts, key=lambda start: self.unevenness(start)[0])[:_DESCENTS]
        from scipy.optimize import minimize  # slow to import, and seldom needed

        results = [
            minimize(self.unevenness, start, jac=True, method="L-BFGS-B") for start in promising
        ]
        best = min(results, key=lambda result: float(result.fun)).x.reshape(2, g)
        t = best[0] + 1j * best[1]
        # The phase is free: make the sum of squares of the periods along the a-cycles positive.
        s = self.basis @ (t / np.linalg.norm(t))
        phase = np.sqrt(np.sum(s**2))
        return s * (abs(phase) / phase) if phase else s
