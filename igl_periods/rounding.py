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

*Algebra.*  The Gram matrix is accurate to a few ulps of :math:`\sqrt{D_{ii} D_{jj}}` in the basis
in which it is computed; a change of basis U D Uᵀ adds such errors up, and loses digits where it
subtracts nearly parallel forms.
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

_ERROR = 4 * float(np.finfo(np.float64).eps)
# Faces up to this sensitivity are taken together: most are far below it.
_ORDINARY = 100.0


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

    The least r with ξᵀ loss ξ ≤ r ξᵀ D ξ is the largest eigenvalue of R⁻¹ loss R⁻ᵀ, D = R Rᵀ.  Its
    trace and its largest row sum are not below, and cost much less.
    """
    if not loss.any():
        return _ERROR * _ORDINARY
    R = cholesky_factor(D)
    half = scipy.linalg.solve_triangular(R, loss, lower=True)
    whole = scipy.linalg.solve_triangular(R, half.T, lower=True)
    largest = min(np.trace(whole), np.abs(whole).sum(axis=1).max())
    return _ERROR * (_ORDINARY + float(largest))


def congruence(U: NDArray[np.integer], D: Floats) -> tuple[Floats, float]:
    """U D Uᵀ, and the relative error of the result that rounding in D can cause.

    With |δD_ij| ≤ ε √(D_ii D_jj) the error of U D Uᵀ is at most ε t tᵀ entry by entry, where
    t = |U| √diag(D), and relative to U D Uᵀ = R Rᵀ at most ε ‖ |R⁻¹| t ‖².
    """
    changed = U @ D @ U.T
    changed = 0.5 * (changed + changed.T)
    if len(D) == 0:
        return changed, 0.0
    inverse = np.linalg.inv(cholesky_factor(changed))
    t = np.abs(U) @ np.sqrt(np.diag(D))
    return changed, _ERROR * float(np.sum((np.abs(inverse) @ t) ** 2))


def algebraic_allowance(D: Floats) -> float:
    """Relative error of the symplectic mean, and of Π, that rounding after D can cause.

    With D = R Rᵀ they are computed from Rᵀ J R, which is accurate to ε |Rᵀ| |J| |R|, and by
    inverting a block of D, which is :func:`congruence` with U = 1.
    """
    if len(D) == 0:
        return 0.0
    g, R = len(D) // 2, np.abs(cholesky_factor(D))
    skew = R[:g].T @ R[g:]
    _, inversion = congruence(np.eye(len(D), dtype=np.int64), D)
    return _ERROR * float(np.linalg.norm(skew + skew.T, 2)) + inversion
