r"""What rounding can change between the energies and the period matrix.

If all entries of a symmetric E are at most :math:`t_i t_j`, then

.. math:: |\xi^T E\, \xi| \le \Big( \sum_i t_i |\xi_i| \Big)^2 \le t^T |D^{-1}|\, t \; \xi^T D\, \xi

(write the sum as :math:`(D^{-1/2} \sigma t)^T (D^{1/2} \xi)` with σ the signs of ξ).  The Gram
matrix is taken to be accurate to a few ulps of :math:`\sqrt{D_{ii} D_{jj}}` in the basis in which
it is computed, so t is the root of its diagonal there.  (That is a rule, not a proof of every
rounding: sums over faces are formed in groups, so that few terms are added one after the other.)  A
relative error in this sense is the same in every basis: a change of basis U D Uᵀ adds only what
rounding does to that product.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Floats
from igl_periods.harmonic import (
    TRIANGLE_ERROR,
    ULP,
    absolute_inverse,
    amplified,
    energy_factor,
)
from igl_periods.machine import threads_by_size

LEAST_ALLOWANCE = 1e-13
_POWER_STEPS = 30
# Matrices with a smaller part of entries that are not 0 are multiplied as sparse ones.
_SPARSE = 0.1


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
    A = _matrix(U)
    sums = np.asarray(np.abs(A).sum(axis=1))
    unit = _unit(float(sums.max()) ** 2 * float(np.abs(D).max()))
    high = unit * np.rint(D / unit)
    changed = A @ high @ A.T + A @ (D - high) @ A.T
    changed = 0.5 * (changed + changed.T)
    inverse = absolute_inverse(energy_factor(changed))
    terms = int(np.count_nonzero(U, axis=1).max())
    # The sum is rounded once, and again where it is made symmetric; the second product has so many
    # terms, none above unit / 2.
    rounded = 2 * amplified(inverse, np.sqrt(np.diag(changed)))
    rounded += terms * unit * amplified(inverse, sums)
    given = amplified(absolute_inverse(energy_factor(D)), np.sqrt(np.diag(D)))
    return changed, TRIANGLE_ERROR * given + ULP * rounded


@threads_by_size
def algebraic_allowance(R: Floats) -> float:
    """Relative error of the symplectic mean, and of Π, that rounding after D = R Rᵀ can cause.

    They are computed from Rᵀ J R, which is accurate to nε |Rᵀ| |J| |R|, and by factoring and
    inverting D and its blocks, accurate to nε √(D_ii D_jj).
    """
    if len(R) == 0:
        return 0.0
    inversion = amplified(absolute_inverse(R), np.linalg.norm(R, axis=1))
    return 4 * len(R) * ULP * (_skew_norm(np.abs(R)) + inversion)


def _matrix(U: NDArray[np.integer]) -> Floats | csr_array:
    """U for products, sparse if it is: changes of basis of high genus mostly are 0."""
    A = U.astype(np.float64)
    return csr_array(A) if np.count_nonzero(U) < _SPARSE * U.size else A


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
