r"""Trial functions of high degree on a triangle, and on a triangle at the apex of a cone.

Let a triangle have its apex at 0 and the opposite side from a to b.  Its points are t R(s) with
R(s) = a + s (b − a), 0 ≤ s, t ≤ 1.  On a cone of total angle θ harmonic functions are power
series in the real and imaginary parts of :math:`z^\kappa`, κ = 2π/θ; therefore the radial
coordinate of trial functions is :math:`\tau = t^\kappa`.  With h the height on the side from a to
b, ℓ its length, λ = h/ℓ, and x ∈ R the place of the foot of the height (R(x) ⟂ b − a), the
Dirichlet energy is a sum of two squares,

.. math::

    \int |\nabla u|^2 = \int_0^1\!\!\int_0^1 \left[
        \frac1\lambda \Big( \sqrt{\kappa\tau}\, u_\tau - \frac{(s - x)\, u_s}{\sqrt{\kappa\tau}}
        \Big)^{\!2} + \lambda\, \frac{u_s^2}{\kappa\tau} \right] d\tau\, ds,

of the derivatives along the side and along the height.  It depends on the cotangents at a and b
alone, 1/λ = cot a + cot b and x = λ cot a, and on κ.

*Conical element* of degree p: degree p in τ and in s, constant at τ = 0; p (p + 1) + 1 functions.
*Flat element* of degree p: the polynomials of degree p in the plane, in the same coordinates with
κ = 1; (p + 1)(p + 2)/2 functions.  Both are spanned by products of a function of s and one of τ,

.. math::  1 - s,\; s,\; \ell_2(s), \dots, \ell_p(s)
           \qquad\text{and}\qquad \tau^b,\;\; \tau^b (1 - \tau) P^{(1, b)}_j(2\tau - 1),

and the function 1 − τ at the apex.  Here :math:`\ell_k` is the integrated Legendre polynomial,
:math:`\ell_k(0) = \ell_k(1) = 0`, :math:`\int \ell_k' \ell_l' = \delta_{kl}`.  The exponent b is 1
in the conical element; in the flat one it is the degree of the function of s.

On the opposite side a trial function is a polynomial of degree p in s, on the radial sides one in
τ; in all cases 1 − x, x and :math:`\ell_k(x)` are a basis of the traces.  They agree between
neighbours when the values at corners and the coefficients of the ℓ_k agree, where
:math:`\ell_k(1 - x) = (-1)^k \ell_k(x)` takes care of directions.  This hierarchical basis is
used, not a nodal one of the same space, because its coefficients decay: a smooth function has
small coefficients where derivatives are large, and gradients keep full relative accuracy up to
degree 20 and more (derivatives of nodal bases lose a factor p² and more).

References
----------
Szabó, Babuška, "Finite element analysis" (1991), chapter 6, for the hierarchical basis.
Karniadakis, Sherwin, "Spectral/hp element methods" (2005), section 3.2, for collapsed coordinates.
Babuška, Oh, "The p-version of the finite element method for domains with corners" (1990), for
auxiliary conformal mappings at corners.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import eval_jacobi

from igl_periods.arrays import Floats, Ints


@dataclass(frozen=True, eq=False)
class ReferenceElement:
    """The trial functions of one degree, which know their values everywhere.

    The first 3 p functions are those that do not vanish on the sides, the rest are bubbles.  The
    order of the first is: apex, corner a, corner b; ℓ_2 … ℓ_p along the side from a to b, along
    the side from b to the apex, along the side from the apex to a.

    Attributes
    ----------
    degree : int
    factors : (n - 1, 2) int
        Of each function but the first: the number of its factor in s, and that of its factor in τ
        (-1 for τ^b, j for the bubble with P_j).
    powers : (n - 1,) int
        The exponent b of its factor in τ.
    signs : (n - 1,) float
        -1 where the side runs towards the apex and ℓ_k is odd, 1 elsewhere.
    """

    degree: int
    factors: Ints
    powers: Ints
    signs: Floats

    @property
    def n_functions(self) -> int:
        """Number n of functions."""
        return len(self.factors) + 1

    @property
    def n_traces(self) -> int:
        """Number 3 p of functions that do not vanish on the sides."""
        return 3 * self.degree

    def tabulate(self, s: Floats, tau: Floats) -> tuple[Floats, Floats, Floats]:
        """Values u, derivatives u_τ, and quotients u_s / τ of all functions at points (s, τ).

        Returns
        -------
        three (len(s), n) float
        """
        along, along_derivative = _angular_functions(self.degree, s)
        values, by_tau, by_s = np.empty((3, s.size, self.n_functions))
        values[:, 0], by_tau[:, 0], by_s[:, 0] = 1.0 - tau, -1.0, 0.0
        functions = zip(self.factors, self.powers, self.signs, strict=True)
        for column, ((i, j), b, sign) in enumerate(functions, start=1):
            quotient, derivative = _radial_function(int(b), int(j), tau)
            values[:, column] = sign * along[i] * tau * quotient
            by_tau[:, column] = sign * along[i] * derivative
            by_s[:, column] = sign * along_derivative[i] * quotient
        return values, by_tau, by_s

    @cached_property
    def quadrature(self) -> Quadrature:
        """The gradients at the points of a quadrature that is exact for energies."""
        tau, tau_weights = _gauss(self.degree)
        s, s_weights = _gauss(self.degree + 1)
        s, tau = np.repeat(s, tau.size), np.tile(tau, s.size)
        root = np.sqrt(np.outer(s_weights, tau_weights).ravel() * tau)[:, None]
        _, by_tau, by_s = self.tabulate(s, tau)
        return Quadrature(*(_read_only(a) for a in (s, root * by_tau, root * by_s)))

    @cached_property
    def stiffness_terms(self) -> Floats:
        """Six matrices of which every energy matrix is a combination, as rows; (6, n²).

        With P = ``quadrature.by_tau``, Q = ``quadrature.by_s`` and s counted from 1/2: PᵀP, the
        symmetric parts of Pᵀ s Q and PᵀQ, Qᵀ s² Q, Qᵀ s Q and QᵀQ.
        """
        P, Q = self.quadrature.by_tau, self.quadrature.by_s
        moment = (self.quadrature.nodes - 0.5)[:, None] * Q
        mixed, central = P.T @ moment, P.T @ Q
        terms = [P.T @ P, mixed + mixed.T, central + central.T]
        terms += [moment.T @ moment, moment.T @ Q, Q.T @ Q]
        return _read_only(np.stack(terms).reshape(6, -1))


class Quadrature(NamedTuple):
    """Gradients of all functions at q points of weights w.

    Attributes
    ----------
    nodes : (q,) float
        The values of s.
    by_tau, by_s : (q, n) float
        sqrt(w τ) u_τ and sqrt(w / τ) u_s.
    """

    nodes: Floats
    by_tau: Floats
    by_s: Floats


@lru_cache(maxsize=64)
def flat_element(degree: int) -> ReferenceElement:
    """Polynomials of degree ``degree`` ≥ 1 in the plane; (p + 1)(p + 2)/2 functions."""
    return _element(degree, n_bubbles=lambda i: degree - i, power=lambda i: max(i, 1))


@lru_cache(maxsize=64)
def conical_element(degree: int) -> ReferenceElement:
    """Degree ``degree`` ≥ 1 in τ and in s, constant at the apex; p (p + 1) + 1 functions."""
    return _element(degree, n_bubbles=lambda i: degree - 1, power=lambda i: 1)


def _element(
    degree: int, n_bubbles: Callable[[int], int], power: Callable[[int], int]
) -> ReferenceElement:
    """The element with so many bubbles of each ℓ_i(s), and such powers of τ at functions of s."""
    k = range(2, degree + 1)
    traces = [
        (0, -1),
        (1, -1),
        *((i, -1) for i in k),
        *((1, i - 2) for i in k),
        *((0, i - 2) for i in k),
    ]
    bubbles = [(i, j) for i in k for j in range(n_bubbles(i))]
    signs = np.ones(len(traces) + len(bubbles))
    signs[degree + 1 : 2 * degree] = [(-1) ** i for i in k]
    factors = np.array(traces + bubbles, dtype=np.int64).reshape(-1, 2)
    powers = np.array([power(int(i)) for i in factors[:, 0]], dtype=np.int64)
    return ReferenceElement(degree, _read_only(factors), _read_only(powers), _read_only(signs))


def _radial_function(b: int, j: int, tau: Floats) -> tuple[Floats, Floats]:
    """R/τ and R' for R = τ^b (j = -1) or the bubble -c/(j+1) τ^b (1-τ) P_j^{(1,b)}(2τ-1).

    For b = 1 the bubble is ℓ_{j+2}(τ).
    """
    power = tau ** (b - 1)
    if j < 0:
        return power, b * power
    c = np.sqrt(2.0 * j + 3.0)
    z = 2.0 * tau - 1.0
    quotient = -c / (j + 1) * power * (1.0 - tau) * eval_jacobi(j, 1, b, z)
    return quotient, c * power * eval_jacobi(j + 1, 0, b - 1, z)


def _angular_functions(degree: int, s: Floats) -> tuple[list[Floats], list[Floats]]:
    """1 - s, s, ℓ_2(s), …, ℓ_p(s) and their derivatives."""
    one = np.ones_like(s)
    values, derivatives = [1.0 - s, s], [-one, one]
    for k in range(2, degree + 1):
        quotient, derivative = _radial_function(1, k - 2, s)
        values.append(s * quotient)
        derivatives.append(derivative)
    return values, derivatives


def _gauss(n: int) -> tuple[Floats, Floats]:
    """Gauss–Legendre points and weights on [0, 1]."""
    x, w = np.polynomial.legendre.leggauss(n)
    return 0.5 * (x + 1.0), 0.5 * w


def _read_only(array: NDArray[Any]) -> NDArray[Any]:
    array.setflags(write=False)
    return array
