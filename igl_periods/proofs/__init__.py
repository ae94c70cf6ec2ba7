r"""Energies of computed forms in midpoint–radius arithmetic, and bounds that they prove.

The certificate J D⁻¹ Jᵀ ≤ D_exact ≤ D is a theorem about the energies D of *explicit* closed forms,
whoever computed them.  So nothing of the solution has to be proved; only the evaluation of D and
the last step to the bound.  Both are done here at nearly the speed of floating point, on arrays of
midpoints and radii: a number is known to lie in [m − r, m + r], and every operation enlarges the
radius by what rounding can do to the midpoint.

For any symmetric X and Y > 0 let G be the energies of Π = X + iY and P a symplectic matrix with
:math:`P G P^T = 1`.  Then

.. math:: P D P^T \le 1 + \eta \quad\Rightarrow\quad
          \| Y^{-1/2} (\Pi_{exact} - \Pi) Y^{-1/2} \|_2 \le \eta,

whatever rounding did to Π.  The theorem is about the surface whose sides have the stored lengths,
exactly; the lengths of flipped edges are balls.

=========================  ====================================================================
``midpoint_radius``        arrays of balls, and what their arithmetic assumes of the machine
``shapes``                 areas, cotangents and feet of heights in balls
``length_balls``           lengths that follow flips, midpoints and barycentres
``linear_energies``        energies of forms that are linear on triangles
``polynomial_energies``    energies of forms of any degree, conical elements included
``siegel_radius``          how far a given Π can be off
``proved_energies``        forms near orthonormal, so that bounds are sharp in every marking
``surface_proofs``         all of it for a surface, step by step
=========================  ====================================================================

References
----------
Rump, "Verification methods: rigorous results using floating-point arithmetic" (2010).
Higham, "Accuracy and stability of numerical algorithms" (2002), chapter 3.
"""

from .midpoint_radius import UNIT, Balls, check_arithmetic, norms, total
from .siegel_radius import relative_radius
from .proved_energies import ProvedEnergies
from .surface_proofs import (
    EnclosedProblem,
    EnclosedTriangulation,
    high_order_proof,
    linear_problem,
    linear_proof,
)

__all__ = [
    "UNIT",
    "Balls",
    "check_arithmetic",
    "norms",
    "total",
    "relative_radius",
    "ProvedEnergies",
    "EnclosedProblem",
    "EnclosedTriangulation",
    "high_order_proof",
    "linear_problem",
    "linear_proof",
]
