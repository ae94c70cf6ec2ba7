r"""Surfaces with the period matrix that one wants.

    target Π*, surface ─ nearest marking ▶ Π* there ─ Gauss–Newton ▶ surface′ with Π(surface′) = Π*

What moves is either the vertices, freely or within a space of smooth displacements, or the lengths
of the edges.  At every step the rest of the way is the velocity of the Siegel geodesic to the
target,

.. math:: r = \log_\Pi \Pi^* \in T_\Pi H_g, \qquad J\, dx = r, \qquad dx = J^+ r,

J being the derivative of Π (:mod:`igl_periods.periods.derivative`), in orthonormal coordinates of
Siegel's metric, and J⁺ the solution of least norm, the one that strains the surface least.  A
surface of genus g has 6g − 6 real moduli (2 in genus 1), in a half-space of g(g + 1) real
dimensions.  So up to genus 3 every target near Π is the matrix of a surface nearby; from genus 4 on
the matrices of surfaces are a thin set, and a target beside it is approached as near as may be.

===================  ==========================================================================
``charts``           what may move: vertices or lengths, and in which norm
``spectral_basis``   smooth functions, for displacements without ripples
``crossings``        where a surface passes through itself
``contacts``         how near its parts are to each other
``repulsion``        an energy that keeps them apart
``relaxation``       its descent, while the period matrix stays
``gauss_newton``     the iteration
``results``          what it achieved
``targets``          ``deform_to``, ``lengths_with``, and the same along a path
===================  ==========================================================================

References
----------
Siegel, "Symplectic geometry" (1943).
Rauch, "Weierstrass points, branch points, and moduli of Riemann surfaces" (1959).
"""

from .results import Deformation, DeformationWarning, Step
from .spectral_basis import smooth_functions
from .targets import deform_along, deform_to, lengths_along, lengths_with

__all__ = [
    "Deformation",
    "DeformationWarning",
    "Step",
    "smooth_functions",
    "deform_along",
    "deform_to",
    "lengths_along",
    "lengths_with",
]
