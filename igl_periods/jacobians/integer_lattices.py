"""Lattices of integer vectors and matrices: saturation, kernels, Frobenius bases, coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import flint
import numpy as np

from igl_periods.arrays import Ints
from igl_periods.symplectic import int_array


def saturated(vectors: flint.fmpz_mat) -> flint.fmpz_mat:
    """An LLL-reduced basis of all integer vectors in the rational span of the rows.

    With the reduced echelon form R of the rows these are x R for the x that make it integer: the
    lattice dual to the one that the columns of R generate.

    Examples
    --------
    >>> saturated(flint.fmpz_mat([[2, 4, 0], [0, 6, 0]])).tolist()
    [[1, 0, 0], [0, 1, 0]]
    """
    echelon, denominator, rank = vectors.rref()
    n = vectors.ncols()
    if rank == 0:
        return flint.fmpz_mat(0, n)
    R = flint.fmpz_mat(rank, n, echelon.entries()[: rank * n])
    columns = R.transpose().hnf()
    generators = flint.fmpz_mat(rank, rank, columns.entries()[: rank * rank])
    dual = flint.fmpq_mat(generators).inv().transpose() * flint.fmpq(denominator)
    basis = dual * flint.fmpq_mat(R) / flint.fmpq(denominator)
    numerators, one = basis.numer_denom()
    assert one == 1
    return numerators.lll()


def kernel(M: flint.fmpz_mat) -> flint.fmpz_mat:
    """A reduced basis, as rows, of the integer x with M x = 0."""
    X, nullity = M.nullspace()
    columns = X.transpose()
    n = M.ncols()
    return saturated(flint.fmpz_mat(nullity, n, columns.entries()[: nullity * n]))


def frobenius_basis(skew: Ints) -> tuple[Ints, tuple[int, ...]]:
    """A unimodular U with Uᵀ S U = [[0, D], [−D, 0]], D = diag(d_1 | d_2 | …) > 0.

    Parameters
    ----------
    skew : (2k, 2k) int
        A skew form S that is not degenerate.

    Raises
    ------
    ValueError
        If it is degenerate.

    Examples
    --------
    >>> U, d = frobenius_basis(np.array([[0, -6], [6, 0]]))
    >>> U.tolist(), d
    ([[0, 1], [1, 0]], (6,))
    """
    n = len(skew)
    S = [[int(x) for x in row] for row in skew.tolist()]
    U = [[int(i == j) for j in range(n)] for i in range(n)]  # rows are the basis vectors
    first, second, divisors = [], [], []
    left = list(range(n))
    while left:
        i, j = _smallest_pivot(S, left)
        if _reduced_by_pivot(S, U, left, i, j):
            first.append(U[i])
            second.append(U[j])
            divisors.append(S[i][j])
            left = [k for k in left if k not in (i, j)]
    return np.array(first + second, dtype=np.int64).reshape(n, n).T, tuple(divisors)


def _smallest_pivot(S: list[list[int]], left: list[int]) -> tuple[int, int]:
    pairs = [(abs(S[i][j]), i, j) for i in left for j in left if i < j and S[i][j]]
    if not pairs:
        raise ValueError("the skew form is degenerate")
    _, i, j = min(pairs)
    return (i, j) if S[i][j] > 0 else (j, i)


def _add(S: list[list[int]], U: list[list[int]], k: int, source: int, factor: int) -> None:
    """Add a multiple of one basis vector to another."""
    U[k] = [x + factor * y for x, y in zip(U[k], U[source])]
    S[k] = [x + factor * y for x, y in zip(S[k], S[source])]
    for row in S:
        row[k] += factor * row[source]


def _reduced_by_pivot(
    S: list[list[int]], U: list[list[int]], left: list[int], i: int, j: int
) -> bool:
    """Make all others orthogonal to i and j; False if a smaller pivot has come up on the way."""
    others = [k for k in left if k not in (i, j)]
    for k in others:
        _add(S, U, k, j, -(S[i][k] // S[i][j]))
        _add(S, U, k, i, -(S[j][k] // S[j][i]))
    if any(S[p][k] for p in (i, j) for k in others):
        return False
    for a in others:
        if any(S[a][b] % S[i][j] for b in others):
            _add(S, U, i, a, 1)
            return False
    return True


@dataclass(frozen=True, eq=False)
class MatrixLattice:
    """A lattice of integer matrices, with coordinates.

    Attributes
    ----------
    basis : (r, n, n) int
    """

    basis: Ints

    def __post_init__(self) -> None:
        self.basis.flags.writeable = False

    def __repr__(self) -> str:
        n = self.basis.shape[1]
        return f"MatrixLattice(rank {self.rank}, {n} × {n} matrices)"

    def __reduce__(self) -> tuple[Any, ...]:
        # What is kept in FLINT's matrices is computed again.
        return MatrixLattice, (self.basis.copy(),)

    @property
    def rank(self) -> int:
        """The number of basis elements."""
        return len(self.basis)

    @cached_property
    def rows(self) -> flint.fmpz_mat:
        """The basis elements as rows; (r, n²)."""
        return as_rows(self.basis)

    @cached_property
    def _solver(self) -> tuple[list[int], flint.fmpz_mat, int]:
        """Places at which the entries of a matrix determine its coordinates, and how."""
        echelon, _, rank = self.rows.rref()
        rows = echelon.tolist()[:rank]
        places = [next(k for k, x in enumerate(row) if x) for row in rows]
        square = flint.fmpz_mat([[row[k] for k in places] for row in self.rows.tolist()])
        numerators, denominator = flint.fmpq_mat(square).inv().numer_denom()
        return places, numerators, int(denominator)

    def coordinates(self, M: Ints) -> list[Fraction] | None:
        """The rational numbers c with M = Σ c_k M_k; None if M is not in the span."""
        places, solve, denominator = self._solver
        flat = np.ravel(M).tolist()
        scaled = flint.fmpz_mat([[flat[k] for k in places]]) * solve
        if scaled * self.rows != flint.fmpz_mat([flat]) * denominator:
            return None
        return [Fraction(int(c), denominator) for c in scaled.entries()]

    def contains(self, M: Ints) -> bool:
        """Whether M is an integer combination of the basis."""
        found = self.coordinates(M)
        return found is not None and all(c.denominator == 1 for c in found)

    def where(self, conditions: Sequence[Ints]) -> MatrixLattice:
        """The elements Σ c_k M_k with Σ c_k v_k = 0, v_k an integer array for each k."""
        columns = np.stack([np.ravel(v) for v in conditions])
        solutions = kernel(flint.fmpz_mat(columns.T.tolist()))
        return self.combined(solutions)

    def combined(self, coefficients: flint.fmpz_mat) -> MatrixLattice:
        """The lattice spanned by combinations of the basis; their coefficients are rows."""
        n = self.basis.shape[1]
        product = int_array(coefficients * self.rows)
        return MatrixLattice(product.reshape(-1, n, n))


def as_rows(matrices: Ints) -> flint.fmpz_mat:
    """Matrices as rows of one integer matrix."""
    r = len(matrices)
    return flint.fmpz_mat(r, matrices[0].size if r else 0, np.ravel(matrices).tolist())


def saturated_lattice(matrices: Sequence[Ints] | Ints) -> MatrixLattice:
    """All integer matrices in the rational span of some integer matrices."""
    stacked = np.stack(list(matrices))
    rows = int_array(saturated(as_rows(stacked)))
    return MatrixLattice(rows.reshape(-1, *stacked.shape[1:]))
