r"""The ring of endomorphisms of a Jacobian.

LLL finds a basis (:mod:`~igl_periods.jacobians.commuting_matrices`), in a reduced marking, of the
integer matrices that commute with the complex structure.  Products are added until the span is a
ring, and every element is checked in balls at the full precision: what a ball excludes is proved to
be no endomorphism, and refused.  That the rest are endomorphisms is recognised, not proved; that
there are no others below a stated size is proved.

References
----------
Costa, Mascot, Sijsling, Voight, "Rigorous computation of the endomorphism ring of a Jacobian"
(2019).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, overload

import flint
import numpy as np

from igl_periods.arrays import Ints
from igl_periods.display import facts_html
from igl_periods.enclosures import matrix_from_integers, matrix_to_integers
from igl_periods.recognition import NumberField

from .division_algebras import commute, field_of
from .integer_lattices import MatrixLattice, saturated_lattice
from .rational_representation import analytic_representation, misses, rosati_adjoint
from .splitting import isotypic_classes, minimal_polynomial, short_elements, split
from .structure import AlgebraType, algebra_type
from .subvarieties import Subvariety, whole

_FIELD_TRIALS = 40


@dataclass(frozen=True)
class RingEvidence:
    """What speaks for a ring of endomorphisms.

    Attributes
    ----------
    digits : float
        Digits of the entries of the period matrix that the search used.
    checked_digits : float
        Digits at which all elements of the basis were checked in balls.
    left_over : float
        Minus the logarithm of the expected number of matrices, as small as the largest of the
        basis, that solve the equations by chance.
    random_height : float
        Logarithm of the entries of the smallest matrix that does so by chance.
    excluded : float
        Proved: every other endomorphism, in a reduced marking, has a Frobenius norm of at least ten
        to this power.  −∞ where that was not computed.
    """

    digits: float
    checked_digits: float
    left_over: float
    random_height: float
    excluded: float


@dataclass(frozen=True, eq=False)
class EndomorphismRing(Sequence[Ints]):
    """End(Jac) as a lattice of (2g, 2g) integer matrices M with A (1 Π) = (1 Π) M.

    Attributes
    ----------
    lattice : MatrixLattice
        A basis; its identity is an integer combination.
    matrix : (g, g) acb_mat
        The period matrix Π, in the marking of the matrices.
    bits : int
        Working precision of Π.
    evidence : RingEvidence

    Examples
    --------
    >>> import igl_periods as ip
    >>> Pi = [[1.5j, -0.5], [-0.5, 1.5j]]
    >>> ring = ip.endomorphisms(Pi)
    >>> ring.rank, ring.name
    (8, 'M₂(Q(i))')
    """

    lattice: MatrixLattice
    matrix: flint.acb_mat
    bits: int
    evidence: RingEvidence

    def __len__(self) -> int:
        return self.rank

    @overload
    def __getitem__(self, index: int) -> Ints: ...
    @overload
    def __getitem__(self, index: slice) -> list[Ints]: ...
    def __getitem__(self, index: int | slice) -> Ints | list[Ints]:
        if isinstance(index, slice):
            return list(self.lattice.basis[index])
        return np.asarray(self.lattice.basis[index])

    @property
    def basis(self) -> Ints:
        """A basis over the integers; (rank, 2g, 2g)."""
        return self.lattice.basis

    @property
    def rank(self) -> int:
        """The rank over the integers."""
        return self.lattice.rank

    @property
    def genus(self) -> int:
        """The dimension g of the Jacobian."""
        return int(self.matrix.nrows())

    def analytic(self, M: Ints) -> flint.acb_mat:
        """The complex matrix A = a + Πc of an endomorphism, in balls."""
        with flint.ctx.workprec(self.bits):
            return analytic_representation(M, self.matrix)

    def rosati(self, M: Ints) -> Ints:
        """The Rosati involution M' = J⁻¹MᵀJ."""
        return rosati_adjoint(M)

    def contains(self, M: Ints) -> bool:
        """Whether an integer matrix is in the ring."""
        return self.lattice.contains(np.asarray(M, dtype=np.int64))

    @cached_property
    def symmetric(self) -> MatrixLattice:
        """The endomorphisms with M' = M: the Néron–Severi group of the Jacobian."""
        return self.lattice.where([rosati_adjoint(M) - M for M in self.basis])

    @property
    def is_commutative(self) -> bool:
        """Whether all endomorphisms commute."""
        return commute(self.basis)

    @cached_property
    def trace_form(self) -> Ints:
        """tr(M_i M_j), the traces of rational representations; (rank, rank)."""
        return np.einsum("aij,bji->ab", self.basis, self.basis)

    @property
    def trace_discriminant(self) -> int:
        """The determinant of the trace form."""
        return int(flint.fmpz_mat(self.trace_form.tolist()).det())

    @cached_property
    def field(self) -> NumberField | None:
        """The field that End ⊗ Q is isomorphic to; None if it is not a field."""
        return field_of(self.lattice) if self.is_commutative else None

    @property
    def discriminant(self) -> int | None:
        """The discriminant of the ring as an order in a number field; None if it is none.

        On a field of degree r the trace of the representation is 2g/r times the trace.
        """
        if self.field is None:
            return None
        return order_discriminant(self.lattice)

    @cached_property
    def simple_parts(self) -> list[list[Subvariety]]:
        """Subvarieties that split no further, those that are isogenous in one list."""
        return isotypic_classes(split(whole(self.genus), self.symmetric.basis), self.basis)

    @cached_property
    def algebra(self) -> AlgebraType:
        """The type of End ⊗ Q, a product of matrix rings over division algebras."""
        return algebra_type(self.simple_parts, self.basis)

    @property
    def name(self) -> str:
        """End ⊗ Q in words, such as ``Q(√5)`` or ``M₂(Q)``."""
        return self.algebra.name

    @property
    def has_complex_multiplication(self) -> bool:
        """Whether every simple part has: a commutative subalgebra of degree 2g."""
        return self.algebra.has_complex_multiplication

    @cached_property
    def real_fields(self) -> list[NumberField]:
        """Real multiplication: totally real fields of degree g, of small symmetric elements.

        A matrix ring over a field contains infinitely many of them; these are those of short
        elements, the smallest discriminant first.
        """
        found: dict[tuple[int, ...], NumberField] = {}
        for s in short_elements(self.symmetric, _FIELD_TRIALS):
            p = minimal_polynomial(s)
            if p.degree() == self.genus > 1 and len(p.factor()[1]) == 1:
                field = field_of(MatrixLattice(_powers(s, self.genus)))
                if field is not None:
                    found.setdefault(field.polynomial, field)
        return sorted(found.values(), key=lambda k: abs(int(_discriminant(k))))

    def checked(self, Pi: flint.acb_mat, bits: int, digits: float) -> EndomorphismRing:
        """The ring with the period matrix in narrower balls, all elements checked in them.

        Raises
        ------
        ValueError
            If a ball excludes an element: it is proved not to be an endomorphism.
        """
        with flint.ctx.workprec(bits):
            wrong = [k for k, M in enumerate(self.basis) if misses(M, Pi)]
        if wrong:
            raise ValueError(
                f"{len(wrong)} of {self.rank} matrices are not endomorphisms of the period matrix "
                f"with {digits:.0f} digits: what was found with {self.evidence.digits:.0f} digits "
                "was a coincidence, or the two matrices have different markings"
            )
        evidence = replace(self.evidence, checked_digits=digits)
        return EndomorphismRing(self.lattice, Pi, bits, evidence)

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("rank", str(self.rank)), ("algebra", self.name)]
        if self.discriminant is not None:
            facts.append(("discriminant", str(self.discriminant)))
        facts.append(("digits checked", f"{self.evidence.checked_digits:.0f}"))
        return facts

    def __reduce__(self) -> tuple[Any, ...]:
        balls = matrix_to_integers(self.matrix)
        return _unpickled, (self.lattice, balls, self.bits, self.evidence)

    def __repr__(self) -> str:
        return f"EndomorphismRing({', '.join(f'{name} {value}' for name, value in self._facts())})"

    def _repr_html_(self) -> str:
        return facts_html("Endomorphisms: recognised, not proved", self._facts())


