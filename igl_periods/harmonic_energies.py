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

All entries of D are products of gradients of explicit forms (:mod:`igl_periods.linear_forms`), so
that an inexact solution makes it larger, never smaller: Dirichlet's principle holds for it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csc_matrix, csr_array
from sksparse.cholmod import Factor

from .delta_complex import DeltaComplex, cotan_weights
from .harmonic import edge_ends, factorised, lower_laplacian, outflow, solutions
from .linear_forms import Jumps, LinearForms, WeightedFaces, gram_matrix, mutual_energies
from .rounding import allowance_for_loss, extreme_sensitivity

Floats = NDArray[np.float64]

# Columns of a panel at least, whatever the memory.
_NARROWEST = 32


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
    """

    sources: csc_array
    faces: WeightedFaces
    extreme: WeightedFaces
    jumps: Jumps
    extreme_jumps: Jumps

    def forms(self, columns: slice, factor: Factor | None) -> tuple[LinearForms, LinearForms]:
        """Some of the harmonic forms c + df, on all faces and on the extreme ones."""
        potentials = solutions(factor, self.sources[:, columns])
        return (
            LinearForms(self.faces, self.jumps.of_cochains(columns), potentials),
            LinearForms(self.extreme, self.extreme_jumps.of_cochains(columns), potentials),
        )


def harmonic_problem(K: DeltaComplex, cochains: csr_array) -> tuple[csc_matrix, HarmonicProblem]:
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
        return csc_matrix((0, 0)), problem
    return lower_laplacian(K.n_vertices, tail, head, rho, 1), problem


def linear_energies(
    K: DeltaComplex, cochains: csr_array, memory: float | None = None
) -> tuple[Floats, float]:
    """All of it at once: :func:`harmonic_energies` of closed cochains on K."""
    laplacian, problem = harmonic_problem(K, cochains)
    return harmonic_energies(problem, factorised(laplacian), memory)


def harmonic_energies(
    problem: HarmonicProblem, factor: Factor | None, memory: float | None = None
) -> tuple[Floats, float]:
    """The Dirichlet matrix of the harmonic forms, and how far rounding may have changed it.

    Parameters
    ----------
    problem : HarmonicProblem
    factor : Factor or None
        Of the grounded Laplacian; None if the surface has one vertex, with nothing to solve.
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
    panels = _panels(n, k, memory)
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


def _panels(n: int, k: int, memory: float | None) -> list[slice]:
    """Columns in portions, one if all fit, else so that two portions do."""
    width = k
    if memory is not None and 8.0 * n * k > memory:
        width = max(int(memory / (16.0 * n)), _NARROWEST)
    return [slice(start, min(start + width, k)) for start in range(0, k, width)] if k else []
