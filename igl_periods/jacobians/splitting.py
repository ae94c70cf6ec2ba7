r"""A Jacobian up to isogeny: subvarieties that split no further.

A symmetric endomorphism s = s' is diagonalizable with real eigenvalues.  If its minimal polynomial
has two factors over the rational numbers, p = f₁ f₂ …, then the subvariety splits, orthogonally for
the polarisation, into the kernels of f₁(s), f₂(s), … (their projections are symmetric idempotents,
polynomials in s).  Short elements of the lattice of symmetric endomorphisms are tried, then random
combinations of them.

References
----------
Birkenhake, Lange, "Complex abelian varieties" (2004), section 5.3.
Lombardo, Lorenzo García, Ritzenthaler, Sijsling, "Decomposing Jacobians via Galois covers" (2020).
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator
from itertools import combinations

import flint
import numpy as np

from igl_periods.arrays import Ints

from .integer_lattices import MatrixLattice, saturated_lattice
from .subvarieties import Subvariety

_RANDOM_TRIALS, _LARGEST_COEFFICIENT = 400, 12
_SEED = 1


def short_elements(lattice: MatrixLattice, trials: int = _RANDOM_TRIALS) -> Iterator[Ints]:
    """Elements of a lattice of matrices: its basis, sums of two, then random combinations."""
    basis = lattice.basis
    yield from basis
    for i, j in combinations(range(len(basis)), 2):
        yield basis[i] + basis[j]
        yield basis[i] - basis[j]
    generator = random.Random(_SEED)
    for trial in range(trials):
        size = 1 + trial * _LARGEST_COEFFICIENT // max(trials, 1)
        coefficients = [generator.randint(-size, size) for _ in basis]
        yield np.tensordot(np.array(coefficients, dtype=np.int64), basis, axes=1)


def restricted_lattice(part: Subvariety, matrices: Iterable[Ints]) -> MatrixLattice:
    """The endomorphisms P M B of a subvariety, up to isogeny: integer matrices in their span."""
    return saturated_lattice([part.restricted(M) for M in matrices])


def minimal_polynomial(M: Ints) -> flint.fmpz_poly:
    """The minimal polynomial of an integer matrix."""
    return flint.fmpz_mat(M.tolist()).minpoly()


def split(part: Subvariety, symmetric: Ints) -> list[Subvariety]:
    """Subvarieties into which one splits, and that split no further.

    Parameters
    ----------
    part : Subvariety
    symmetric : (s, 2g, 2g) int
        A basis of the symmetric endomorphisms of the Jacobian.
    """
    if part.dimension <= 1:
        return [part]
    lattice = restricted_lattice(part, symmetric)
    if lattice.rank == 1:
        return [part]
    for s in short_elements(lattice):
        factors = [f for f, _ in minimal_polynomial(s).factor()[1]]
        if len(factors) > 1:
            pieces = [part.kernel_of(_value(f, s)) for f in factors]
            return [simple for piece in pieces for simple in split(piece, symmetric)]
    return [part]


def isotypic_classes(parts: list[Subvariety], matrices: Ints) -> list[list[Subvariety]]:
    """Subvarieties in classes: those of one class are isogenous, by known endomorphisms."""
    classes: list[list[Subvariety]] = []
    for part in parts:
        for known in classes:
            if known[0].dimension == part.dimension and known[0].meets(part, matrices):
                known.append(part)
                break
        else:
            classes.append([part])
    return classes


def _value(f: flint.fmpz_poly, M: Ints) -> flint.fmpz_mat:
    """f(M), by Horner's rule."""
    matrix = flint.fmpz_mat(M.tolist())
    n = len(M)
    one = flint.fmpz_mat(np.eye(n, dtype=np.int64).tolist())
    value = flint.fmpz_mat(n, n)
    for c in reversed(f.coeffs()):
        value = value * matrix + one * c
    return value
