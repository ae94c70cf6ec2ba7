r"""Π in balls → the endomorphisms of the Jacobian, and the factors into which it splits.

An endomorphism of the Jacobian C^g / (1 Π) Z^{2g} is an integer matrix M with a complex matrix A,

.. math:: A\,(1\;\Pi) = (1\;\Pi)\,M .

They are a ring, Z for most surfaces.  LLL finds more where there is more; each is checked in balls.
Symmetric ones (M' = M for the Rosati involution M' = J⁻¹MᵀJ) split the Jacobian up to isogeny into
subvarieties that split no further, orthogonally for the polarisation.  What is found is recognised,
not proved; what the balls exclude is.

=============================  =================================================================
``integer_lattices``           saturation, kernels, Frobenius bases, coordinates
``commuting_matrices``         integer matrices that commute with a complex structure, by LLL
``rational_representation``    M and A, the Rosati involution, changes of the marking
``subvarieties``               sublattices as abelian subvarieties, and their period matrices
``splitting``                  subvarieties that split no further
``division_algebras``          fields and quaternion algebras that act on these
``structure``                  End ⊗ Q as a product of matrix rings
``endomorphism_ring``          the ring
``ring_search``                … of whatever a period matrix is known by
``eigenforms``                 forms that are eigenforms of real multiplication
``factors``                    elliptic curves and their j, abelian surfaces
=============================  =================================================================

References
----------
Birkenhake, Lange, "Complex abelian varieties" (2004).
Costa, Mascot, Sijsling, Voight, "Rigorous computation of the endomorphism ring of a Jacobian"
(2019).
"""

from .integer_lattices import MatrixLattice, frobenius_basis, saturated_lattice
from .rational_representation import (
    analytic_representation,
    automorphism_of,
    in_first_marking,
    rosati_adjoint,
)
from .subvarieties import Subvariety, image_of
from .division_algebras import SimpleAlgebra, hilbert_symbol
from .structure import AlgebraComponent, AlgebraType
from .endomorphism_ring import EndomorphismRing, RingEvidence
from .ring_search import LARGEST_GENUS, endomorphisms
from .eigenforms import EigenformRing, eigenform_ring
from .factors import IsotypicPart, JacobianFactor, JacobianFactors, jacobian_factors

__all__ = [
    "MatrixLattice",
    "frobenius_basis",
    "saturated_lattice",
    "analytic_representation",
    "automorphism_of",
    "in_first_marking",
    "rosati_adjoint",
    "Subvariety",
    "image_of",
    "SimpleAlgebra",
    "hilbert_symbol",
    "AlgebraComponent",
    "AlgebraType",
    "EndomorphismRing",
    "RingEvidence",
    "LARGEST_GENUS",
    "endomorphisms",
    "EigenformRing",
    "eigenform_ring",
    "IsotypicPart",
    "JacobianFactor",
    "JacobianFactors",
    "jacobian_factors",
]
