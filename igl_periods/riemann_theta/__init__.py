r"""Riemann's theta function with characteristics, its derivatives, and spin structures.

For Π in the Siegel upper half-space, z in C^g and a characteristic (a, b), a, b ∈ {0, 1}^g,

.. math:: \theta_{a,b}(z, \Pi) = \sum_{n \in \mathbb{Z}^g} \exp \pi i \big( m^T \Pi\, m
          + 2\, m^T (z + \tfrac b2) \big), \qquad m = n + \tfrac a2 .

The characteristics of a surface are its spin structures: square roots of the canonical bundle, or
quadratic forms q on H₁(Z/2) with q(x + y) = q(x) + q(y) + x·y.  Those with a·b even, of Arf
invariant 0, number 2^{g−1}(2^g + 1) and belong to even functions of z; the 2^{g−1}(2^g − 1) odd
ones have a gradient at z = 0 which is, as a form Σ ∂_kθ ζ_k on the surface, the square of a section
of the spin bundle.

=====================  ====================================================================
``characteristics``    spin structures, their parity, how a change of marking moves them
``series``             the series and its tail, in balls
``evaluation``         θ of a point that is known in balls, or in floating point
=====================  ====================================================================

References
----------
Mumford, "Tata lectures on theta I" (1983), chapter II.
Atiyah, "Riemann surfaces and spin structures" (1971).
"""

from .characteristics import SpinStructure, spin_structures
from .evaluation import theta
from .series import theta_series

__all__ = ["SpinStructure", "spin_structures", "theta", "theta_series"]
