r"""The factors of a Jacobian: elliptic curves with their j, abelian surfaces with their invariants.

Every Jacobian is isogenous to a product of simple abelian varieties, unique up to isogeny and order
(Poincaré).  A factor is an abelian subvariety; its period matrix and the type of the polarisation
that the Jacobian gives it follow from a Frobenius basis of its lattice, in balls.

* An elliptic curve has a τ, reduced to the fundamental domain, and j(τ).  A τ recognised as
  quadratic, aτ² + bτ + c = 0, means complex multiplication by the order of discriminant b² − 4ac,
  and j is a root of its class polynomial.
* An abelian surface with a polarisation of type (d, d) is principally polarised, d times: it is the
  Jacobian of a curve of genus 2 with certain Igusa invariants, or a product of two elliptic curves.

References
----------
Birkenhake, Lange, "Complex abelian varieties" (2004), section 5.3 and chapter 10.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, overload

import flint
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes
from igl_periods.display import facts_html
from igl_periods.enclosures import (
    PeriodEnclosure,
    matrix_from_integers,
    matrix_to_integers,
)
from igl_periods.moduli import absolute_igusa_invariants, j_invariant
from igl_periods.recognition import AlgebraicNumber, recognise_number
from igl_periods.siegel import midpoint, siegel_reduce

from .endomorphism_ring import EndomorphismRing
from .ring_search import LARGEST_GENUS, endomorphisms
from .structure import AlgebraComponent
from .subvarieties import Subvariety

_LARGEST_CLASS_DISCRIMINANT = 100_000
_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True, eq=False)
class JacobianFactor:
    """An abelian subvariety of a Jacobian, with its period matrix.

    Attributes
    ----------
    subvariety : Subvariety
        Its lattice of periods among those of the Jacobian.
    matrix : (k, k) acb_mat
        τ in balls: the factor is C^k / (D Z^k + τ Z^k).  Of an elliptic curve: reduced, and D = 1.
    polarisation : tuple of int
        The type d_1 | d_2 | … of the polarisation that the Jacobian gives it.
    bits : int
        Working precision.
    """

    subvariety: Subvariety
    matrix: flint.acb_mat
    polarisation: tuple[int, ...]
    bits: int

    @property
    def dimension(self) -> int:
        """Its complex dimension k."""
        return self.subvariety.dimension

    @property
    def is_elliptic(self) -> bool:
        """Whether this is an elliptic curve."""
        return self.dimension == 1

    @property
    def tau(self) -> flint.acb:
        """τ of an elliptic curve in the fundamental domain, in a ball.

        Raises
        ------
        ValueError
            If this is not an elliptic curve.
        """
        self._only_elliptic("τ")
        return self.matrix[0, 0]

    @cached_property
    def j(self) -> flint.acb:
        """The j-invariant of an elliptic curve, in a ball, j(i) = 1728.

        Raises
        ------
        ValueError
            If this is not an elliptic curve.
        """
        self._only_elliptic("j")
        with flint.ctx.workprec(self.bits):
            return j_invariant(self.matrix)

    @cached_property
    def exact_tau(self) -> AlgebraicNumber | None:
        """The quadratic number that τ is recognised as: complex multiplication; otherwise None."""
        with flint.ctx.workprec(self.bits):
            return recognise_number(self.tau, degree=2)

    @property
    def cm_discriminant(self) -> int | None:
        """The discriminant of End E, an order of complex multiplication; None if it is Z."""
        if self.exact_tau is None:
            return None
        c, b, a = self.exact_tau.polynomial
        return b * b - 4 * a * c

    @cached_property
    def exact_j(self) -> AlgebraicNumber | None:
        """The algebraic number that j is recognised as; None if it is not.

        With complex multiplication by a discriminant that is not too large it is the root of the
        class polynomial in the ball.
        """
        with flint.ctx.workprec(self.bits):
            discriminant = self.cm_discriminant
            if discriminant is not None and -discriminant <= _LARGEST_CLASS_DISCRIMINANT:
                polynomial = flint.fmpz_poly.hilbert_class_poly(discriminant)
                coefficients = tuple(int(c) for c in polynomial.coeffs())
                evidence = None if self.exact_tau is None else self.exact_tau.evidence
                return AlgebraicNumber.root(coefficients, complex(self.j.mid()), evidence)
            return recognise_number(self.j)

    @property
    def is_principal(self) -> bool:
        """Whether the polarisation is a multiple of a principal one."""
        return len(set(self.polarisation)) == 1

    @property
    def igusa_invariants(self) -> Complexes | None:
        """Absolute Igusa invariants of a principally polarised surface that is not a product.

        In double precision; see :func:`~igl_periods.genus_two.absolute_igusa_invariants`.
        """
        if self.dimension != 2 or not self.is_principal:
            return None
        return absolute_igusa_invariants(midpoint(self.matrix) / self.polarisation[0])

    def _only_elliptic(self, what: str) -> None:
        if not self.is_elliptic:
            raise ValueError(
                f"{what} is of elliptic curves; this factor has dimension {self.dimension}"
            )

    def __reduce__(self) -> tuple[Any, ...]:
        balls = matrix_to_integers(self.matrix)
        return _unpickled, (self.subvariety, balls, self.polarisation, self.bits)

    def __repr__(self) -> str:
        if not self.is_elliptic:
            kind = {2: "surface"}.get(self.dimension, f"variety of dimension {self.dimension}")
            return f"JacobianFactor(abelian {kind}, polarisation {self.polarisation})"
        j = complex(self.j.mid()) if self.exact_j is None else self.exact_j
        multiplication = f", CM {self.cm_discriminant}" if self.cm_discriminant else ""
        return f"JacobianFactor(elliptic curve, j = {j}{multiplication})"


@dataclass(frozen=True, eq=False)
class IsotypicPart(Sequence[JacobianFactor]):
    """Factors that are isogenous to each other: B^n up to isogeny.

    Attributes
    ----------
    factors : tuple of JacobianFactor
        n subvarieties, orthogonal for the polarisation; isogenous, not in general isomorphic.
    algebra : AlgebraComponent
        M_n(D).
    """

    factors: tuple[JacobianFactor, ...]
    algebra: AlgebraComponent

    def __len__(self) -> int:
        return len(self.factors)

    @overload
    def __getitem__(self, index: int) -> JacobianFactor: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[JacobianFactor, ...]: ...
    def __getitem__(self, index: int | slice) -> JacobianFactor | tuple[JacobianFactor, ...]:
        return self.factors[index]

    def __repr__(self) -> str:
        return f"IsotypicPart({len(self)} × {self.factors[0]!r}, {self.algebra.name})"

    @property
    def multiplicity(self) -> int:
        """The number n of factors."""
        return len(self.factors)

    @property
    def dimension(self) -> int:
        """The dimension of each factor."""
        return self.factors[0].dimension

    @property
    def is_simple(self) -> bool | None:
        """Whether the factors split no further; None if that was not decided."""
        return True if self.dimension == 1 else self.algebra.division.is_division


@dataclass(frozen=True, eq=False)
class JacobianFactors(Sequence[IsotypicPart]):
    """A Jacobian up to isogeny: recognised, not proved.

    Attributes
    ----------
    parts : tuple of IsotypicPart
    ring : EndomorphismRing

    Examples
    --------
    >>> import igl_periods as ip
    >>> Pi = [[1.5j, -0.5], [-0.5, 1.5j]]
    >>> print(ip.jacobian_factors(Pi))
    E²
    """

    parts: tuple[IsotypicPart, ...]
    ring: EndomorphismRing

    def __len__(self) -> int:
        return len(self.parts)

    @overload
    def __getitem__(self, index: int) -> IsotypicPart: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[IsotypicPart, ...]: ...
    def __getitem__(self, index: int | slice) -> IsotypicPart | tuple[IsotypicPart, ...]:
        return self.parts[index]

    @property
    def elliptic_curves(self) -> list[JacobianFactor]:
        """All factors of dimension 1."""
        return [factor for part in self.parts for factor in part if factor.is_elliptic]

    def __str__(self) -> str:
        letters: dict[int, int] = {}
        names = []
        for part in self.parts:
            letter = {1: "E", 2: "A"}.get(part.dimension, "B")
            letters[part.dimension] = letters.get(part.dimension, 0) + 1
            of_this_kind = sum(p.dimension == part.dimension for p in self.parts)
            number = str(letters[part.dimension]) if of_this_kind > 1 else ""
            power = str(part.multiplicity).translate(_SUPERSCRIPTS) if len(part) > 1 else ""
            names.append(f"{letter}{number}{power}")
        return " × ".join(names)

    def __repr__(self) -> str:
        return f"JacobianFactors({self}: {', '.join(repr(part[0]) for part in self.parts)})"

    def _repr_html_(self) -> str:
        facts = [(f"part {k + 1}", repr(part[0])) for k, part in enumerate(self.parts)]
        return facts_html(f"Jacobian ~ {self}: recognised, not proved", facts)


def _unpickled(
    subvariety: Subvariety,
    balls: list[list[tuple[int, ...]]],
    polarisation: tuple[int, ...],
    bits: int,
) -> JacobianFactor:
    return JacobianFactor(subvariety, matrix_from_integers(balls), polarisation, bits)


def jacobian_factors(
    Pi: ArrayLike | PeriodEnclosure | flint.acb_mat | EndomorphismRing,
    *,
    max_genus: int = LARGEST_GENUS,
) -> JacobianFactors:
    """Split a Jacobian up to isogeny into elliptic curves and other factors.

    Parameters
    ----------
    Pi : PeriodEnclosure, acb_mat, PeriodMatrix, (g, g) array-like or EndomorphismRing
    max_genus : int

    Returns
    -------
    JacobianFactors
        A sequence of isotypic parts, each a sequence of factors.

    Raises
    ------
    NotASiegelPointError, ValueError
        As :func:`endomorphisms`.

    Examples
    --------
    >>> factors = jacobian_factors([[1j, 0.5], [0.5, 1j]])
    >>> str(factors), factors.ring.name, factors[0][0].cm_discriminant
    ('E²', 'M₂(Q(i))', -64)
    """
    ring = Pi if isinstance(Pi, EndomorphismRing) else endomorphisms(Pi, max_genus=max_genus)
    parts = tuple(
        IsotypicPart(tuple(_factor(part, ring) for part in parts), component)
        for parts, component in zip(ring.simple_parts, ring.algebra.components, strict=True)
    )
    return JacobianFactors(parts, ring)


def _factor(part: Subvariety, ring: EndomorphismRing) -> JacobianFactor:
    with flint.ctx.workprec(ring.bits):
        tau, divisors = part.period_matrix(ring.matrix)
        if part.dimension == 1:
            tau = siegel_reduce(tau / divisors[0]).matrix
    return JacobianFactor(part, tau, divisors, ring.bits)
