r"""How period matrices change with the energies: derivatives of the symplectic mean and its kin.

Let D = Tᵀ Δ T be the Williamson form, Δ = diag(d, d), and B = T⁻ᵀ the basis of forms in which D is
diagonal.  With E = B ∂D Bᵀ and F = Δ⁻¹ E Δ⁻¹ the symplectic mean G = TᵀT moves by

.. math:: \partial G = T^T Z\, T, \qquad
          Z_{ij} = \frac{(F - J F J^T)_{ij}}{1/d_i + 1/d_j}

(differentiate G D⁻¹ G = J D Jᵀ at G = 1: the geometric mean of D and J D⁻¹ Jᵀ is its solution).  No
denominator vanishes, so multiple symplectic eigenvalues do no harm.  Π = X + iY follows from the
blocks of G,

.. math:: \partial Y = -Y\, \partial G_{bb}\, Y, \qquad
          \partial X = -(\partial G_{ab} + X\, \partial G_{bb})\, Y .

The primal estimate has the same derivative with ∂D in the place of ∂G; the dual one has the
transpose of its X, and :math:`\partial Y = (1, X)\, \partial D\, (1, X)^T`.  Backward, the gradient
of a real function φ of Π becomes that of φ by D, through the transposes of the same maps.

References
----------
Bhatia, "Positive definite matrices" (2007), chapter 4, for geometric means.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Complexes, Floats

from .canonical_basis import standard_form
from .williamson_form import cholesky_factor, siegel_point, williamson_basis, williamson_of_factor

_Number = TypeVar("_Number", np.float64, np.complex128)


@dataclass(frozen=True, eq=False)
class EstimateDerivative:
    """The derivative of a period matrix by the energies, forward and backward.

    Attributes
    ----------
    forward : callable
        ∂D (…, 2g, 2g), symmetric, to ∂Π (…, g, g) complex.
    backward : callable
        W (…, g, g) complex to the symmetric S (…, 2g, 2g) with Re Σ W̄ ∂Π = Σ S ∂D for all ∂D.
    """

    forward: Callable[[Floats], Complexes]
    backward: Callable[[Complexes], Floats]


def estimate_derivative(D: Floats, estimate: str = "matrix") -> EstimateDerivative:
    """The derivative at D of an estimate of the period matrix.

    Parameters
    ----------
    D : (2g, 2g) float
        Symmetric, positive definite.
    estimate : {"matrix", "primal", "dual", "mean"}
        The symplectic mean, or one of the estimates of the paper.

    Raises
    ------
    ValueError
        If there is no such estimate.
    NotPositiveDefiniteError
        If D is not positive definite.
    """
    if estimate == "matrix":
        mean = _MeanDerivative(cholesky_factor(D))
        return EstimateDerivative(mean.forward, mean.backward)
    blocks = _BlockDerivative(D)
    if estimate == "primal":
        return EstimateDerivative(blocks.primal, blocks.primal_transposed)
    if estimate == "dual":
        return EstimateDerivative(blocks.dual, blocks.dual_transposed)
    if estimate == "mean":
        return EstimateDerivative(
            lambda dD: 0.5 * (blocks.primal(dD) + blocks.dual(dD)),
            lambda W: 0.5 * (blocks.primal_transposed(W) + blocks.dual_transposed(W)),
        )
    raise ValueError(f'estimate must be "matrix", "primal", "dual" or "mean", not {estimate!r}.')


@dataclass(frozen=True, eq=False)
class _MeanDerivative:
    """The derivative of the symplectic mean of D = R Rᵀ, and of its period matrix."""

    R: Floats

    @cached_property
    def _basis(self) -> tuple[Floats, Floats, Floats]:
        """B, its inverse, and 1/d, each twice."""
        g = len(self.R) // 2
        B = williamson_basis(self.R).transpose(1, 0, 2).reshape(2 * g, 2 * g)
        J = standard_form(g)
        d = np.einsum("ij,ij->i", B @ self.R, B @ self.R)
        return B, J @ B.T @ J.T, 1.0 / d

    @cached_property
    def _point(self) -> Complexes:
        return siegel_point(williamson_of_factor(self.R)[1])

    def _damped(self, F: Floats) -> Floats:
        _, _, inverse = self._basis
        return F / (inverse[:, None] + inverse)

    def forward(self, dD: Floats) -> Complexes:
        B, back, inverse = self._basis
        J = standard_form(len(B) // 2)
        F = (inverse[:, None] * inverse) * (B @ dD @ B.T)
        dG = back @ self._damped(F - J @ F @ J.T) @ back.T
        return _symmetric(_point_derivative(self._point, dG))

    def backward(self, W: Complexes) -> Floats:
        B, back, inverse = self._basis
        J = standard_form(len(B) // 2)
        S = _point_transposed(self._point, _symmetric(W))
        H = self._damped(back.T @ S @ back)
        return _symmetric(B.T @ ((inverse[:, None] * inverse) * (H - J.T @ H @ J)) @ B)


@dataclass(frozen=True, eq=False)
class _BlockDerivative:
    """The derivatives of the primal and of the dual estimate of D."""

    D: Floats

    @cached_property
    def _primal(self) -> Complexes:
        g = len(self.D) // 2
        inverse = np.linalg.inv(self.D[g:, g:])
        return -self.D[:g, g:] @ inverse + 1j * inverse

    def primal(self, dD: Floats) -> Complexes:
        return _point_derivative(self._primal, dD)

    def primal_transposed(self, W: Complexes) -> Floats:
        return _point_transposed(self._primal, W)

    def _rows(self) -> Floats:
        X = self._primal.real
        return np.hstack([np.eye(len(X)), X])

    def dual(self, dD: Floats) -> Complexes:
        rows = self._rows()
        dX = _point_derivative(self._primal, dD).real
        return np.swapaxes(dX, -1, -2) + 1j * (rows @ dD @ rows.T)

    def dual_transposed(self, W: Complexes) -> Floats:
        rows = self._rows()
        by_X = _point_transposed(self._primal, np.asarray(np.swapaxes(W.real, -1, -2), complex))
        return by_X + _symmetric(rows.T @ W.imag @ rows)


def _point_derivative(Pi: Complexes, dG: Floats) -> Complexes:
    """∂X + i ∂Y of X = −G_ab G_bb⁻¹, Y = G_bb⁻¹."""
    g, X, Y = len(Pi), Pi.real, Pi.imag
    ab, bb = dG[..., :g, g:], dG[..., g:, g:]
    return -(ab + X @ bb) @ Y - 1j * (Y @ bb @ Y)


def _point_transposed(Pi: Complexes, W: Complexes) -> Floats:
    """The symmetric S with Σ S ∂G = Re Σ W̄ (∂X + i ∂Y) for symmetric ∂G."""
    g, X, Y = len(Pi), Pi.real, Pi.imag
    S = np.zeros((*W.shape[:-2], 2 * g, 2 * g))
    S[..., :g, g:] = -W.real @ Y.T
    S[..., g:, g:] = X.T @ S[..., :g, g:] - Y.T @ W.imag @ Y.T
    return _symmetric(S)


def _symmetric(A: NDArray[_Number]) -> NDArray[_Number]:
    return np.asarray(0.5 * (A + np.swapaxes(A, -1, -2)), dtype=A.dtype)
