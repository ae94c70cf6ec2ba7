r"""Integer matrices as endomorphisms: analytic representation, Rosati involution, traces.

An endomorphism of the Jacobian C^g / (1 Π) Z^{2g} is an integer matrix M (its rational
representation, on the columns of (1 Π)) with a complex matrix A (analytic),

.. math:: A\,(1\;\Pi) = (1\;\Pi)\,M .

Products are those of matrices, and :math:`\operatorname{tr} M = \operatorname{tr} A +
\overline{\operatorname{tr} A}`.  The polarisation is E(x, y) = xᵀ J y, and the Rosati involution

.. math:: M' = J^{-1} M^T J, \qquad E(Mx, y) = E(x, M'y), \qquad \operatorname{tr} M M' > 0 .

In another marking, Π' = γ·Π, γ = [[a, b], [c, d]], the lattices are related by
:math:`(1\;\Pi') = (c\Pi + d)^{-T} (1\;\Pi) N`, N = [[dᵀ, bᵀ], [cᵀ, aᵀ]], and M' = N⁻¹ M N.

References
----------
Birkenhake, Lange, "Complex abelian varieties" (2004), sections 1.2 and 5.1.
"""

from __future__ import annotations

import flint
import numpy as np

from igl_periods.arrays import Ints
from igl_periods.symplectic import product, standard_form, unimodular_inverse


def analytic_representation(M: Ints, Pi: flint.acb_mat) -> flint.acb_mat:
    """The complex matrix A = a + Πc of an endomorphism M = [[a, b], [c, d]]."""
    g = Pi.nrows()
    a, c = (flint.acb_mat(flint.fmpz_mat(block.tolist())) for block in (M[:g, :g], M[g:, :g]))
    return a + Pi * c


def misses(M: Ints, Pi: flint.acb_mat) -> bool:
    """Whether the balls exclude that M is an endomorphism: a proof that it is none."""
    g = Pi.nrows()
    b, d = (flint.acb_mat(flint.fmpz_mat(block.tolist())) for block in (M[:g, g:], M[g:, g:]))
    left = analytic_representation(M, Pi) * Pi
    return not left.overlaps(b + Pi * d)


def rosati_adjoint(M: Ints) -> Ints:
    """The adjoint M' = J⁻¹ Mᵀ J for the polarisation."""
    J = standard_form(len(M) // 2)
    return np.asarray(-J @ M.T @ J)


def lattice_change(gamma: Ints) -> Ints:
    """N = [[dᵀ, bᵀ], [cᵀ, aᵀ]] with (1 γ·Π) = (cΠ + d)⁻ᵀ (1 Π) N."""
    g = len(gamma) // 2
    a, b, c, d = gamma[:g, :g], gamma[:g, g:], gamma[g:, :g], gamma[g:, g:]
    return np.block([[d.T, b.T], [c.T, a.T]])


def in_first_marking(M: Ints, gamma: Ints) -> Ints:
    """The endomorphism of Π that is M in the marking of γ·Π."""
    N = lattice_change(gamma)
    return product(product(N, M), unimodular_inverse(N))


def automorphism_of(gamma: Ints) -> Ints:
    """The automorphism of the Jacobian that a γ with γ·Π = Π is: (1 Π) = (cΠ + d)⁻ᵀ (1 Π) N."""
    return lattice_change(gamma)
