r"""Energies of very many forms from the residuals of their equations.

For any functions U, as columns, the energies of the forms c + dU are, with C = c ρ cᵀ, the sources
B = −dᵀ ρ cᵀ of the equation and its residual R = L U − B,

.. math:: D = C - B^T U + U^T R .

The last term is all that is dense by dense: so it is not computed but bounded, column by column,
:math:`|(U^T R)_{ij}| \le \|U_i\| \|R_j\|`.  It is of the size of rounding, since U solves the
equation.  What is left costs two sparse products, where the Gram matrix of the gradients costs
O(g² m); and since no form is needed together with any other, only a few are held at a time.

It is a difference: C is much larger than D.  So rounding counts for more than in a sum of squares,
and is bounded term by term (u is the unit roundoff):

* L U, at vertex v with n_v edges, to :math:`2 (n_v + 2) u\, (|L| |U|)_v`, where |L| has |ρ| on its
  edges.  By the inequality of Cauchy and Schwarz, with :math:`a = |L| 1`,
  :math:`\| \gamma |L| |U_j| \|^2 \le \sum_v b_v U_{vj}^2`, :math:`b = |L| (\gamma^2 a)`;
* Bᵀ U to as many u as terms, of :math:`\|B_i\| \|U_j\|`; C likewise;
* cotangents to an absolute error of 10 u l_j l_k / 2A, which changes the energy on a face by at
  most 5 u s, with s as in :mod:`~igl_periods.harmonic.rounding`.

All are of the form :math:`|E_{ij}| \le p_i q_j`, hence below :math:`\sqrt{p^T |D^{-1}| p \;\,
q^T |D^{-1}| q}` relative to D.  On surfaces of high genus this is 1e-8, beside a discretisation
of 1e-2.

References
----------
Higham, "Accuracy and stability of numerical algorithms" (2002), chapter 3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, cotan_weights, edge_ends

from .cholmod import CholeskyFactor, solved_panels
from .laplace_matrix import laplacian
from .linear_forms import Jumps, LinearForms, WeightedFaces, gram_matrix
from .rounding import ULP, absolute_inverse, allowance_for_loss, amplified, energy_factor


@dataclass(frozen=True, eq=False)
class ResidualProblem:
    """What energies from residuals need of a surface and closed cochains on it.

    Attributes
    ----------
    laplacian : (n_vertices, n_vertices) sparse
        L.
    sources : (n_vertices, k) sparse
        B.
    cochain_energies : (k, k) sparse
        C.
    residual_weights : (n_vertices,) float
        b: the rounding of L U is at most the root of Σ b U².
    source_rounding : (k,) float
        A bound of what rounding changed in each column of B.
    product_rounding : (k,) float
        A bound p with |rounding of (Bᵀ U)_ij| ≤ p_i ‖U_j‖.
    cochain_rounding : (k,) float
        t with |rounding of C_ij| ≤ t_i t_j.
    extreme : WeightedFaces
        The faces of extreme sensitivity, with it as weight, and vertices numbered on their own.
    extreme_vertices : (n,) int
        The vertices of these faces.
    extreme_jumps : Jumps
        The cochains there.
    """

    laplacian: csr_array
    sources: csc_array
    cochain_energies: csr_array
    residual_weights: Floats
    source_rounding: Floats
    product_rounding: Floats
    cochain_rounding: Floats
    extreme: WeightedFaces
    extreme_vertices: Ints
    extreme_jumps: Jumps

    @property
    def bytes_kept(self) -> float:
        """What the functions on the extreme faces take."""
        return 8.0 * len(self.extreme_vertices) * self.sources.shape[1]


def residual_problem(
    K: DeltaComplex,
    cochains: csr_array,
    sources: csc_array,
    extreme: WeightedFaces,
    extreme_jumps: Jumps,
) -> ResidualProblem:
    """The problem of closed (k, n_edges) cochains; the rest is as in the harmonic problem of K."""
    rho, (tail, head) = cotan_weights(K), edge_ends(K)
    size, n = np.abs(rho), K.n_vertices
    at_vertex = csr_array(
        (np.ones(2 * K.n_edges), (np.concatenate([tail, head]), np.tile(np.arange(K.n_edges), 2))),
        shape=(n, K.n_edges),
    )
    gamma = 2.0 * ULP * (at_vertex.sum(axis=1) + 2.0)
    # |L| is at_vertex · |ρ| · at_vertexᵀ.
    a = at_vertex @ (size * (at_vertex.T @ np.ones(n)))
    b = at_vertex @ (size * (at_vertex.T @ (gamma**2 * a)))
    moved = at_vertex @ (np.abs(cochains) * size).T
    terms = np.diff(cochains.indptr)
    flow = np.sqrt(_squares(moved))
    weighted = cochains * size
    vertices, corners = np.unique(extreme.corner_vertex, return_inverse=True)
    return ResidualProblem(
        laplacian=csr_array(laplacian(K, rho)),
        sources=sources,
        cochain_energies=csr_array((cochains * rho) @ cochains.T),
        residual_weights=b,
        source_rounding=np.sqrt(_squares(csr_array(moved * gamma[:, None]))),
        product_rounding=(ULP * (np.diff(sources.indptr) + 2.0) + gamma.max()) * flow,
        cochain_rounding=np.sqrt(ULP * (terms + 2.0) * weighted.multiply(cochains).sum(axis=1)),
        extreme=WeightedFaces(extreme.lengths, corners.reshape(-1, 3), extreme.scale),
        extreme_vertices=vertices,
        extreme_jumps=extreme_jumps,
    )


def energies_from_residuals(
    problem: ResidualProblem, factor: CholeskyFactor
) -> tuple[Floats, float]:
    """The Dirichlet matrix of the harmonic forms, and how far all that is not exact may change it.

    Returns
    -------
    D : (k, k) float
    allowance : float
        Relative to D: the energies of the forms c + dU are between (1 ∓ allowance) D.
    """
    n, k = problem.sources.shape
    D, on_extreme = problem.cochain_energies.toarray(), np.empty((len(problem.extreme_vertices), k))
    size, residual = np.empty(k), np.empty(k)
    transposed = csr_array(problem.sources.T)
    for columns, source, solution in solved_panels(factor, problem.sources, first=1):
        U = np.zeros((n, solution.shape[1]))
        U[1:] = solution
        U -= U.mean(axis=0)
        D[:, columns] -= transposed @ U
        residual[columns] = np.linalg.norm(problem.laplacian @ U - source, axis=0)
        residual[columns] += np.sqrt(problem.residual_weights @ (U * U))
        size[columns] = np.linalg.norm(U, axis=0)
        on_extreme[:, columns] = U[problem.extreme_vertices]
    D = 0.5 * (D + D.T)
    inverse = absolute_inverse(energy_factor(D))
    amplification = [
        amplified(inverse, t)
        for t in (
            size,
            residual + problem.source_rounding,
            problem.product_rounding,
            problem.cochain_rounding,
        )
    ]
    of_size, of_residual, of_product, of_cochains = amplification
    inexact = np.sqrt(of_size * of_residual) + np.sqrt(of_size * of_product) + of_cochains
    loss = gram_matrix(LinearForms(problem.extreme, problem.extreme_jumps, on_extreme))
    return D, float(1.01 * inexact) + 2.0 * allowance_for_loss(D, loss)


def _squares(A: csr_array) -> Floats:
    """Sums of squares of the columns; (k,)."""
    return np.asarray(A.multiply(A).sum(axis=0)).ravel()
