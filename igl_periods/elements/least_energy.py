r"""Harmonic forms from elements of high degree, with conformal elements at cone points.

For each closed cochain c the Dirichlet energy of c + df is minimised over continuous functions f
that are polynomials of degree p on every flat face, and lie in the conical element
(:mod:`igl_periods.elements.reference_elements`) on every face with a vertex of total angle θ ≠ 2π.
On a face the cochain is the differential of the trial function that has the right differences at
the corners and is linear on the sides.

The trial functions are conforming, so that Dirichlet's principle holds: the Dirichlet matrix D of
the forms found is an upper bound of that of the surface, for the conformal structure of the
surface itself, whatever was done to find the forms.  D is summed from squares of gradients, which
are evaluated at the points of an exact quadrature.  (A quadratic form uᵀKu loses to cancellation
just the small differences that matter, and can fall below the true value.)  The error decreases
exponentially with p.

A conical element has one apex, so no face may have two corners at cone points.  Where one has,
every face is first divided into four; the midpoints of sides are flat.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces" (2011).
Babuška, Suri, "The p and h-p versions of the finite element method" (1994).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex
from igl_periods.harmonic import geometric_allowance, sum_in_groups

from .condensation import scaled_gradients
from .descent import descended
from .placement import Elements, choose_elements, separate_cones
from .trace_system import condensed_system, factored_system, least_traces
from .trial_forms import HighOrderForms, coefficients_on


def high_order_forms(K: DeltaComplex, cochains: csr_array, degree: int) -> HighOrderForms:
    """The closed forms of least energy of some degree in given cohomology classes.

    Parameters
    ----------
    K : DeltaComplex
        Closed and connected.  It is divided once where cone points are neighbours
        (:func:`separate_cones`).
    cochains : (k, n_edges) sparse int
        Closed.
    degree : int
        At least 1.

    Raises
    ------
    ValueError
        If the degree is less than 1.
    ComplexError
        If rounding makes the system of equations singular, on extremely thin triangles.
    """
    if degree < 1:
        raise ValueError(f"degree = {degree}: trial functions have degree 1 at least.")
    K, cochains = separate_cones(K, cochains)
    return least_energy_forms(K, cochains, choose_elements(K, degree))


def least_energy_forms(
    K: DeltaComplex, cochains: csr_array, elements: tuple[Elements, ...]
) -> HighOrderForms:
    """The closed forms of least energy on given elements.

    Parameters
    ----------
    K : DeltaComplex
        Closed and connected.
    cochains : (k, n_edges) sparse int
        Closed.
    elements : tuple of Elements
        Of one degree, one on each face; conical ones of the same exponent on all faces at a vertex.

    Raises
    ------
    ComplexError
        If rounding makes the system of equations singular, on extremely thin triangles.
    """
    system = condensed_system(K, cochains, elements)
    degree = elements[0].reference.degree
    if cochains.shape[0] == 0:
        return HighOrderForms(K, cochains, degree, elements, system.extensions, system.load)
    factor = factored_system(system)
    traces = least_traces(system, factor)
    forms = HighOrderForms(K, cochains, degree, elements, system.extensions, traces)
    return descended(forms, factor)


def dirichlet_matrix(forms: HighOrderForms, face_weights: Floats | None = None) -> Floats:
    """Dirichlet products ∫ ω_i ∧ *ω_j of the forms; (k, k) float.

    A sum of squares of gradients over all faces (or those of positive ``face_weights``, each
    counted with its weight), never a difference.

    Parameters
    ----------
    forms : HighOrderForms
    face_weights : (m,) float, optional
        One weight for each face of ``forms.complex``.
    """
    k = forms.cochains.shape[0]
    if k == 0:
        return np.zeros((0, 0))
    parts = [
        (elements, extension, block)
        for elements, extension in zip(forms.elements, forms.extensions, strict=True)
        for block in elements.blocks(k * elements.reference.quadrature.nodes.size)
    ]
    by_edge = forms.cochains.T.tocsr()

    def terms() -> Iterator[Floats]:
        for elements, extension, block in parts:
            if face_weights is not None:
                block = block[face_weights[elements.face[block]] > 0.0]
            u = coefficients_on(forms, by_edge, elements, extension, block)
            for X in scaled_gradients(elements, block, u):
                if face_weights is not None:
                    X *= np.sqrt(face_weights[elements.face[block]])[:, None]
                X = X.reshape(-1, k)
                yield X.T @ X

    return sum_in_groups(terms(), 2 * len(parts), (k, k))


def energy_excess(forms: HighOrderForms, pairs: Floats) -> Floats:
    r"""The shares of all faces in the numbers d_i − 1 that make the bound; (g, m) float.

    In terms of forms x_i, y_i in which the Dirichlet matrix is diag(d, d) and the pairing is
    standard, :math:`d_i - 1 = \tfrac12 \| x_i + {*y_i} \|^2`, an integral over the surface of
    something that is nowhere negative (:mod:`igl_periods.harmonic.excess`).

    Parameters
    ----------
    forms : HighOrderForms
    pairs : (g, 2, k) float
        Coefficients of x_i and y_i in terms of ``forms``.
    """
    g, _, k = pairs.shape
    shares = np.zeros((g, forms.complex.n_faces))
    combine = pairs.transpose(2, 1, 0).reshape(k, 2 * g)
    by_edge = forms.cochains.T.tocsr()
    for elements, extension in zip(forms.elements, forms.extensions, strict=True):
        for block in elements.blocks(4 * g * elements.reference.quadrature.nodes.size):
            u = coefficients_on(forms, by_edge, elements, extension, block) @ combine
            along, down = scaled_gradients(elements, block, u)
            for one, other in (
                (along[..., :g], -down[..., g:]),
                (down[..., :g], along[..., g:]),
            ):
                shares[:, elements.face[block]] += 0.5 * np.sum((one + other) ** 2, axis=0).T
    return shares


def rounding_allowance(forms: HighOrderForms, D: Floats) -> float:
    r"""What a bound owes to floating-point arithmetic in D, relative to D.

    D of degree 2 … 20 was found within 5e-15 of its value in extended arithmetic, whatever the
    degree, wherever triangles are not thin; and rounded lengths or cotangents change it by

    .. math:: \left| \xi^T \delta D\, \xi \right| \le
              4 \epsilon \sum_f s_f\, \xi^T D_f\, \xi, \qquad \epsilon = 2^{-52},

    where D_f is the part of face f and s_f the sensitivity of its shape
    (:func:`~igl_periods.harmonic.rounding.rounding_sensitivity`).  The allowance is the largest
    value of the right-hand side relative to ξᵀDξ, with s_f counted as at least 100.

    Parameters
    ----------
    forms : HighOrderForms
    D : (k, k) float
        Their Dirichlet matrix.  A later change of basis has an allowance of its own.
    """
    return geometric_allowance(forms.complex, D, lambda weights: dirichlet_matrix(forms, weights))
