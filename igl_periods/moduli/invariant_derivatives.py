r"""How invariants of the surface change with Π: theta constants, Klein's j, roots, Igusa.

All of them are holomorphic functions f of Π, and what is computed is the symmetric matrix f' with

.. math:: \partial f = \sum_{kl} f'_{kl}\, \partial\Pi_{kl} .

So f' goes with derivatives of Π: forward ``(f' * pm.derivative(…)).sum()``, backward
``pm.gradient(np.conj(f'))`` for Re f, ``pm.gradient(1j * np.conj(f'))`` for Im f.

Theta constants are differentiated term by term,

.. math:: \theta'_{a,b} = \pi i \sum_{m \equiv a} \tfrac14\, m\, m^T
          \exp \pi i \big( \tfrac14 m^T \Pi\, m + \tfrac12 m^T b \big), \qquad m = 2n + a ,

which is the heat equation.  j and the roots are rational functions of them, evaluated where Π is
reduced: :math:`\gamma\cdot\Pi` moves by :math:`(c\Pi + d)^{-T}\, \partial\Pi\, (c\Pi + d)^{-1}`.

References
----------
Mumford, "Tata lectures on theta I" (1983), section II.1, for the heat equation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Ints
from igl_periods.siegel import check_siegel_point, short_vectors, siegel_reduce

from .genus_two import igusa_clebsch_invariants, rosenhain_roots
from .theta import of_genus

# Terms below e^-44 are less than rounding, also with the factor m mᵀ.
_SMALLEST_TERM = 44.0
# Points of a circle on which polynomials of degree up to 16 are differentiated exactly.
_CIRCLE = 18


def theta_derivatives(Pi: ArrayLike) -> Complexes:
    """The derivatives of the theta constants of all characteristics; (2^g, 2^g, g, g).

    Parameters
    ----------
    Pi : (g, g) array-like or PeriodMatrix

    Returns
    -------
    (2^g, 2^g, g, g) complex
        Entry [a, b] is θ'_{a,b}, characteristics as in :func:`theta_constants`.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.
    EnumerationLimitError
        If Im Π is so small that the series has too many terms; Siegel reduce it.

    Examples
    --------
    >>> float(theta_derivatives([[1j]])[0, 0, 0, 0].imag.round(7))  # θ / 4 at τ = i
    0.2716087
    """
    return _theta_sums(check_siegel_point(Pi))[1]


def j_derivative(Pi: ArrayLike) -> complex:
    """The derivative dj/dτ of Klein's j of a surface of genus 1.

    Raises
    ------
    ValueError
        If Π is not 1 × 1 (NotASiegelPointError if it is not a point of the upper half-plane).

    Examples
    --------
    >>> abs(j_derivative([[1j]])) < 1e-8  # j is 1728 to second order at i
    True
    """
    matrix, gamma = siegel_reduce(of_genus(Pi, 1))
    values, slopes = _theta_sums(matrix)
    theta, slope = (sums.reshape(-1)[:3] for sums in (values, slopes))
    total, product = (theta**8).sum(), theta.prod() ** 8
    by_total = 3.0 * (8.0 * theta**7 * slope).sum()
    by_product = 8.0 * (slope / theta).sum()
    slope_there = 32.0 * total**2 / product * (by_total - total * by_product)
    return complex(slope_there * _chained(np.ones((1, 1), complex), gamma, of_genus(Pi, 1))[0, 0])


def rosenhain_derivatives(Pi: ArrayLike) -> Complexes:
    """The derivatives of λ, μ, ν of :func:`rosenhain_roots`; (3, 2, 2).

    Raises
    ------
    ValueError
        As :func:`rosenhain_roots`.
    """
    roots = rosenhain_roots(Pi)
    matrix, gamma = siegel_reduce(of_genus(Pi, 2))
    values, slopes = _theta_sums(matrix)
    logarithmic = 2.0 * slopes / np.where(values == 0.0, 1.0, values)[..., None, None]
    t0, t1, t2, t3 = (logarithmic[0, b] for b in (0b00, 0b10, 0b01, 0b11))
    t12, t15 = logarithmic[0b11, 0b00], logarithmic[0b11, 0b11]
    moved = np.stack([t0 + t1 - t2 - t3, t1 + t12 - t2 - t15, t0 + t12 - t3 - t15])
    return _chained(roots[:, None, None] * moved, gamma, of_genus(Pi, 2))


def igusa_derivatives(Pi: ArrayLike) -> Complexes:
    """The derivatives of the three :func:`absolute_igusa_invariants`; (3, 2, 2).

    Raises
    ------
    ValueError
        As :func:`rosenhain_roots`.
    """
    roots = rosenhain_roots(Pi)
    i2, i4, i6, i10 = igusa_clebsch_invariants(roots)
    by_root = np.stack([_partial(roots, k) for k in range(3)], axis=1)
    d2, d4, d6, d10 = by_root
    absolute = np.array([i2**5, i2**3 * i4, i2**2 * i6])[:, None] / i10
    numerators = [
        5 * i2**4 * d2,
        3 * i2**2 * i4 * d2 + i2**3 * d4,
        2 * i2 * i6 * d2 + i2**2 * d6,
    ]
    slopes = np.stack(numerators) / i10 - absolute * d10 / i10
    return np.asarray(np.einsum("ir,rkl->ikl", slopes, rosenhain_derivatives(Pi)))


def _partial(roots: Complexes, k: int) -> Complexes:
    """The derivatives of I₂, I₄, I₆, I₁₀ by root k: polynomials, so Cauchy's sum is exact."""
    turns = np.exp(2j * np.pi * np.arange(_CIRCLE) / _CIRCLE)
    # A turn by half a step keeps the points of the circle away from the other roots.
    radius = 0.5 * abs(roots[k]) * np.exp(1j * np.pi / _CIRCLE)
    unit = np.eye(3)[k]
    values = [igusa_clebsch_invariants(roots + radius * turn * unit) for turn in turns]
    return np.asarray(turns.conj() @ np.array(values) / (_CIRCLE * radius))


def _theta_sums(Pi: Complexes) -> tuple[Complexes, Complexes]:
    """Theta constants (2^g, 2^g) and their derivatives (2^g, 2^g, g, g)."""
    g = len(Pi)
    m, _ = short_vectors(Pi.imag, 4.0 * _SMALLEST_TERM / np.pi)
    terms = np.exp(0.25j * np.pi * np.einsum("ni,ij,nj->n", m, Pi, m, optimize=True))
    binary = 1 << np.arange(g)[::-1]
    a = (m % 2) @ binary
    signs = 1j ** ((m @ _digits(g).T) % 4)
    squares = 0.25j * np.pi * m[:, :, None] * m[:, None, :]
    values = np.zeros((2**g, 2**g), dtype=np.complex128)
    slopes = np.zeros((2**g, 2**g, g, g), dtype=np.complex128)
    for parity in range(2**g):
        mine = a == parity
        weights = signs[mine] * terms[mine, None]
        values[parity] = weights.sum(axis=0)
        slopes[parity] = np.tensordot(weights.T, squares[mine], axes=1)
    return values, slopes


def _digits(g: int) -> Ints:
    """All b in binary order, the leading digit first; (2^g, g)."""
    return (np.arange(2**g)[:, None] >> np.arange(g)[::-1]) & 1


def _chained(slopes: Complexes, gamma: Ints, Pi: Complexes) -> Complexes:
    """Derivatives by Π from those by γ·Π."""
    g = len(Pi)
    Q = np.linalg.inv(gamma[g:, :g] @ Pi + gamma[g:, g:])
    return np.asarray(Q @ slopes @ Q.T)