def _unpickled(
    lattice: MatrixLattice, balls: list[list[tuple[int, ...]]], bits: int, evidence: RingEvidence
) -> EndomorphismRing:
    return EndomorphismRing(lattice, matrix_from_integers(balls), bits, evidence)


def order_discriminant(lattice: MatrixLattice) -> int:
    """The discriminant of an order in a field of degree r, given by matrices of size n.

    Traces of the matrices are n/r times those of the field.
    """
    r, n = lattice.basis.shape[:2]
    form = np.einsum("aij,bji->ab", lattice.basis, lattice.basis)
    determinant = int(flint.fmpz_mat(form.tolist()).det())
    return determinant * r**r // n**r


def closed_ring(matrices: Ints) -> MatrixLattice:
    """The ring that integer matrices generate, and all integer matrices in its span."""
    lattice = saturated_lattice([np.eye(matrices.shape[1], dtype=np.int64), *matrices])
    while True:
        new: list[Any] = []
        for M in lattice.basis:
            for N in (*lattice.basis, None):
                P = rosati_adjoint(M) if N is None else M @ N
                if lattice.coordinates(P) is None:
                    new.append(P)
                    break
        if not new:
            return lattice
        lattice = saturated_lattice([*lattice.basis, *new])


def _powers(s: Ints, n: int) -> Ints:
    powers = [np.eye(len(s), dtype=np.int64)]
    for _ in range(n - 1):
        powers.append(powers[-1] @ s)
    return np.stack(powers)


def _discriminant(field: NumberField) -> flint.fmpz:
    return flint.fmpz_poly(list(field.polynomial)).discriminant()
