r"""Forms of least energy by linear functions: one factorisation, energies as Gram matrices.

The harmonic form in the class of a closed cochain c is c + df of least energy
:math:`\sum_e \rho(e)\, \omega(e)^2`:

.. math:: L f = -d^T \rho\, c, \qquad L = d^T \rho\, d .

L is positive (``igl.cotmatrix`` has the opposite sign), the same for all classes, and factored once
by CHOLMOD.  The *Dirichlet matrix* :math:`D_{ij} = \int \omega_i \wedge {*\omega_j}`, (2g, 2g), is
all that the period matrix needs.

It is never taken from the quadratic form of L, but summed from the gradients of the forms, face by
face: a Gram matrix of explicit closed forms.  So :math:`D \ge D_{exact}` whatever the solver did
(Dirichlet's principle), and an error of f enters only at second order.

======================  =======================================================================
``laplace_matrix``      the Laplacian, grounded at one vertex, and right-hand sides
``cholmod``             sparse Cholesky factors, and solutions for many right-hand sides
``potentials``          the functions f that make c + df harmonic
``linear_forms``        gradients on blocks of faces, and sums of their products
``grouped_sums``        sums of many terms, with little rounding
``energies``            D, with few functions held at a time
``residual_energies``   D of very many forms, from the residuals of their equations
``harmonic_cochains``   harmonic forms as values on edges
``constant_forms``      forms that are constant on every triangle
``excess``              where on the surface the bound of the period matrix originates
``length_derivatives``  Rauch's formula: how D changes with the lengths
``rounding``            what rounding can change in the energies
======================  =======================================================================

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Chen, Davis, Hager, Rajamanickam, "Algorithm 887: CHOLMOD" (2008).
"""

from .laplace_matrix import laplacian, outflow
from .cholmod import CholeskyFactor, factor, factor_operations, solve
from .potentials import factored, factored_laplacian, harmonic_potentials, solutions
from .grouped_sums import sum_in_groups
from .energies import (
    dirichlet_matrix,
    harmonic_energies,
    harmonic_problem,
    harmonic_problem_of_many,
    HarmonicProblem,
    linear_energies,
    panels_of_columns,
    weighted_energies,
)
from .residual_energies import energies_from_residuals
from .linear_forms import Jumps, LinearForms, blocks, gram_matrix
from .harmonic_cochains import (
    checked_basis,
    harmonic_basis,
    harmonic_form_blocks,
    harmonic_forms,
    side_matrix,
)
from .constant_forms import face_areas, linear_parts, spread_to_vertices
from .length_derivatives import (
    GradientBlocks,
    LinearGradients,
    distortions,
    energy_derivatives,
    length_gradient,
    moments,
    side_vectors,
)
from .excess import energy_excess, most_of
from .rounding import (
    energy_factor,
    TRIANGLE_ERROR,
    ULP,
    absolute_inverse,
    allowance_for_loss,
    amplified,
    extreme_sensitivity,
    geometric_allowance,
)

__all__ = [
    "laplacian",
    "outflow",
    "factored_laplacian",
    "CholeskyFactor",
    "factor",
    "factor_operations",
    "solve",
    "factored",
    "solutions",
    "harmonic_potentials",
    "sum_in_groups",
    "dirichlet_matrix",
    "harmonic_energies",
    "harmonic_problem",
    "harmonic_problem_of_many",
    "energies_from_residuals",
    "HarmonicProblem",
    "linear_energies",
    "panels_of_columns",
    "Jumps",
    "LinearForms",
    "blocks",
    "weighted_energies",
    "checked_basis",
    "harmonic_basis",
    "harmonic_form_blocks",
    "harmonic_forms",
    "side_matrix",
    "face_areas",
    "linear_parts",
    "spread_to_vertices",
    "gram_matrix",
    "GradientBlocks",
    "LinearGradients",
    "distortions",
    "energy_derivatives",
    "length_gradient",
    "moments",
    "side_vectors",
    "energy_excess",
    "energy_factor",
    "most_of",
    "absolute_inverse",
    "allowance_for_loss",
    "amplified",
    "extreme_sensitivity",
    "geometric_allowance",
    "TRIANGLE_ERROR",
    "ULP",
]
