r"""Which division algebra acts on a simple abelian variety.

By Albert the endomorphism algebra of a simple abelian variety is a totally real field, a quaternion
algebra over one, or a division algebra over a CM field.  Here: a commutative algebra is a field iff
some element has an irreducible minimal polynomial of full degree.  A quaternion algebra over Q is
spanned by 1, i, j, ij with i² = a, j² = b, ij = −ji; it ramifies at the primes with the Hilbert
symbol (a, b)_p = −1, and is a division algebra iff there is one.

References
----------
Mumford, "Abelian varieties" (1970), section 21.
Serre, "A course in arithmetic" (1973), chapter III.
"""

from __future__ import annotations

from dataclasses import dataclass

import flint
import numpy as np

from igl_periods.arrays import Ints
from igl_periods.recognition import (
    AlgebraicNumber,
    NumberField,
    generated_field,
    integer_polynomial,
    isolated_roots,
)

from .integer_lattices import MatrixLattice
from .splitting import minimal_polynomial, short_elements

_TRIALS = 60


@dataclass(frozen=True)
class SimpleAlgebra:
    """The endomorphism algebra of a subvariety that was not split.

    Attributes
    ----------
    dimension : int
        Over the rational numbers.
    centre : NumberField or None
        A field isomorphic to the centre.
    kind : str
        "Q", "totally real field", "CM field", "quaternion algebra" or "algebra".
    ramified : tuple of int
        Primes where a quaternion algebra over Q ramifies, 0 for the real place.
    is_division : bool or None
        Whether it is a division algebra, so that the subvariety is simple; None if that was not
        decided.
    """

    dimension: int
    centre: NumberField | None
    kind: str
    ramified: tuple[int, ...] = ()
    is_division: bool | None = True

    @property
    def name(self) -> str:
        """Such as Q, Q(√5), Q(i√7), or quaternions of discriminant 6."""
        if self.kind == "quaternion algebra" and self.ramified:
            discriminant = int(np.prod([p for p in self.ramified if p] or [1]))
            place = "definite " if 0 in self.ramified else ""
            return f"{place}quaternion algebra of discriminant {discriminant}"
        if self.kind in ("quaternion algebra", "algebra"):
            return f"{self.kind} of dimension {self.dimension} over {self.centre}"
        return str(self.centre)

    @property
    def has_complex_multiplication(self) -> bool:
        """Whether this is a CM field."""
        return self.kind == "CM field"


def simple_algebra(lattice: MatrixLattice) -> SimpleAlgebra:
    """Name the algebra spanned by integer matrices, in which no idempotent was found.

    Parameters
    ----------
    lattice : MatrixLattice
        A basis of it; 1 is in its span.
    """
    centre = centre_of(lattice)
    field = field_of(centre)
    if lattice.rank == centre.rank:
        if field is None:
            return SimpleAlgebra(lattice.rank, None, "algebra", is_division=None)
        return SimpleAlgebra(lattice.rank, field, _kind_of_field(field))
    if field is not None and lattice.rank == 4 * centre.rank:
        if centre.rank == 1:
            ramified = ramified_places(*quaternion_constants(lattice))
            return SimpleAlgebra(4, field, "quaternion algebra", ramified, bool(ramified))
        return SimpleAlgebra(lattice.rank, field, "quaternion algebra", is_division=None)
    return SimpleAlgebra(lattice.rank, field, "algebra", is_division=None)


def centre_of(lattice: MatrixLattice) -> MatrixLattice:
    """The elements that commute with all others."""
    basis = lattice.basis
    commutators = [[M @ N - N @ M for N in basis] for M in basis]
    return lattice.where([np.stack(row) for row in commutators])


def field_of(lattice: MatrixLattice) -> NumberField | None:
    """The field that a commutative algebra is; None if it is none."""
    for M in short_elements(lattice, _TRIALS):
        p = minimal_polynomial(M)
        if p.degree() == lattice.rank:
            if len(p.factor()[1]) > 1:
                return None
            return _field(p)
    return None


def _field(p: flint.fmpz_poly) -> NumberField | None:
    """A field isomorphic to Q[X] / p; the generator is chosen among its negative and conjugates."""
    polynomial = integer_polynomial([int(c) for c in p.coeffs()])
    field = generated_field([_last_root(polynomial)])
    if field is None or field.degree <= 2:
        return field
    signs = [tuple(c * s**k for k, c in enumerate(field.polynomial)) for s in (1, -1)]
    return NumberField(_last_root(max(integer_polynomial(c) for c in signs)))


def _last_root(polynomial: tuple[int, ...]) -> AlgebraicNumber:
    roots = [complex(root.mid()) for root in isolated_roots(polynomial, 64)]
    return AlgebraicNumber(polynomial, max(roots, key=lambda z: (round(z.imag, 9), z.real)))


def _kind_of_field(field: NumberField) -> str:
    if field.degree == 1:
        return "Q"
    real = all(root.imag == 0 for root in isolated_roots(field.polynomial, 64))
    return "totally real field" if real else "CM field"


def quaternion_constants(lattice: MatrixLattice) -> tuple[int, int]:
    """Integers a = i² and b = j² with ij = −ji for a quaternion algebra over Q.

    If one is 0 on the way there are nilpotent elements, and (1, 1) is the matrix ring.
    """
    n = lattice.basis.shape[1]
    one = np.eye(n, dtype=np.int64)
    pure = [n * M - int(np.trace(M)) * one for M in lattice.basis]
    i = next(M for M in pure if M.any())
    anticommuting = lattice.where([i @ M + M @ i for M in lattice.basis])
    j = anticommuting.basis[0]
    a, b = int((i @ i)[0, 0]), int((j @ j)[0, 0])
    return (a, b) if a and b else (1, 1)


def ramified_places(a: int, b: int) -> tuple[int, ...]:
    """The places where the quaternion algebra (a, b) over Q ramifies; 0 is the real one.

    Raises
    ------
    ValueError
        If a or b is 0.

    Examples
    --------
    >>> ramified_places(-1, -1), ramified_places(-1, 3), ramified_places(1, 7)
    ((0, 2), (2, 3), ())
    """
    if a == 0 or b == 0:
        raise ValueError(f"the quaternion algebra ({a}, {b}) needs two numbers that are not 0")
    primes = {2} | {int(p) for n in (a, b) for p, _ in flint.fmpz(abs(n)).factor() if p > 1}
    real = [0] if a < 0 and b < 0 else []
    return (*real, *(p for p in sorted(primes) if hilbert_symbol(a, b, p) == -1))


def hilbert_symbol(a: int, b: int, p: int) -> int:
    """The Hilbert symbol (a, b)_p at a prime: 1 iff ax² + by² = z² has a solution."""
    alpha, u = _valuation(a, p)
    beta, v = _valuation(b, p)
    if p == 2:
        e = (u - 1) // 2 * ((v - 1) // 2) + alpha * (v * v - 1) // 8 + beta * (u * u - 1) // 8
        return -1 if e % 2 else 1
    sign = -1 if alpha * beta * ((p - 1) // 2) % 2 else 1
    return sign * _legendre(u, p) ** beta * _legendre(v, p) ** alpha


def _valuation(n: int, p: int) -> tuple[int, int]:
    k = 0
    while n % p == 0:
        n, k = n // p, k + 1
    return k, n


def _legendre(u: int, p: int) -> int:
    return 1 if pow(u, (p - 1) // 2, p) == 1 else -1


def commute(matrices: Ints) -> bool:
    """Whether all matrices commute."""
    return all(np.array_equal(M @ N, N @ M) for k, M in enumerate(matrices) for N in matrices[:k])
