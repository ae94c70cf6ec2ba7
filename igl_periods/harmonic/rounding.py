r"""How much of a certified bound is owed to floating-point arithmetic.

The certificate :math:`J D^{-1} J^T \le D_{exact} \le D` is a theorem about exact numbers.  What is
computed differs from them in two ways; the first is bounded here, relative to D itself, in the
sense :math:`|\xi^T \delta D\, \xi| \le r\, \xi^T D\, \xi`.

*Geometry.*  The lengths of a flipped edge are rounded, and energies are computed from rounded
areas.  If the sides of a triangle change by a relative ε, its metric, hence the energy of any
form on it, changes by at most a factor 1 ± εs with

.. math:: s = \frac{l_0 l_1 l_2 (l_0 + l_1 + l_2)}{2 A^2}

(write the metric as :math:`\sum_i l_i^2 B_i` with :math:`B_i(v, v) = - n_{i+1}(v)\, n_{i+2}(v) /
4 A^2`, n_i the covector of length l_i that vanishes on side i).  s is 8 for an equilateral
triangle, 4/θ for a needle of angle θ, and of order 1/θ² for a cap of angle π − θ.  A flip replaces
two faces by two others with a rounded diagonal: what was wrong with the old ones stays in the new
ones, and their own s is added; :attr:`DeltaComplex.distortion` keeps account of it.  But thin
triangles carry little energy: so the sum of :math:`\epsilon s_f D_f` over the faces is compared
with D as a matrix, instead of taking the worst s.

What rounding does to the sums, and on the way from D to Π, is in
:mod:`igl_periods.periods.rounding`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.linalg

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, length_sensitivity
from igl_periods.errors import ComplexError, NotPositiveDefiniteError
from igl_periods.machine import threads_by_size
from igl_periods.symplectic import cholesky_factor

ULP = 0.5 * float(np.finfo(np.float64).eps)
TRIANGLE_ERROR = 8 * ULP
# Faces up to this sensitivity are taken together: most are far below it.
_ORDINARY = 100.0
_POWER_STEPS = 30


def rounding_sensitivity(K: DeltaComplex) -> Floats:
    """Relative change of metric of each face in units of the error of one length; (m,)."""
    sensitivity = length_sensitivity(K.lengths)
    return sensitivity if K.distortion is None else sensitivity + K.distortion


def geometric_allowance(K: DeltaComplex, D: Floats, energies: Callable[[Floats], Floats]) -> float:
    """Relative error of D that rounded lengths and areas can cause.

    Parameters
    ----------
    K : DeltaComplex
        What the forms live on.
    D : (k, k) float
        Their Dirichlet matrix.
    energies : callable
        The Dirichlet matrix of the same forms with a weight for each face, (m,) → (k, k).
    """
    extreme = extreme_sensitivity(K)
    if not extreme.any():
        return TRIANGLE_ERROR * _ORDINARY
    return allowance_for_loss(D, energies(extreme))


def extreme_sensitivity(K: DeltaComplex) -> Floats:
    """The sensitivity of the faces where it is far from ordinary, 0 on the others; (m,)."""
    sensitivity = rounding_sensitivity(K)
    return np.where(sensitivity > _ORDINARY, sensitivity, 0.0)


def energy_factor(D: Floats) -> Floats:
    """The Cholesky factor of energies of harmonic forms.

    Raises
    ------
    ComplexError
        If they are not positive definite.
    """
    try:
        return cholesky_factor(D)
    except NotPositiveDefiniteError as error:
        raise ComplexError(
            f"the energy of the harmonic forms is {error}. Weights that are not an energy do this, "
            "for instance negative ones; so do surfaces too extreme for double precision, with "
            "necks thinner than about 1e-7 of their length."
        ) from error


@threads_by_size
def allowance_for_loss(D: Floats, loss: Floats) -> float:
    """Relative error of D, from the sum of s_f D_f over the faces of extreme sensitivity s_f.

    The least r with ξᵀ loss ξ ≤ r ξᵀ D ξ is the largest eigenvalue of R⁻¹ loss R⁻ᵀ, D = R Rᵀ.
    """
    if not loss.any():
        return TRIANGLE_ERROR * _ORDINARY
    R = energy_factor(D)
    half = scipy.linalg.solve_triangular(R, loss, lower=True)
    whole = scipy.linalg.solve_triangular(R, half.T, lower=True)
    return TRIANGLE_ERROR * (_ORDINARY + _largest_eigenvalue(whole))


@threads_by_size
def absolute_inverse(R: Floats) -> Floats:
    """|D⁻¹| of D = R Rᵀ, entry by entry; its lower triangle, and 0 above it, as in R."""
    lower, _ = scipy.linalg.lapack.dpotri(R, lower=1)
    return np.abs(lower, out=lower)


def amplified(lower: Floats, t: Floats) -> float:
    """By how much an error t tᵀ is larger than D at most: tᵀ |D⁻¹| t, from the lower triangle."""
    return float(2.0 * (t @ (lower @ t)) - (np.diag(lower) * t) @ t)


def _largest_eigenvalue(W: Floats) -> float:
    """The largest eigenvalue of a positive semidefinite matrix, from above and within 5 %, mostly.

    A few steps of the power method say what it should be, and r − W has a Cholesky factor only if
    r is above it: much cheaper than eigenvalues.  At the latest the largest row sum is above.
    """
    row_sum, v = float(np.abs(W).sum(axis=1).max()), W[:, np.argmax(np.diag(W))]
    for _ in range(_POWER_STEPS):
        v = W @ (v / np.linalg.norm(v))
    r = 1.05 * float(np.linalg.norm(v))
    while r < row_sum:
        try:
            np.linalg.cholesky(r * np.eye(len(W)) - W)
        except np.linalg.LinAlgError:
            r *= 1.5
        else:
            return r
    return row_sum
