r"""From energies of some forms in balls to upper bounds in a canonical basis, without loss.

Forms near orthonormal have energies E near 1, and radii of E that are what their bound loses.  In a
canonical basis, B times these forms, the balls of B E Bᵀ would be larger by the condition number of
B, entry by entry.  But only an upper bound in the sense of Loewner is wanted: with the midpoint Ê
of E and r the largest sum of a row of radii,

.. math:: D_{exact} \le B E B^T \le B\, (\hat E + r \cdot 1)\, B^T ,

and the right-hand side is computed with any number of digits.
"""

from __future__ import annotations

from dataclasses import replace

import flint
import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, ExactLengths, MarkedComplex
from igl_periods.harmonic import factor
from igl_periods.proofs import EnclosedTriangulation, linear_problem, linear_proof

ArbMat = flint.arb_mat


def upper_energies(E: ArbMat, basis: ArbMat) -> ArbMat:
    """Upper bounds of energies in another basis.

    Parameters
    ----------
    E : (k, k) arb_mat
        Energies of some forms.
    basis : (k, k) arb_mat
        The matrix B of a basis in terms of these forms.
    """
    k = E.nrows()
    radii = [sum((x.rad() for x in row), flint.arb(0)).upper() for row in E.tolist()]
    # Entries of both triangles are bounds of the same number.
    largest = max(radii, default=flint.arb(0))
    identity = ArbMat(np.eye(k, dtype=np.int64).tolist()) if k else E
    middle = E.mid()
    upper = (middle + middle.transpose()) / 2 + largest * identity
    return basis * upper * basis.transpose()


def canonical_in_forms(basis: Ints, combination: Floats) -> ArbMat:
    """B = U W⁻¹: a canonical basis U c in terms of forms in the classes W c, at any precision."""
    return ArbMat(basis.tolist()) * ArbMat(combination.tolist()).inv()


def linear_upper_energies(marked: MarkedComplex, lengths: ExactLengths) -> ArbMat:
    """Upper bounds from forms that are linear on triangles, which few surfaces are too bad for.

    Raises
    ------
    ComplexError
        If a triangle may be degenerate, or the energies are not positive definite.
    """
    K = marked.complex
    exact: DeltaComplex = K if K.mollification else replace(K, exact_lengths=lengths)
    where = EnclosedTriangulation.of(MarkedComplex(exact, marked.cochains, marked.basis)).flipped()
    laplacian, problem = linear_problem(where)
    proof = linear_proof(problem, factor(laplacian))
    rows = zip(proof.mid.tolist(), proof.rad.tolist())
    E = ArbMat([[flint.arb(m, r) for m, r in zip(*row)] for row in rows])
    return upper_energies(E, canonical_in_forms(proof.basis, proof.combination))
