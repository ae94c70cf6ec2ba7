r"""Discrete Riemann surfaces: calculus of forms on the double graph Λ = Γ ⊕ Γ*.

The continuous theory of a Riemann surface needs the exterior derivative d and the Hodge star
:math:`*(f\,dx + g\,dy) = -g\,dx + f\,dy`.  On the double graph (:mod:`igl_periods.forms.graph`)
d is the coboundary of Λ, and the star is duality times the weight,

.. math:: \int_{e^*} {*\alpha} = \rho(e) \int_e \alpha, \qquad
          \int_{e} {*\alpha} = - \frac{1}{\rho(e)} \int_{e^*} \alpha, \qquad {*}{*} = -1 .

From these two, by the same formulas as in the continuous theory: the scalar product
:math:`(\alpha, \beta) = \iint \alpha \wedge *\bar\beta`, the adjoint d* = −*d*, the Laplacian
Δ = d*d + dd*, the splitting of forms by type,

.. math:: \pi_{(1,0)} = \tfrac12 (1 + i*), \qquad \pi_{(0,1)} = \tfrac12 (1 - i*),

a form being of type (1,0) iff *α = −iα, on every quadrilateral (x, y, x', y') the Cauchy–Riemann
equation :math:`\int_{(y,y')} \alpha = i \rho \int_{(x,x')} \alpha`, and *holomorphic* iff it is
closed as well.  On functions and 2-forms the star is the identity of the arrays: a face of Λ and
the vertex that it is dual to have the same index.

Energies and areas are defined for closed forms *df*, whose functions f may have periods.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 2.
Mercat, "Discrete Riemann surfaces and the Ising model" (2001).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Bools, Floats, Values

from .graph import DoubleGraph


def d0(graph: DoubleGraph, f: Values) -> Values:
    """The differential of a function: ``(df)(x, x') = f(x') − f(x)`` on all edges of Λ.

    Parameters
    ----------
    f : (…, n_vertices)

    Returns
    -------
    (…, 2, n_edges)
    """
    return f[..., graph.head] - f[..., graph.tail]


def d1(graph: DoubleGraph, alpha: Values) -> Values:
    """The exterior derivative of a 1-form: its sums around the faces of Λ, counterclockwise.

    Parameters
    ----------
    alpha : (…, 2, n_edges)

    Returns
    -------
    (…, n_vertices)
        The sum around a face of Γ at the index of its vertex of Γ*, and the other way round.
    """
    # Around a face run the edges dual to those that leave its vertex, (e*)* = −e.
    return -_outflow(graph, alpha[..., ::-1, :] * np.array([[-1], [1]]))


def adjoint_d0(graph: DoubleGraph, alpha: Values) -> Values:
    r"""The adjoint d* = −*d* on 1-forms, minus the divergence.

    :math:`(d^*\alpha)(x) = -\sum_{x' \sim x} \rho(x, x') \int_{(x, x')} \alpha`, adjoint to
    :func:`d0`: :math:`(df, \alpha) = \tfrac12 \sum_{\Lambda_0} f\, \overline{d^*\alpha}`.

    Parameters
    ----------
    alpha : (…, 2, n_edges)

    Returns
    -------
    (…, n_vertices)
    """
    return -d1(graph, hodge_star(graph, alpha))


def adjoint_d1(graph: DoubleGraph, omega: Values) -> Values:
    r"""The adjoint d* = −*d* on 2-forms, adjoint to :func:`d1`.

    :math:`(\alpha, d^*\omega) = \tfrac12 \sum_{\Lambda_2} d\alpha\, \bar\omega`.

    Parameters
    ----------
    omega : (…, n_vertices)

    Returns
    -------
    (…, 2, n_edges)
    """
    return -hodge_star(graph, d0(graph, omega))


def laplacian_0(graph: DoubleGraph, f: Values) -> Values:
    r"""The Laplacian d*d of a function, :math:`\sum_{x' \sim x} \rho(x,x') (f(x) - f(x'))`.

    The Laplacian dd* of a 2-form is given by the same formula, on the same arrays.
    """
    return adjoint_d0(graph, d0(graph, f))


def laplacian_1(graph: DoubleGraph, alpha: Values) -> Values:
    """The Laplacian d*d + dd* of a 1-form; its kernel are the harmonic forms."""
    return adjoint_d1(graph, d1(graph, alpha)) + d0(graph, adjoint_d0(graph, alpha))


def hodge_star(graph: DoubleGraph, alpha: Values) -> Values:
    """The Hodge star of a 1-form (section 2, equation 1): ``(*α)(e*) = ρ α(e)``, and ** = −1.

    Parameters
    ----------
    alpha : (…, 2, n_edges)
    """
    return np.stack([-alpha[..., 1, :] / graph.rho, graph.rho * alpha[..., 0, :]], axis=-2)


def wedge(alpha: Values, beta: Values) -> Values:
    r"""The wedge product of 1-forms on Λ, a 2-form on ◊ (section 2, equation 2).

    :math:`\iint_{(x,y,x',y')} \alpha \wedge \beta
    = \tfrac12 \bigl( \int_{(x,x')} \alpha \int_{(y,y')} \beta
    - \int_{(y,y')} \alpha \int_{(x,x')} \beta \bigr)`.

    Parameters
    ----------
    alpha, beta : (…, 2, n_edges)

    Returns
    -------
    (…, n_edges)
    """
    return 0.5 * (alpha[..., 0, :] * beta[..., 1, :] - alpha[..., 1, :] * beta[..., 0, :])


def scalar_product(graph: DoubleGraph, alpha: Values, beta: Values) -> Values:
    r"""The scalar product ∬ α ∧ *β̄ of 1-forms (section 2, equation 3).

    :math:`(\alpha, \beta) = \tfrac12 \sum_{e \in \Lambda_1} \rho(e) \int_e \alpha
    \int_e \bar\beta`, with ρ(e*) = 1/ρ(e): the mean of the products on Γ and on Γ*.

    Parameters
    ----------
    alpha, beta : (…, 2, n_edges)

    Returns
    -------
    (…)
    """
    return wedge(alpha, hodge_star(graph, np.conj(beta))).sum(axis=-1)


def type_10(graph: DoubleGraph, alpha: Values) -> Values:
    """The part ½(1 + i*) α of type (1,0), on which * is −i."""
    return 0.5 * (alpha + 1j * hodge_star(graph, alpha))


def type_01(graph: DoubleGraph, alpha: Values) -> Values:
    """The part ½(1 − i*) α of type (0,1), on which * is +i."""
    return 0.5 * (alpha - 1j * hodge_star(graph, alpha))


def dirichlet_energy(graph: DoubleGraph, df: Values) -> Floats:
    """The Dirichlet energy ‖df‖² (section 2, equation 4): the mean of those on Γ and Γ*.

    Parameters
    ----------
    df : (…, 2, n_edges)

    Returns
    -------
    (…) float
    """
    return np.asarray(scalar_product(graph, df, df).real)


def conformal_energy(graph: DoubleGraph, df: Values) -> Floats:
    """The conformal energy ½‖df − i*df‖² (section 2, equation 6): 0 iff df is of type (1,0).

    It is the Dirichlet energy minus twice the area (equation 7).

    Parameters
    ----------
    df : (…, 2, n_edges)

    Returns
    -------
    (…) float
    """
    return 2.0 * dirichlet_energy(graph, type_01(graph, df))


def area(df: Values) -> Floats:
    """The area (i/2) ∬ df ∧ df̄ of the image of f in the plane (section 2, equation 8).

    A quadrilateral contributes the algebraic area of f(x), f(y), f(x'), f(y'), in this order.

    Parameters
    ----------
    df : (…, 2, n_edges)

    Returns
    -------
    (…) float
    """
    return np.asarray((0.5j * wedge(df, np.conj(df)).sum(axis=-1)).real)


def derivatives(graph: DoubleGraph, df: Values, dz: Values) -> tuple[Values, Values]:
    """The derivatives ∂f and ∂̄f with df = ∂f dz + ∂̄f dz̄ on each pair of dual edges.

    In terms of them df ∧ df̄ = (|∂f|² − |∂̄f|²) dz ∧ dz̄.

    Parameters
    ----------
    df : (…, 2, n_edges)
    dz : (2, n_edges) complex
        Of type (1,0) and nowhere 0, for instance the differential of a holomorphic function z.

    Returns
    -------
    (…, n_edges), (…, n_edges)
    """
    z = dz[..., 0, :]
    return type_10(graph, df)[..., 0, :] / z, type_01(graph, df)[..., 0, :] / np.conj(z)


def is_holomorphic(graph: DoubleGraph, f: Values, tolerance: float = 1e-9) -> Bools:
    r"""On which quadrilaterals a function is discrete holomorphic (section 2, equation 5).

    That is, where :math:`f(y') - f(y) = i \rho\, (f(x') - f(x))`.  On a closed surface this holds
    everywhere only for functions that are constant on Γ and on Γ*; a function on a part of the
    surface has arbitrary values on the rest, and is judged by the quadrilaterals of that part.

    Parameters
    ----------
    f : (…, n_vertices)
    tolerance : float
        How large the part ∂̄f may be, relative to ∂f on the same quadrilateral.

    Returns
    -------
    (…, n_edges) bool
    """
    df = d0(graph, f)
    holomorphic = np.abs(type_10(graph, df)[..., 0, :])
    return np.asarray(np.abs(type_01(graph, df)[..., 0, :]) <= tolerance * holomorphic)


def is_holomorphic_form(graph: DoubleGraph, alpha: Values, tolerance: float = 1e-9) -> Bools:
    """Whether a 1-form is holomorphic: closed and of type (1,0).

    Parameters
    ----------
    alpha : (…, 2, n_edges)
    tolerance : float
        How far it may be from either, relative to its norm and to its largest values.

    Returns
    -------
    (…) bool
    """
    defect = conformal_energy(graph, alpha) <= tolerance**2 * dirichlet_energy(graph, alpha)
    sums = np.abs(d1(graph, alpha)).max(axis=-1)
    return np.asarray(defect & (sums <= tolerance * np.abs(alpha).max(axis=(-2, -1))))


def _outflow(graph: DoubleGraph, alpha: Values) -> Values:
    """At each vertex of Λ the sum of α over the edges that leave it, all directed outwards."""
    edge = np.arange(2 * graph.n_edges)
    shape = (edge.size, graph.n_vertices)
    ones = np.ones(edge.size)
    leaving = csr_array((ones, (edge, graph.tail.ravel())), shape=shape) - csr_array(
        (ones, (edge, graph.head.ravel())), shape=shape
    )
    flat = alpha.reshape(-1, edge.size) @ leaving
    return np.asarray(flat.reshape(*alpha.shape[:-2], graph.n_vertices))
