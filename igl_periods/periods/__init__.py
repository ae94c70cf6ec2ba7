r"""From a surface to its period matrix, and how far it can be off.

    V, F ─ complexes ▶ K ─ topology ▶ cochains ─ Delaunay flips ▶ K′, cochains′
         ─ harmonic, or elements ▶ D ─ periods ▶ Π, bound

Holomorphic forms are normalised by :math:`\oint_{a_l} \zeta_k = \delta_{kl}`; the period matrix is
:math:`\Pi_{kl} = \oint_{b_l} \zeta_k`, symmetric with Im Π > 0.  It is the symplectic mean of the
Dirichlet matrix D.  Since D ≥ D_exact and D_exact is symplectic,

.. math:: J D^{-1} J^T \le D_{exact} \le D, \qquad
          \| Y^{-1/2} (\Pi_{exact} - \Pi) Y^{-1/2} \|_2 \le d - 1,

d the largest symplectic eigenvalue of D: the *bound*.  It is about the polyhedral surface whose
triangles have the stored lengths.

====================  =========================================================================
``arguments``         options and weights as callers hand them over
``memory_estimates``  what a computation will take, before it is begun
``rounding``          what rounding can change between D and Π
``solved_forms``      the forms, kept for derivatives
``derivative``        ∂Π by lengths and vertices, forward and backward
``differentiable``    … as methods
``matrix``            the period matrix, its estimates and its bound
``certificate``       D and its allowance → the certified matrix
``keeping``           the same with forms that are kept for derivatives
``proof``             the same with energies in balls: the bound is proved
``adaptive_degree``   the degree that meets a tolerance
``computation``       the steps, one after the other
``marking``           which faces are divided
``adaptive_mesh``     finer triangulations where the bound originates
``quality``           what limits the accuracy of a mesh
``extrapolation``     smooth surfaces from several meshes, uncertified
``real_surfaces``     the real structure of a double
``recognition``       how a surface is recognised by its matrix
====================  =========================================================================

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
"""

from .arguments import checked_limits, checked_options
from .solved_forms import SolvedForms, solve_forms
from .derivative import EntryCovariance, Gradient
from .matrix import PeriodMatrix, check_period_matrix, reduced_if_feasible, siegel_reduced
from .certificate import certified_period_matrix
from .adaptive_degree import ToleranceWarning
from .computation import period_matrix, period_matrix_from_weights
from .adaptive_mesh import Refined, refined_period_matrix
from .quality import MeshQuality, WIDE, mesh_quality
from .extrapolation import Extrapolation, richardson, sampled_torus
from .real_surfaces import real_structure
from .recognition import matrix_of_complex
from .rounding import LEAST_ALLOWANCE, combined, congruence

__all__ = [
    "LEAST_ALLOWANCE",
    "combined",
    "congruence",
    "checked_limits",
    "checked_options",
    "SolvedForms",
    "solve_forms",
    "Gradient",
    "EntryCovariance",
    "PeriodMatrix",
    "check_period_matrix",
    "siegel_reduced",
    "reduced_if_feasible",
    "certified_period_matrix",
    "ToleranceWarning",
    "period_matrix",
    "period_matrix_from_weights",
    "Refined",
    "refined_period_matrix",
    "mesh_quality",
    "MeshQuality",
    "WIDE",
    "Extrapolation",
    "richardson",
    "real_structure",
    "matrix_of_complex",
    "sampled_torus",
]
