r"""How much of a certified bound is owed to floating-point arithmetic.

The certificate :math:`J D^{-1} J^T \le D_{exact} \le D` is a theorem about exact numbers.  What is
computed differs from them in two ways, and each is bounded here relative to D itself, in the
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

*Algebra.*  If all entries of a symmetric E are at most :math:`t_i t_j`, then

.. math:: |\xi^T E\, \xi| \le \Big( \sum_i t_i |\xi_i| \Big)^2 \le t^T |D^{-1}|\, t \; \xi^T D\, \xi

(write the sum as :math:`(D^{-1/2} \sigma t)^T (D^{1/2} \xi)` with σ the signs of ξ).  The Gram
matrix is taken to be accurate to a few ulps of :math:`\sqrt{D_{ii} D_{jj}}` in the basis in which
it is computed, so t is the root of its diagonal there.  (That is a rule, not a proof of every
rounding: sums over faces are formed in groups, so that few terms are added one after the other.)  A
relative error in this sense is the same in every basis: a change of basis U D Uᵀ adds only what
rounding does to that product.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from .delta_complex import DeltaComplex
from .symplectic import cholesky_factor
from .triangles import length_sensitivity

Floats = NDArray[np.float64]

LEAST_ALLOWANCE = 1e-13

_ULP = 0.5 * float(np.finfo(np.float64).eps)
_ERROR = 8 * _ULP
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
        return _ERROR * _ORDINARY
    return allowance_for_loss(D, energies(extreme))


def extreme_sensitivity(K: DeltaComplex) -> Floats:
    """The sensitivity of the faces where it is far from ordinary, 0 on the others; (m,)."""
    sensitivity = rounding_sensitivity(K)
    return np.where(sensitivity > _ORDINARY, sensitivity, 0.0)


def allowance_for_loss(D: Floats, loss: Floats) -> float:
    """Relative error of D, from the sum of s_f D_f over the faces of extreme sensitivity s_f.

    The least r with ξᵀ loss ξ ≤ r ξᵀ D ξ is the largest eigenvalue of R⁻¹ loss R⁻ᵀ, D = R Rᵀ.
    """
    if not loss.any():
        return _ERROR * _ORDINARY
    R = cholesky_factor(D)
    half = scipy.linalg.solve_triangular(R, loss, lower=True)
    whole = scipy.linalg.solve_triangular(R, half.T, lower=True)
    return _ERROR * (_ORDINARY + _largest_eigenvalue(whole))


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


def combined(one: float, other: float) -> float:
    """Two relative errors one after the other: (1 + r₁)(1 + r₂) − 1."""
    return one + other + one * other


def congruence(U: NDArray[np.integer], D: Floats) -> tuple[Floats, float]:
    """U D Uᵀ, and the relative error of the result that rounding in D and after it can cause.

    Entries of D are taken to be off by a few ulps of √(D_ii D_jj).  The product is exact in the
    leading digits of D; the others are so small that errors of ulps of them hardly count.
    """
    if len(D) == 0:
        return D.copy(), 0.0
    A = U.astype(np.float64)
    sums = np.abs(A).sum(axis=1)
    unit = _unit(float(sums.max()) ** 2 * float(np.abs(D).max()))
    high = unit * np.rint(D / unit)
    changed = A @ high @ A.T + A @ (D - high) @ A.T
    changed = 0.5 * (changed + changed.T)
    inverse = _absolute_inverse(cholesky_factor(changed))
    terms = int(np.count_nonzero(A, axis=1).max())
    # The sum is rounded once, and again where it is made symmetric; the second product has so many
    # terms, none above unit / 2.
    rounded = 2 * _amplified(inverse, np.sqrt(np.diag(changed)))
    rounded += terms * unit * _amplified(inverse, sums)
    given = _amplified(_absolute_inverse(cholesky_factor(D)), np.sqrt(np.diag(D)))
    return changed, _ERROR * given + _ULP * rounded


def algebraic_allowance(R: Floats) -> float:
    """Relative error of the symplectic mean, and of Π, that rounding after D = R Rᵀ can cause.

    They are computed from Rᵀ J R, which is accurate to nε |Rᵀ| |J| |R|, and by factoring and
    inverting D and its blocks, accurate to nε √(D_ii D_jj).
    """
    if len(R) == 0:
        return 0.0
    inversion = _amplified(_absolute_inverse(R), np.linalg.norm(R, axis=1))
    return 4 * len(R) * _ULP * (_skew_norm(np.abs(R)) + inversion)


def _absolute_inverse(R: Floats) -> Floats:
    """|D⁻¹|, entry by entry, of D = R Rᵀ."""
    lower, _ = scipy.linalg.lapack.dpotri(R, lower=1)
    lower = np.abs(np.tril(lower))
    return np.asarray(lower + np.tril(lower, -1).T)


def _amplified(inverse: Floats, t: Floats) -> float:
    """By how much an error t tᵀ is larger than D at most: tᵀ |D⁻¹| t."""
    return float(t @ inverse @ t)


def _skew_norm(R: Floats) -> float:
    """A bound of ‖Rᵀ |J| R‖₂ for R without negative entries.

    For a symmetric M without negative entries and any v > 0 it is at most max (Mv)_i / v_i; v
    comes from a few steps of the power method for 1 + M / ‖M‖, which stays positive.
    """
    (top, bottom), v, bound = np.split(R, 2), np.ones(len(R)), np.inf
    for _ in range(_POWER_STEPS):
        image = top.T @ (bottom @ v) + bottom.T @ (top @ v)
        bound = min(bound, float((image / v).max()))
        v = v / v.max() + image / image.max()
    return bound


def _unit(largest: float) -> float:
    """A power of 2 such that numbers up to ``largest`` are less than 2^52 of it."""
    return float(np.ldexp(1.0, int(np.ceil(np.log2(largest))) - 52))
