r"""Harmonic and holomorphic 1-forms on the double graph, and their periods.

Let ω_1..ω_2g be the harmonic cochains on Γ in the classes of a canonical basis of cohomology,
α_1..α_g, β_1..β_g, and D their Dirichlet matrix.  Their Hodge stars are harmonic on Γ*, with the
periods D J (row j: those of *ω_j), so that the harmonic forms on Γ* in the same classes are

.. math:: \omega^*_j = - \sum_k (J D^{-1})_{jk} \, {*\omega_k},

with the energies :math:`J D^{-1} J^T`: nothing has to be solved on Γ*.

A discrete holomorphic form is ζ on Γ, any complex harmonic form, and i*ζ on Γ*.  These forms have
complex dimension 2g, twice that of the continuous theory, because Γ and Γ* are independent.  The
*normalised* ones are the g forms with the periods δ_kl along the cycles a_l both on Γ and on Γ*.
Solving for them gives, with D in g × g blocks,

.. math:: \oint_{b_l} \zeta_k = (-D_{ab} D_{bb}^{-1} + i D_{bb}^{-1})_{kl}
          \text{ on } Γ, \qquad
          \oint_{b_l} \zeta_k = (-D_{bb}^{-1} D_{ba}
          + i (D_{aa} - D_{ab} D_{bb}^{-1} D_{ba}))_{kl} \text{ on } Γ^*,

the primal and the dual estimate of the period matrix.  They differ: no form on Λ can be of type
(1,0) and have the same periods on both graphs, unless D is symplectic.

The forms *of the symplectic mean* Π make the other choice: they are harmonic, with the periods
(1, Π) on both graphs, and nearly of type (1,0).  If d_k are the symplectic eigenvalues of D and
Y = Im Π, their conformal energies relative to Y are (√d_k − 1/√d_k)²; and of all period matrices,
the symplectic mean is the one for which the trace of these energies is least.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", sections 2 and 3.
Mercat, "Discrete Riemann surfaces" (2007).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Complexes, Values
from igl_periods.complexes import DeltaComplex, of_a_surface_or
from igl_periods.harmonic import checked_basis, energy_factor, harmonic_basis, side_matrix
from igl_periods.symplectic import siegel_point, standard_form, williamson_of_factor

from .graph import DoubleGraph, double_graph


@of_a_surface_or(DoubleGraph)
def holomorphic_forms(
    K: DeltaComplex | DoubleGraph, cocycles: csr_array | None = None
) -> Complexes:
    r"""The normalised discrete holomorphic 1-forms ζ_1..ζ_g of a Delaunay triangulation.

    They are of type (1,0) on Λ = Γ ⊕ Γ*, with ∮_{a_l} ζ_k = δ_kl along the canonical cycles on Γ
    and on Γ*.  Their b-periods are ``primal`` on Γ and ``dual`` on Γ* of the period matrix.

    Parameters
    ----------
    K : surface or DoubleGraph
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected; Delaunay.
    cocycles : (2g, n_edges) sparse, optional
        A canonical basis of cohomology on the edges of ``K``; the default is
        ``cohomology_basis(K)``.  To stay in the marking of a period matrix ``pm`` while flipping
        to a Delaunay triangulation: ``K, cocycles = intrinsic_delaunay(pm.complex, pm.cocycles)``.

    Returns
    -------
    (g, 2, n_edges) complex
        ``[k, 0, e]`` is the value of ζ_k along the edge e of ``K``; these cochains are closed on
        every triangle.  ``[k, 1, e]`` is its value along the dual edge e*, which crosses e from
        right to left: iρ(e) times the other, hence 0 where Γ* is contracted (ρ = 0).  Columns
        ``graph.edges`` are forms on Λ in the sense of :class:`DoubleGraph`.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected, the triangulation is not Delaunay,
        or ``cocycles`` do not fit it.

    References
    ----------
    Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.

    Examples
    --------
    >>> from igl_periods import DeltaComplex, period_matrix
    >>> torus = DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=2)
    >>> zeta, pm = holomorphic_forms(torus), period_matrix(torus)
    >>> zeta.shape
    (1, 2, 12)
    >>> a, b = periods(torus, zeta)[0, 0]
    >>> bool(abs(a - 1) < 1e-12 and abs(b - pm.primal[0, 0]) < 1e-12)
    True
    """
    graph = K if isinstance(K, DoubleGraph) else double_graph(K)
    omega, D = harmonic_basis(graph.complex, graph.weights, cocycles)
    g = len(D) // 2
    # ζ = ω_a + X ω_b has the periods −i (D_ab + X D_bb) = 1 along the dual a-cycles.
    X = np.linalg.solve(D[g:, g:], (1j * np.eye(g) - D[:g, g:]).T).T
    zeta = omega[:g] + X @ omega[g:]
    return np.stack([zeta, 1j * graph.weights * zeta], axis=1)


@of_a_surface_or(DoubleGraph)
def symplectic_mean_forms(
    K: DeltaComplex | DoubleGraph, cocycles: csr_array | None = None
) -> Complexes:
    r"""The harmonic forms ζ_1..ζ_g on Λ with the periods (1, Π) of the symplectic mean.

    On Γ and on Γ* alike ∮_{a_l} ζ_k = δ_kl and ∮_{b_l} ζ_k = Π_kl, Π being ``matrix`` of the
    period matrix.  They are closed and co-closed, and of type (1,0) up to the error of Π: relative
    to Im Π their conformal energies are (√d − 1/√d)² for the symplectic eigenvalues d.

    Parameters
    ----------
    K, cocycles
        As for :func:`holomorphic_forms`.

    Returns
    -------
    (g, 2, n_edges) complex
        As for :func:`holomorphic_forms`.

    Raises
    ------
    ComplexError
        As for :func:`holomorphic_forms`.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> K = ip.DeltaComplex.from_mesh(V, F)
    >>> ip.symplectic_mean_forms(K).shape == (1, 2, K.n_edges)
    True
    """
    graph = K if isinstance(K, DoubleGraph) else double_graph(K)
    omega, D = harmonic_basis(graph.complex, graph.weights, cocycles)
    g = len(D) // 2
    Pi = siegel_point(williamson_of_factor(energy_factor(D))[1])
    dual = -standard_form(g) @ np.linalg.solve(D, omega * graph.weights)
    return np.stack([form[:g] + Pi @ form[g:] for form in (omega, dual)], axis=1)


def periods(K: DeltaComplex, forms: Values, cocycles: csr_array | None = None) -> Values:
    r"""The periods of closed forms along the canonical cycles, on Γ and on Γ*.

    Poincaré duality, without any path: :math:`\oint_{a_i} \omega = \int \omega \wedge \beta_i` and
    :math:`\oint_{b_i} \omega = -\int \omega \wedge \alpha_i`, exact sums over triangles on Γ,
    over crossed edges on Γ*.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
    forms : (…, 2, n_edges)
        As :func:`holomorphic_forms` returns them; closed.
    cocycles : (2g, n_edges) sparse, optional
        A canonical basis of cohomology; the default is ``cohomology_basis(K)``.

    Returns
    -------
    (…, 2, 2g)
        Row 0 on Γ, row 1 on Γ*; columns a_1..a_g, b_1..b_g.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected, or ``cocycles`` do not fit it.
    """
    basis = checked_basis(K, cocycles)
    side_12, side_01 = side_matrix(K, 0), side_matrix(K, 2)
    by_faces = 0.5 * (side_01.T @ (side_12 @ basis.T) - side_12.T @ (side_01 @ basis.T))
    # The pairings ∫ ω ∧ c, on Γ and on Γ*, as columns.
    on_gamma = by_faces.T @ forms[..., 0, :].reshape(-1, K.n_edges).T
    on_dual = -(basis @ forms[..., 1, :].reshape(-1, K.n_edges).T)
    J = standard_form(basis.shape[0] // 2)
    both = np.stack([(J @ on_gamma).T, (J @ on_dual).T], axis=1)
    return both.reshape(*forms.shape[:-1], basis.shape[0])
