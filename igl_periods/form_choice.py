r"""Choosing a holomorphic differential: by its periods, or the most even one.

The differentials of a surface of genus g are ζ = Σ s_k ζ_k, s ∈ C^g.

*By periods.*  The periods of ζ are s along the a-cycles and Π s along the b-cycles.  So g of the
2g complex periods can be prescribed, more only in the sense of least squares; or the *real parts*
of all of them: for p along the a- and q along the b-cycles,

.. math:: s = p + i\, Y^{-1} (X p - q), \qquad \Pi = X + iY .

With integer real parts the function exp(2πi Re ∫ζ) is well defined on the surface: stripes have
no seams.

*The most even one.*  A differential has 2g − 2 zeros and may be tiny on whole handles, where a
texture is then magnified.  How even it is can be said by one number between 0 and 1, the
geometric over the arithmetic mean of |ζ|² on the surface; it is 1 iff |ζ| is constant.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike, NDArray

from .differentials import normalised_differentials
from .face_forms import face_areas, linear_parts
from .parametrization import checked_coefficients
from .periods import PeriodMatrix
from .stages import stage

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

_SAMPLED_FACES = 20_000
_STARTS, _DESCENTS = 64, 4


def form_of_periods(pm: PeriodMatrix, periods: ArrayLike) -> Complexes:
    """Coefficients of the differential with prescribed periods, or the nearest to them.

    Parameters
    ----------
    pm : PeriodMatrix
    periods : (2g,) array-like of complex
        Along a_1..a_g, b_1..b_g; NaN where a period is free.

    Returns
    -------
    (g,) complex
        Of least squares of the differences, and of least norm among these.

    Raises
    ------
    ValueError
        If the number of periods is not 2g, or all of them are free.
    """
    wanted = _checked_periods(pm, np.asarray(periods, dtype=np.complex128))
    given = ~np.isnan(wanted)
    if not given.any():
        raise ValueError("all periods are free (NaN): prescribe at least one.")
    matrix = np.concatenate([np.eye(pm.genus), pm.matrix])
    s, *_ = np.linalg.lstsq(matrix[given], wanted[given], rcond=None)
    return s


def form_of_real_periods(pm: PeriodMatrix, periods: ArrayLike) -> Complexes:
    """Coefficients of the only differential whose periods have given real parts.

    Parameters
    ----------
    pm : PeriodMatrix
    periods : (2g,) array-like of float
        Real parts of the periods along a_1..a_g, b_1..b_g.

    Returns
    -------
    (g,) complex

    Raises
    ------
    ValueError
        If the number of periods is not 2g, or one is not finite.
    """
    wanted = _checked_periods(pm, np.asarray(periods, dtype=np.float64))
    if not np.isfinite(wanted).all():
        raise ValueError("real parts of periods must all be finite: they determine the form.")
    p, q = wanted[: pm.genus], wanted[pm.genus :]
    X, Y = np.asarray(pm.matrix.real, np.float64), np.asarray(pm.matrix.imag, np.float64)
    imaginary = np.linalg.solve(Y, np.asarray(X @ p - q, np.float64))
    s: Complexes = p + 1j * imaginary
    return s


def most_even_form(pm: PeriodMatrix) -> Complexes:
    """Coefficients of the differential of most even |ζ|, of mean |ζ|² equal to 1; (g,) complex.

    The best of several descents from random starts, which are always the same.

    Raises
    ------
    ComplexError
        If the surface is a sphere, or its triangles are so thin that their Laplacian is singular
        to rounding.
    """
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


def _checked_periods(pm: PeriodMatrix, periods: NDArray[np.inexact]) -> NDArray[np.inexact]:
    if periods.shape != (2 * pm.genus,):
        raise ValueError(
            f"periods must be {2 * pm.genus} numbers, along a_1..a_g and b_1..b_g, not an array "
            f"of shape {periods.shape}."
        )
    return periods
