r"""Abelian subvarieties of a Jacobian as sublattices, and their period matrices.

A subvariety is a saturated sublattice B (2g × 2k, columns in Z^{2g}) that the complex structure
keeps.  The form restricted to it, :math:`B^T J B`, is its polarisation; the projection

.. math:: P = (B^T J B)^{-1} B^T J, \qquad e = B P,

is orthogonal for J, so that e is the symmetric idempotent that belongs to B, and the kernel of
:math:`B^T J` is the complementary subvariety.  An endomorphism M is P M B on it.

In a Frobenius basis λ_i, μ_i of type d_1 | d_2 | … the period matrix is τ = D L₁⁻¹ L₂ where L₁,
L₂ are the columns (1 Π) λ and (1 Π) μ in coordinates of their span: τ is symmetric with Im τ > 0,
and the subvariety is C^k / (D Z^k + τ Z^k).

References
----------
Birkenhake, Lange, "Complex abelian varieties" (2004), sections 5.3 and 8.1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import flint
import numpy as np

from igl_periods.arrays import Ints
from igl_periods.symplectic import int_array, standard_form

from .integer_lattices import frobenius_basis, kernel, saturated


@dataclass(frozen=True, eq=False)
class Subvariety:
    """An abelian subvariety of a Jacobian.

    Attributes
    ----------
    lattice : (2g, 2k) int
        Columns: a basis of its periods among those of the Jacobian.
    """

    lattice: Ints

    def __post_init__(self) -> None:
        self.lattice.flags.writeable = False

    def __repr__(self) -> str:
        return f"Subvariety(dimension {self.dimension} of {len(self.lattice) // 2})"

    def __reduce__(self) -> tuple[Any, ...]:
        # What is kept in FLINT's matrices is computed again.
        return Subvariety, (self.lattice.copy(),)

    @property
    def dimension(self) -> int:
        """Its complex dimension k."""
        return self.lattice.shape[1] // 2

    @cached_property
    def form(self) -> Ints:
        """The polarisation BᵀJB; (2k, 2k)."""
        J = standard_form(len(self.lattice) // 2)
        return np.asarray(self.lattice.T @ J @ self.lattice)

    @cached_property
    def _projection(self) -> tuple[flint.fmpz_mat, int]:
        """P times its denominator, and the denominator."""
        J = standard_form(len(self.lattice) // 2)
        inverse = flint.fmpq_mat(flint.fmpz_mat(self.form.tolist())).inv()
        P = inverse * flint.fmpq_mat(flint.fmpz_mat((self.lattice.T @ J).tolist()))
        numerators, denominator = P.numer_denom()
        return numerators, int(denominator)

    @property
    def exponent(self) -> int:
        """The least n for which n times the idempotent e is an integer matrix."""
        return self.idempotent()[1]

    def idempotent(self) -> tuple[Ints, int]:
        """The symmetric idempotent e = BP as an integer matrix over its denominator."""
        numerators, denominator = self._projection
        e = flint.fmpz_mat(self.lattice.tolist()) * numerators
        numerators, rest = (flint.fmpq_mat(e) / flint.fmpq(denominator)).numer_denom()
        return int_array(numerators), int(rest)

    def restricted(self, M: Ints) -> Ints:
        """P M B times the denominator of P: M on the subvariety, up to this factor."""
        B = flint.fmpz_mat(self.lattice.tolist())
        return int_array(self._projection[0] * flint.fmpz_mat(M.tolist()) * B)

    @property
    def denominator(self) -> int:
        """The denominator of the projection P."""
        return self._projection[1]

    def meets(self, other: Subvariety, matrices: Ints) -> bool:
        """Whether one of the endomorphisms maps this subvariety to the other, not to 0."""
        P, _ = other._projection
        B = flint.fmpz_mat(self.lattice.tolist())
        return any(not _is_zero(P * flint.fmpz_mat(M.tolist()) * B) for M in matrices)

    def part(self, columns: flint.fmpz_mat) -> Subvariety:
        """The subvariety of some combinations of the columns, which are rows of coefficients."""
        rows = columns * flint.fmpz_mat(self.lattice.T.tolist())
        return Subvariety(int_array(saturated(rows)).T.copy())

    def kernel_of(self, N: flint.fmpz_mat) -> Subvariety:
        """The subvariety that a map of it, a (2k, 2k) integer matrix, sends to 0."""
        return self.part(kernel(N))

    def complement(self) -> Subvariety:
        """The complementary subvariety: what is orthogonal to this one."""
        J = standard_form(len(self.lattice) // 2)
        return Subvariety(int_array(kernel(flint.fmpz_mat((self.lattice.T @ J).tolist()))).T.copy())

    def period_matrix(self, Pi: flint.acb_mat) -> tuple[flint.acb_mat, tuple[int, ...]]:
        """The period matrix τ in balls, and the type (d_1, …, d_k) of the polarisation."""
        k = self.dimension
        U, divisors = frobenius_basis(self.form)
        basis = self.lattice @ U
        L = _columns(basis, Pi)
        rows = _independent_rows(L, k)
        L1 = flint.acb_mat([[L[i, j] for j in range(k)] for i in rows])
        L2 = flint.acb_mat([[L[i, k + j] for j in range(k)] for i in rows])
        quotient = L1.solve(L2)
        tau = flint.acb_mat([[quotient[i, j] * divisors[i] for j in range(k)] for i in range(k)])
        return (tau + tau.transpose()) / 2, divisors


def whole(g: int) -> Subvariety:
    """The Jacobian itself, of dimension g."""
    return Subvariety(np.eye(2 * g, dtype=np.int64))


def image_of(M: Ints) -> Subvariety:
    """The image of an endomorphism."""
    return Subvariety(int_array(saturated(flint.fmpz_mat(M.T.tolist()))).T.copy())


def _columns(basis: Ints, Pi: flint.acb_mat) -> flint.acb_mat:
    """(1 Π) times integer vectors."""
    g = Pi.nrows()
    upper, lower = (flint.acb_mat(flint.fmpz_mat(x.tolist())) for x in (basis[:g], basis[g:]))
    return upper + Pi * lower


def _independent_rows(L: flint.acb_mat, k: int) -> list[int]:
    """Those k coordinates in which the span of the first k columns is seen best."""
    first = np.array([[complex(L[i, j].mid()) for j in range(k)] for i in range(L.nrows())])
    chosen: list[int] = []
    rest = first.copy()
    for _ in range(k):
        i = int(np.argmax(np.linalg.norm(rest, axis=1)))
        chosen.append(i)
        direction = rest[i] / np.linalg.norm(rest[i])
        rest = rest - np.outer(rest @ direction.conj(), direction)
    return chosen


def _is_zero(M: flint.fmpz_mat) -> bool:
    return all(x == 0 for x in M.entries())
