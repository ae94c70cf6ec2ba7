r"""A number in a ball → the algebraic number that it may be, with the evidence.

A ball of radius δ holds algebraic numbers without end.  One is *recognised* if its polynomial is so
simple that fewer than 10⁻⁶ polynomials as simple would come as close by chance; the evidence says
how many digits were used and how many are left over.  It is never proved.  The opposite is: a
candidate whose ball and the given one have nothing in common is wrong.

========================  =====================================================================
``integer_relations``     small integers c with Σ c_k v_k ≈ 0, by LLL
``polynomial_roots``      roots of integer polynomials in balls
``algebraic_numbers``     minimal polynomials, height, evidence
``surds``                 numbers written with roots
``radicals``              … of algebraic numbers
``number_fields``         the field that some numbers generate, and the numbers in it
``exact_matrices``        all entries of a matrix
``given_numbers``         what is handed over, read as balls
========================  =====================================================================

References
----------
Cohen, "A course in computational algebraic number theory" (1993).
"""

from .integer_relations import nearest_integer, reduced_relations, scaled_lattice
from .polynomial_roots import integer_polynomial, isolated_roots, polynomial_text, root_near
from .algebraic_numbers import (
    LARGEST_DEGREE,
    LEAST_LEFT_OVER,
    AlgebraicNumber,
    Evidence,
    recognise_number,
)
from .surds import Root, Surd, square_part
from .radicals import in_radicals
from .number_fields import RATIONALS, NumberField, generated_field
from .exact_matrices import RecognisedMatrix, recognise_matrix
from .given_numbers import recognize

__all__ = [
    "nearest_integer",
    "reduced_relations",
    "scaled_lattice",
    "integer_polynomial",
    "isolated_roots",
    "polynomial_text",
    "root_near",
    "LARGEST_DEGREE",
    "LEAST_LEFT_OVER",
    "AlgebraicNumber",
    "Evidence",
    "recognise_number",
    "Root",
    "Surd",
    "square_part",
    "in_radicals",
    "RATIONALS",
    "NumberField",
    "generated_field",
    "RecognisedMatrix",
    "recognise_matrix",
    "recognize",
]
