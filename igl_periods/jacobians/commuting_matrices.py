r"""Integer matrices that commute with a complex structure, by LLL on balls.

M = [[a, b], [c, d]] in g × g blocks maps the period lattice (1 Π) Z^{2g} into itself by a complex
linear map A iff

.. math:: A\,(1\;\Pi) = (1\;\Pi)\,M, \quad\text{that is}\quad A = a + \Pi c, \qquad
          (a + \Pi c)\,\Pi = b + \Pi d ,

g² complex equations with known coefficients for 4g² unknown integers.  LLL reduces all integer
vectors by their size and by how far they miss the equations.  True solutions stay small; all
others have entries of about 2^{b/2}, b the bits that were used.  What LLL puts first, and what is
small and in its ball, is kept.

What is *not* there is a theorem.  A solution M with the norm B is a vector of the lattice not
longer than :math:`B \sqrt{1 + c}`, c from the rounding of the coefficients and their radii.  One
that is not in the span of those found is at least as long as the shortest of the remaining
Gram–Schmidt vectors.

References
----------
Costa, Mascot, Sijsling, Voight, "Rigorous computation of the endomorphism ring of a Jacobian"
(2019), section 2.
Cohen, "A course in computational algebraic number theory" (1993), section 2.6.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import flint
import numpy as np

from igl_periods.arrays import Ints
from igl_periods.recognition import scaled_lattice
from igl_periods.siegel import cholesky

# Bits that are used: more take longer, and true solutions are small.
_MOST_BITS = {1: 400, 2: 400, 3: 200, 4: 110, 5: 80}
_LEAST_BITS_USED, _BITS_AT_LARGE_GENUS = 16, 64
# Solutions are so much smaller, on a logarithmic scale, than what chance gives.
_SMALL = 0.6
# Gram–Schmidt vectors are enclosed up to this many unknowns.
_LARGEST_PROVED = 64
# Logarithms are rounded to double precision.
_ROUNDING = 1e-6
_LOG10_2 = math.log10(2.0)


@dataclass(frozen=True, eq=False)
class CommutingMatrices:
    """What LLL finds of the integer matrices that commute with a complex structure.

    Attributes
    ----------
    basis : (r, 2g, 2g) int
        A basis of all that are in the rational span of those found.
    bits : int
        Bits of the entries of Π that were used.
    excluded : float
        Logarithm of a norm (root of the sum of squares of the entries): proved, all others are
        larger.  −∞ where that was not computed.
    """

    basis: Ints
    bits: int
    excluded: float

    def __repr__(self) -> str:
        return f"CommutingMatrices(rank {len(self.basis)}, from {self.bits} bits)"

    @property
    def random_height(self) -> float:
        """Logarithm of the entries that chance gives."""
        return _LOG10_2 * self.bits / 2

    @property
    def left_over(self) -> float:
        """Digits that speak for the worst of the basis: minus log of expected coincidences."""
        unknowns = self.basis[0].size
        height = math.log10(2 * int(np.abs(self.basis).max(initial=1)) + 1)
        return unknowns * (self.random_height - height)


def commuting_matrices(Pi: flint.acb_mat, known_bits: int) -> CommutingMatrices:
    """Find the integer matrices M with A (1 Π) = (1 Π) M for a complex matrix A.

    Parameters
    ----------
    Pi : (g, g) acb_mat
        A point of the Siegel upper half-space, reduced.
    known_bits : int
        What is known of its entries, relative to the largest one.

    Raises
    ------
    ValueError
        If too little is known of it: less than 16 bits.
    """
    g = Pi.nrows()
    # The equations are quadratic in Π, and their errors those of Π times its size.
    size = max(1.0, max((float(abs(z.mid())) for z in Pi.entries()), default=1.0))
    lost = 4 + 2 * math.log2(size) + math.log2(4 * g)
    bits = min(int(known_bits - lost), _MOST_BITS.get(g, _BITS_AT_LARGE_GENUS))
    if bits < _LEAST_BITS_USED:
        raise ValueError(
            f"{known_bits} bits of the period matrix are known: too few to tell endomorphisms from "
            f"coincidences. At least {math.ceil(_LEAST_BITS_USED + lost)} are needed; "
            "enclose(surface, digits=30) has more"
        )
    values = equations(Pi)
    reduced = scaled_lattice(values, bits).lll()
    rows = [[int(x) for x in row[: 4 * g * g]] for row in reduced.tolist()]
    small = _SMALL * bits / 2
    found = []
    for row in rows:
        if math.log2(2 * max(map(abs, row)) + 1) > small or not _vanishes(row, values):
            break
        found.append(row)
    basis = np.array(found, dtype=np.int64).reshape(-1, 2 * g, 2 * g)
    return CommutingMatrices(basis, bits, _excluded(reduced, len(found), values, bits))


def equations(Pi: flint.acb_mat) -> list[list[flint.arb]]:
    """The real and imaginary parts of (a + Πc)Π − b − Πd for the 4g² matrices with one entry 1.

    The unknowns are the entries of M, row by row.
    """
    g = Pi.nrows()
    P = Pi.tolist()
    zero = flint.acb(0)
    values = []
    for row in range(2 * g):
        for column in range(2 * g):
            left = [flint.acb(int(i == row)) if row < g else P[i][row - g] for i in range(g)]
            if column < g:  # a or c: the entry meets Π from the left
                right = P[column]
            else:
                right = [flint.acb(-int(j == column - g)) for j in range(g)]
            entries = [x * y if x != 0 and y != 0 else zero for x in left for y in right]
            values.append([part for z in entries for part in (z.real, z.imag)])
    return values


def _vanishes(row: list[int], values: list[list[flint.arb]]) -> bool:
    sums = [flint.arb(0)] * len(values[0])
    for n, value in zip(row, values, strict=True):
        if n:
            sums = [s + n * x for s, x in zip(sums, value, strict=True)]
    return all(s.contains(0) for s in sums)


def _excluded(
    reduced: flint.fmpz_mat, found: int, values: list[list[flint.arb]], bits: int
) -> float:
    """Logarithm of a norm below which no solution is outside the span of the first rows."""
    n = reduced.nrows()
    if n > _LARGEST_PROVED or found == n:
        return -math.inf
    with flint.ctx.workprec(4 * bits + 20 * n):
        factor = cholesky(flint.arb_mat(reduced * reduced.transpose()))
        if factor is None:
            return -math.inf
        least = min(float(factor[i, i].log().lower()) for i in range(found, n))
        scale = flint.arb(2) ** bits
        rounding = sum(
            ((1 + scale * x.rad()) ** 2 for value in values for x in value), flint.arb(1)
        )
        logarithm = least - float(rounding.log().upper()) / 2
        return logarithm / math.log(10.0) - _ROUNDING
