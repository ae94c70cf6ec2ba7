r"""Forms of least energy by functions of high degree, conical at cone points.

The same cochains and the same D as in :mod:`igl_periods.harmonic`, with better trial functions: on
flat faces polynomials of degree p.  At a vertex of total angle θ ≠ 2π harmonic functions behave
like :math:`r^{2\pi/\theta}`, which no polynomial does; a face with such an apex has functions of
degree p in :math:`\tau = t^\kappa`, κ = 2π/θ, and in the position s on the opposite side,

.. math:: \int |\nabla u|^2 = \frac{1}{|R \times R'|} \int_0^1\!\!\int_0^1 \Big[
          \kappa |R'|^2 \tau u_\tau^2 - 2 (R \cdot R')\, u_\tau u_s
          + \frac{|R|^2 u_s^2}{\kappa \tau} \Big]\, d\tau\, ds,

the point being t R(s).  Traces of the two kinds agree, so that the forms are conforming, D is an
upper bound of the exact one, and the bound of the period matrix falls exponentially with p.

=======================  ======================================================================
``reference_elements``   the kinds of elements, on the square or triangle of reference
``placement``            which face gets which element; faces with two cone points are divided
``condensation``         stiffness of many faces at once, bubbles eliminated
``trace_system``         the sparse system for the traces on edges
``trial_forms``          the forms, and their coefficients on each face
``descent``              to the least energy where rounding keeps the solver away from it
``least_energy``         the forms of least energy, and their energies from gradients
``point_values``         values, gradients and integrals of the forms anywhere
``gradient_blocks``      gradients in the charts of faces, for derivatives
=======================  ======================================================================

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Babuška, Suri, "The p and h-p versions of the finite element method" (1994).
"""

from .reference_elements import ReferenceElement
from .placement import Elements, choose_elements, separate_cones
from .condensation import condense
from .trace_system import count_unknowns, jumps, unknowns
from .trial_forms import HighOrderForms
from .least_energy import (
    dirichlet_matrix,
    energy_excess,
    high_order_forms,
    rounding_allowance,
)
from .gradient_blocks import HighOrderGradients
from .point_values import edge_integrals, gradients, potentials

__all__ = [
    "ReferenceElement",
    "Elements",
    "choose_elements",
    "separate_cones",
    "condense",
    "count_unknowns",
    "jumps",
    "unknowns",
    "dirichlet_matrix",
    "energy_excess",
    "high_order_forms",
    "HighOrderForms",
    "HighOrderGradients",
    "rounding_allowance",
    "potentials",
    "gradients",
    "edge_integrals",
]
