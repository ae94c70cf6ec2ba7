r"""From a period matrix to the equation of its algebraic curve.

Every compact Riemann surface is an algebraic curve.  Of genus 1 it is y² = x³ + A x + B with the
right j; branch points of hyperelliptic curves are quotients of theta constants, after Rosenhain and
Thomae; the bitangents of a plane quartic are gradients of odd theta functions.  From a period
matrix in balls come branch points, bitangents and invariants in balls.  What their coefficients are
as algebraic numbers is *recognised*, in coordinates that make them simple, and not proved.

==========================  =================================================================
``binary_forms``            sextics and octics; transvectants; Igusa–Clebsch, Shioda
``ternary_forms``           plane quartics; Dixmier–Ohno invariants
``weighted_points``         invariants up to scale
``branch_points``           theta constants → branch points
``plane_quartics``          odd theta functions → bitangents → the quartic
``ball_roots``              roots of balls that meet the negative axis
``branch_symmetries``       Möbius transformations that permute branch points
``integer_forms``           small integer coefficients
``elliptic_models``         Weierstrass equations
``hyperelliptic_models``    y² = f(x) with simple coefficients
``rational_conics``         rational points of conics
``mestre_models``           sextics over Q from invariants
``quartic_models``          quartics with few and simple coefficients
``stored_balls``            balls in pickles
``algebraic_curve``         the result
``reconstruction``          the steps, one after the other
``system_texts``            LaTeX, Sage, Magma, PARI
==========================  =================================================================
"""

from .algebraic_curve import AlgebraicCurve
from .reconstruction import curve, curve_of_form
from .system_texts import to_latex, to_magma, to_pari, to_sage

__all__ = [
    "AlgebraicCurve",
    "curve",
    "curve_of_form",
    "to_latex",
    "to_sage",
    "to_magma",
    "to_pari",
]
