r"""The Siegel upper half-space: distance, the action of Sp(2g, Z), reduction.

:math:`H_g = \{\Pi = X + iY : \Pi = \Pi^T,\ Y > 0\}`.  γ = [[a, b], [c, d]] in Sp(2g, Z) acts by
:math:`\gamma \cdot \Pi = (a\Pi + b)(c\Pi + d)^{-1}`, as a change of the marking.  The invariant
distance of two points is

.. math:: d(\Pi_1, \Pi_2)^2 = \sum_{i \le g} \log^2 \lambda_i,

:math:`\lambda_i \ge 1` the eigenvalues of :math:`G_1^{-1} G_2`, G as in
:mod:`igl_periods.symplectic`.  *Siegel reduction* alternates a lattice reduction of Y (LLL, with a
shortest vector first where the genus is small), a shift of X, and an inversion in one handle, until
|Re Π| ≤ ½, Y is LLL-reduced and |Π_11| ≥ 1.  From genus 2 on that is **no canonical form**: two
reduced matrices of one surface may differ, and are never compared entry by entry.

====================  =========================================================================
``half_space``        what is a Siegel point; distance
``action``            γ·Π, accurately
``enclosed_points``   points that are known in balls
``geodesics``         the shortest way between two points
``balls``             Π in ball arithmetic
``ball_action``       γ·Π and energies in balls
``lll``               lattice reduction in integers; large lattices in floating point
``lll_in_floats``     the latter
``reducing_pairs``    pairwise reduction of a whole canonical basis
``enumeration``       all short vectors of a lattice
``reduction_steps``   the three steps
``reduction``         their iteration
====================  =========================================================================

References
----------
Siegel, "Symplectic geometry" (1943).
Deconinck, Heil, Bobenko, van Hoeij, Schmies, "Computing Riemann theta functions" (2004).
"""

from .ball_action import cholesky, energy_balls, moved_balls
from .enclosed_points import (
    PRECISION,
    EnclosedPoint,
    PointInBalls,
    balls_of,
    bits_of,
    in_marking,
    midpoint,
)
from .half_space import (
    check_same_genus,
    check_siegel_point,
    check_symplectic,
    log_eigenvalues,
    siegel_distance,
    siegel_transform,
)
from .geodesics import moduli_path, orthonormal_weights, siegel_exponential, siegel_logarithm
from .balls import ARRAY_ERROR, ball_matrix, to_flint
from .lll import lll_basis
from .enumeration import short_vectors
from .reduction import SIEGEL_GENUS_LIMIT, EnclosedReduction, SiegelReduction, siegel_reduce

__all__ = [
    "EnclosedPoint",
    "PointInBalls",
    "balls_of",
    "bits_of",
    "in_marking",
    "midpoint",
    "cholesky",
    "energy_balls",
    "moved_balls",
    "EnclosedReduction",
    "check_same_genus",
    "check_siegel_point",
    "check_symplectic",
    "log_eigenvalues",
    "siegel_distance",
    "siegel_transform",
    "moduli_path",
    "orthonormal_weights",
    "siegel_exponential",
    "siegel_logarithm",
    "ARRAY_ERROR",
    "ball_matrix",
    "PRECISION",
    "to_flint",
    "lll_basis",
    "short_vectors",
    "SIEGEL_GENUS_LIMIT",
    "siegel_reduce",
    "SiegelReduction",
]
