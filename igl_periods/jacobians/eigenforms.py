r"""Endomorphisms that have a given holomorphic form as an eigenform: real multiplication of a form.

A form ω = Σ v_k ζ_k, v_k = ∮_{a_k} ω, is a row vector, and an endomorphism pulls it back to v A.
It is an eigenform if v A = μ v, g − 1 linear equations for the coefficients of M in a basis of the
ring, solved by LLL on balls.  Those with M' = M have real eigenvalues μ: if they are more than the
integers they are *real multiplication* with ω as eigenform, by an order in a totally real field (or
ω comes from a factor).  For genus 2 this is McMullen's criterion for forms that generate a
Teichmüller curve.

References
----------
McMullen, "Billiards and Teichmüller curves on Hilbert modular surfaces" (2003).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import flint

from igl_periods.arrays import Ints
from igl_periods.enclosures import matrix_from_integers, matrix_to_integers
from igl_periods.recognition import NumberField, reduced_relations

from .division_algebras import field_of
from .endomorphism_ring import EndomorphismRing, order_discriminant
from .integer_lattices import MatrixLattice
from .rational_representation import analytic_representation, rosati_adjoint

_SMALL = 0.6
_SPARE_BITS = 8
_FLOAT_ERROR = 1e-14


@dataclass(frozen=True, eq=False)
class EigenformRing:
    """The endomorphisms that have a form as an eigenform.

    Attributes
    ----------
    lattice : MatrixLattice
        A basis of them.
    form : tuple of acb
        v_k = ∮_{a_k} ω.
    ring : EndomorphismRing

    Examples
    --------
    >>> import igl_periods as ip
    >>> ring = ip.endomorphisms([[1j, 0], [0, 2j]])
    >>> ip.eigenform_ring(ring, [1, 0]).rank
    6
    """

    lattice: MatrixLattice
    form: tuple[flint.acb, ...]
    ring: EndomorphismRing

    def __repr__(self) -> str:
        field = self.real_multiplication
        kind = "splits" if self.splits else f"real multiplication {field or 'Q'}"
        return f"EigenformRing(rank {self.rank}, {kind})"

    def __reduce__(self) -> tuple[Any, ...]:
        balls = matrix_to_integers(flint.acb_mat([list(self.form)]))
        return _unpickled, (self.lattice, balls, self.ring)

    @property
    def rank(self) -> int:
        """The rank over the integers; 1 if only multiples of 1 have the form as an eigenform."""
        return self.lattice.rank

    @cached_property
    def symmetric(self) -> MatrixLattice:
        """Those with M' = M, whose eigenvalues are real."""
        return self.lattice.where([rosati_adjoint(M) - M for M in self.lattice.basis])

    @property
    def real_multiplication(self) -> NumberField | None:
        """The totally real field of which an order acts with ω as eigenform; None if only Q does.

        None too if the symmetric endomorphisms are not a field: then ω comes from a factor, and
        ``splits`` is true.
        """
        field = field_of(self.symmetric)
        return None if field is None or field.degree == 1 else field

    @property
    def discriminant(self) -> int | None:
        """The discriminant of the order that acts by real multiplication."""
        if self.real_multiplication is None:
            return None
        return order_discriminant(self.symmetric)

    @property
    def splits(self) -> bool:
        """Whether the form comes from a proper factor of the Jacobian."""
        return self.symmetric.rank > 1 and self.real_multiplication is None

    def eigenvalue(self, M: Ints) -> flint.acb:
        """The number μ with v A = μ v, in a ball."""
        with flint.ctx.workprec(self.ring.bits):
            k = _largest(self.form)
            A = analytic_representation(M, self.ring.matrix)
            return _product(self.form, A)[k] / self.form[k]


def _unpickled(
    lattice: MatrixLattice, balls: list[list[tuple[int, ...]]], ring: EndomorphismRing
) -> EigenformRing:
    return EigenformRing(lattice, tuple(matrix_from_integers(balls).entries()), ring)


def eigenform_ring(ring: EndomorphismRing, form: Sequence[complex | flint.acb]) -> EigenformRing:
    """Find the endomorphisms that have a holomorphic form as an eigenform.

    Parameters
    ----------
    ring : EndomorphismRing
    form : (g,) complex or acb
        Its a-periods v_k = ∮_{a_k} ω in the marking of the ring.  Complex numbers are taken to be
        right to 1e-14.

    Raises
    ------
    ValueError
        If there are not g numbers, or all may be 0.

    Examples
    --------
    >>> from igl_periods.jacobians import endomorphisms
    >>> eigenform_ring(endomorphisms([[1j, 0], [0, 2j]]), [1, 0]).splits
    True
    """
    v = tuple(_ball(z) for z in form)
    if len(v) != ring.genus:
        raise ValueError(f"a form has {ring.genus} a-periods on this surface, not {len(v)}")
    k = _largest(v)
    if v[k].contains(0):
        raise ValueError("all a-periods may be 0: a holomorphic form without them vanishes")
    with flint.ctx.workprec(ring.bits):
        conditions = [_conditions(v, k, M, ring.matrix) for M in ring.basis]
        coefficients = _relations(conditions)
    return EigenformRing(ring.lattice.combined(coefficients), v, ring)


def _conditions(v: tuple[flint.acb, ...], k: int, M: Ints, Pi: flint.acb_mat) -> list[flint.arb]:
    """The real and imaginary parts of (vA)_j v_k − (vA)_k v_j, which are 0 for an eigenform."""
    w = _product(v, analytic_representation(M, Pi))
    differences = [w[j] * v[k] - w[k] * v[j] for j in range(len(v)) if j != k]
    return [part for z in differences for part in (z.real, z.imag)]


def _relations(conditions: list[list[flint.arb]]) -> flint.fmpz_mat:
    """The integer combinations under which all conditions hold."""
    n, m = len(conditions), len(conditions[0])
    if m == 0:
        return flint.fmpz_mat([[int(i == j) for j in range(n)] for i in range(n)])
    known = min(-math.log2(float(x.rad())) if x.rad() > 0 else flint.ctx.prec
                for row in conditions for x in row)  # fmt: skip
    bits = max(1, int(known) - _SPARE_BITS)
    small = _SMALL * bits * min(m, n) / n
    rows = [
        row
        for row in reduced_relations(conditions, bits)
        if math.log2(2 * max(map(abs, row)) + 1) <= small and _hold(row, conditions)
    ]
    return flint.fmpz_mat(rows)


def _hold(row: list[int], conditions: list[list[flint.arb]]) -> bool:
    sums = [
        sum((c * x for c, x in zip(row, column, strict=True)), flint.arb(0))
        for column in zip(*conditions, strict=True)
    ]
    return all(s.contains(0) for s in sums)


def _product(v: tuple[flint.acb, ...], A: flint.acb_mat) -> list[flint.acb]:
    return list((flint.acb_mat([list(v)]) * A).entries())


def _largest(v: tuple[flint.acb, ...]) -> int:
    return max(range(len(v)), key=lambda k: abs(complex(v[k].mid())))


def _ball(z: complex | flint.acb) -> flint.acb:
    if isinstance(z, flint.acb):
        return z
    radius = flint.arb(0, _FLOAT_ERROR * abs(complex(z)))
    return flint.acb(complex(z)) + flint.acb(radius, radius)
