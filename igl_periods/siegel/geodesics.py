r"""Geodesics of the Siegel upper half-space: the shortest way from one period matrix to another.

A real symplectic map takes Π₁ = X + iLLᵀ to i and Π₂ to :math:`W = L^{-1} (\Pi_2 - X) L^{-T}`, the
Cayley transform to :math:`Z = (W - i)(W + i)^{-1}` in the disk of symmetric matrices with Z*Z < 1.
With a Takagi factorisation :math:`Z = U \tanh(\tfrac12 \log \lambda)\, U^T` the geodesic from 0 to
Z is

.. math:: Z(t) = U \tanh(\tfrac t2 \log\lambda)\, U^T, \qquad
          \log_{\Pi_1} \Pi_2 = i\, L\, U \log\lambda\; U^T L^T ,

the second being its initial velocity.  Its square in Siegel's metric,
:math:`\operatorname{tr} Y^{-1} \partial\Pi\, Y^{-1} \overline{\partial\Pi}`, is that of the
distance, :math:`\sum_i \log^2 \lambda_i`.  Takagi's U need not be known: if f is even,
:math:`U \sigma f(\sigma) U^T = f(\sqrt{Z Z^*})\, Z`.

References
----------
Siegel, "Symplectic geometry" (1943), chapters II and III.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats
from igl_periods.options import checked_integer

from .half_space import check_same_genus, check_siegel_point

# Below this σ, tanh⁻¹(σ)/σ and tanh(σ)/σ are 1 to rounding.
_SMALL = 1e-8


def siegel_logarithm(Pi: ArrayLike, target: ArrayLike) -> Complexes:
    """The initial velocity of the geodesic that reaches ``target`` from Π at time 1; (g, g).

    Raises
    ------
    NotASiegelPointError
        If one of them is not a point of the half-space.
    ValueError
        If they have different genus.

    Examples
    --------
    >>> import igl_periods as ip
    >>> ip.siegel_logarithm([[1j]], [[2j]]).round(9)
    array([[0.+0.69314718j]])
    """
    start, end = check_same_genus(Pi, target)
    L, Z = _disk_point(start, end)
    # Twice the hyperbolic length, as Z has tanh(½ log λ).
    return _symmetric(2j * L @ _of_singular_values(_artanh_quotient, Z) @ L.T)


def siegel_exponential(Pi: ArrayLike, velocity: ArrayLike) -> Complexes:
    """Where the geodesic from Π with a complex symmetric initial velocity is at time 1; (g, g).

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the half-space.
    ValueError
        If the velocity has another shape.

    Examples
    --------
    >>> import igl_periods as ip
    >>> ip.siegel_exponential([[1j]], ip.siegel_logarithm([[1j]], [[2j]])).round(9)
    array([[0.+2.j]])
    """
    start = check_siegel_point(Pi)
    tangent = np.asarray(velocity, dtype=np.complex128)
    if tangent.shape != start.shape:
        raise ValueError(f"a velocity at Π has the shape {start.shape}, not {tangent.shape}.")
    L = np.linalg.cholesky(start.imag)
    if len(start) == 0:
        return start
    at_i = np.linalg.solve(L, np.linalg.solve(L, tangent).T)
    Z = _of_singular_values(_tanh_quotient, _symmetric(at_i / 2j))
    unit = np.eye(len(Z))
    # i (1 + Z)(1 − Z)⁻¹ = i + 2i Z (1 − Z)⁻¹
    W = 2j * np.linalg.solve(unit - Z, Z)
    return _symmetric(start + L @ W @ L.T)


def moduli_path(Pi1: ArrayLike, Pi2: ArrayLike, n: int) -> Complexes:
    """Points at equal distances on the geodesic from Π₁ to Π₂; (n, g, g) complex.

    In genus 1, 2 and 3 nearly all points of the half-space are period matrices of surfaces; from
    genus 4 on nearly none is.

    Parameters
    ----------
    Pi1, Pi2 : (g, g) array-like or PeriodMatrix
    n : int
        Number of points, both ends included; at least 2.

    Raises
    ------
    NotASiegelPointError
        If one of them is not a point of the half-space.
    ValueError
        If they have different genus, or n < 2.

    Examples
    --------
    >>> moduli_path([[1j]], [[4j]], 3)[1].round(12)  # the geometric mean
    array([[0.+2.j]])
    """
    n = checked_integer("n", n)
    if n < 2:
        raise ValueError(f"n = {n}: a path has 2 points at least, its ends.")
    start, end = check_same_genus(Pi1, Pi2)
    velocity = siegel_logarithm(start, end)
    inner = [siegel_exponential(start, t * velocity) for t in np.linspace(0.0, 1.0, n)[1:-1]]
    return np.stack([start, *inner, end])


def orthonormal_weights(Pi: ArrayLike) -> Complexes:
    """The W for which Re Σ W̄ ∂Π are orthonormal coordinates of tangents; (g (g + 1), g, g).

    With Im Π = L Lᵀ they are the coordinates of L⁻¹ ∂Π L⁻ᵀ in the basis E_jj, (E_jk + E_kj)/√2 of
    symmetric matrices, and i times it.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the half-space.
    """
    inverse = np.linalg.inv(np.linalg.cholesky(check_siegel_point(Pi).imag))
    g = len(inverse)
    j, k = np.triu_indices(g)
    units = np.zeros((j.size, g, g), dtype=np.complex128)
    size = np.where(j == k, 1.0, np.sqrt(0.5))
    units[np.arange(j.size), j, k] = units[np.arange(j.size), k, j] = size
    return np.asarray(inverse.T @ np.concatenate([units, 1j * units]) @ inverse)


def _disk_point(start: Complexes, end: Complexes) -> tuple[Floats, Complexes]:
    """L with Im Π₁ = L Lᵀ, and the Z of Π₂ in the disk around Π₁."""
    L = np.asarray(np.linalg.cholesky(start.imag), dtype=np.float64)
    difference = np.linalg.solve(L, np.linalg.solve(L, end - start).T)
    unit = np.eye(len(L))
    return L, _symmetric(np.linalg.solve(difference + 2j * unit, difference))


def _of_singular_values(f: Callable[[Floats], Floats], Z: Complexes) -> Complexes:
    """U σ f(σ) Uᵀ for Z = U σ Uᵀ."""
    squares, U = np.linalg.eigh(Z @ Z.conj().T)
    sigma = np.sqrt(np.maximum(squares, 0.0))
    return np.asarray((U * f(sigma)) @ U.conj().T @ Z)


def _artanh_quotient(sigma: Floats) -> Floats:
    below_one = np.minimum(sigma, 1.0 - np.finfo(np.float64).epsneg)
    return _quotient(np.arctanh(below_one), sigma)


def _tanh_quotient(sigma: Floats) -> Floats:
    return _quotient(np.tanh(sigma), sigma)


def _quotient(values: Floats, sigma: Floats) -> Floats:
    return np.divide(values, sigma, out=np.ones_like(sigma), where=sigma > _SMALL)


def _symmetric(A: Any) -> Complexes:
    return np.asarray(0.5 * (A + A.T), dtype=np.complex128)
