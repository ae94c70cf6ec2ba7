r"""Energies of the harmonic forms of a surface, however many they are.

On a surface of genus g the 2g harmonic forms c + df are 2g functions f at the vertices, and their
Dirichlet matrix needs every form together with every other.  For large g the functions are what
takes the memory: so they are solved for in *panels* of as many columns as fit.  While one panel is
held, the others pass by,

.. math:: D_{IJ} = \langle \omega_I, \omega_J \rangle, \qquad I \le J,

and with p panels each function is solved for (p + 1)/2 times on average.  Solving is a small part
of the O(g² m) operations of the products on m faces, so few panels cost little.

What is needed of the surface is small: the Laplacian, the sources of the equation, and the sides
and corners of its faces.  The complex itself is not kept while the factor takes its place.

All entries of D are products of gradients of explicit forms
(:mod:`~igl_periods.harmonic.linear_forms`), so that an inexact solution makes it larger, never
smaller:  Dirichlet's principle holds for it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csc_array, csr_array, csr_matrix

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, cotan_weights, edge_ends

from .cholmod import CholeskyFactor
from .laplace_matrix import lower_laplacian, outflow
from .linear_forms import Jumps, LinearForms, WeightedFaces, blocks, gram_matrix, mutual_energies
from .potentials import factored, solutions
from .residual_energies import ResidualProblem, residual_problem
from .rounding import allowance_for_loss, extreme_sensitivity

# Columns of a panel at least, whatever the memory.
_NARROWEST = 32
# From so many forms on, products of all with all cost more than the residuals of their equations.
_MANY_FORMS = 64


@dataclass(frozen=True, eq=False)
class HarmonicProblem:
    """The sources of closed cochains, and the faces on which energies of forms are taken.

    Attributes
    ----------
    sources : (n_vertices, k) sparse float
        −dᵀ ρ c.
    faces, extreme : WeightedFaces
        All faces; those of extreme sensitivity to rounding, with it as weight.
    jumps, extreme_jumps : Jumps
        The cochains on both.
    residuals : ResidualProblem, optional
        Where there are so many forms that their energies are better had from residuals
        (:func:`harmonic_problem_of_many`).
    """

    sources: csc_array
    faces: WeightedFaces
    extreme: WeightedFaces
    jumps: Jumps
    extreme_jumps: Jumps
    residuals: ResidualProblem | None = None

    def forms(self, columns: slice, factor: CholeskyFactor) -> tuple[LinearForms, LinearForms]:
        """Some of the harmonic forms c + df, on all faces and on the extreme ones."""
        potentials = solutions(factor, self.sources[:, columns])
        return (
            LinearForms(self.faces, self.jumps.of_cochains(columns), potentials),
            LinearForms(self.extreme, self.extreme_jumps.of_cochains(columns), potentials),
        )


def harmonic_problem(K: DeltaComplex, cochains: csr_array) -> tuple[csr_matrix, HarmonicProblem]:
    """The grounded Laplacian of a surface, and the problem of closed (k, n_edges) cochains on it.

    Together they are all that is needed of the surface, and neither refers to it.  On a sphere
    there are no cochains, hence nothing to solve: the Laplacian is empty.
    """
    rho, (tail, head) = cotan_weights(K), edge_ends(K)
    sensitivity = extreme_sensitivity(K)
    problem = HarmonicProblem(
        sources=outflow(K.n_vertices, tail, head, rho, cochains),
        faces=WeightedFaces.of(K),
        extreme=WeightedFaces.of(K, sensitivity),
        jumps=Jumps.of(K, cochains),
        extreme_jumps=Jumps.of(K, cochains, sensitivity),
    )
    if cochains.shape[0] == 0:
        return csr_matrix((0, 0)), problem
    return lower_laplacian(K.n_vertices, tail, head, rho, 1), problem


def harmonic_problem_of_many(
    K: DeltaComplex, cochains: csr_array
) -> tuple[csr_matrix, HarmonicProblem]:
    """The same as :func:`harmonic_problem`, with residuals if there are many forms."""
    laplacian, problem = harmonic_problem(K, cochains)
    if cochains.shape[0] < _MANY_FORMS:
        return laplacian, problem
    residuals = residual_problem(
        K, cochains, problem.sources, problem.extreme, problem.extreme_jumps
    )
    return laplacian, replace(problem, residuals=residuals)


def linear_energies(
    K: DeltaComplex, cochains: csr_array, memory: float | None = None
) -> tuple[Floats, float]:
    """All of it at once: :func:`harmonic_energies` of closed cochains on K."""
    laplacian, problem = harmonic_problem(K, cochains)
    return harmonic_energies(problem, factored(laplacian), memory)


def harmonic_energies(
    problem: HarmonicProblem, factor: CholeskyFactor, memory: float | None = None
) -> tuple[Floats, float]:
    """The Dirichlet matrix of the harmonic forms, and how far rounding may have changed it.

    Parameters
    ----------
    problem : HarmonicProblem
    factor : CholeskyFactor
        Of the grounded Laplacian.
    memory : float, optional
        Bytes that the functions may take (two panels of them); at least 64 columns are held.

    Returns
    -------
    D : (k, k) float
        Energies of explicit forms in the classes of the cochains: an upper bound of the exact
        energies, up to the second number.
    allowance : float
        Relative to D.
    """
    n, k = problem.sources.shape
    panels = panels_of_columns(n, k, memory)
    D, loss = np.zeros((k, k)), np.zeros((k, k))
    for i, rows in enumerate(panels):
        held = problem.forms(rows, factor)
        for matrix, forms in zip((D, loss), held):
            matrix[rows, rows] = gram_matrix(forms)
        for columns in panels[i + 1 :]:
            passing = problem.forms(columns, factor)
            for matrix, forms, others in zip((D, loss), held, passing):
                matrix[rows, columns] = mutual_energies(forms, others)
                matrix[columns, rows] = matrix[rows, columns].T
    return D, allowance_for_loss(D, loss)


def panels_of_columns(n: int, k: int, memory: float | None) -> list[slice]:
    """Columns in portions, one if all fit, else so that two portions do."""
    width = k
    if memory is not None and 8.0 * n * k > memory:
        width = max(int(memory / (16.0 * n)), _NARROWEST)
    return [slice(start, min(start + width, k)) for start in range(0, k, width)] if k else []


def dirichlet_matrix(
    K: DeltaComplex, cochains: csr_array, potentials: Floats, face_weights: Floats | None = None
) -> Floats:
    """Energies of the piecewise constant forms c + df on the polyhedral surface; (k, k).

    A sum of squares of gradients over all faces (or those of positive ``face_weights``, each
    counted with its weight), never a difference.

    Parameters
    ----------
    cochains : (k, n_edges) sparse
        Closed.
    potentials : (n_vertices, k) float
        Any functions; the harmonic ones give the least energies.
    face_weights : (m,) float, optional
    """
    faces = WeightedFaces.of(K, face_weights)
    return gram_matrix(LinearForms(faces, Jumps.of(K, cochains, face_weights), potentials))


def weighted_energies(
    K: DeltaComplex, weights: Floats, cochains: csr_array, potentials: Floats
) -> Floats:
    """The matrix Σ_e ρ(e) ω_i(e) ω_j(e) of the cochains ω = c + df; (k, k).

    For weights that are not the energy of a surface (extrinsic or abstract ones); no bound rests
    on it.
    """
    k = cochains.shape[0]
    D = np.zeros((k, k))
    tail, head = edge_ends(K)
    by_edge = cochains.T.tocsr()
    for block in blocks(K.n_edges, k):
        forms = by_edge[block].toarray() + (potentials[head[block]] - potentials[tail[block]])
        D += forms.T @ (weights[block, None] * forms)
    return 0.5 * (D + D.T)
