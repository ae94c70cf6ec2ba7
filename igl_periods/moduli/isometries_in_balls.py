r"""Isometries of lattices that respect a symplectic form, decided in balls.

The forms G₁ and G₂ are known in balls, and wanted are all integer U for which U G₁ Uᵀ = G₂ is
possible, that is, for which the two matrices of balls overlap, and U J Uᵀ = J.  It is the search of
:mod:`~igl_periods.moduli.lattice_isometries` without a tolerance: a row of U is an integer x whose
length x G₁ xᵀ overlaps the one it should have, and two rows pair as they should if the balls
overlap.  If nothing is found, no matrices in the balls are isometric; that is a proof.

The vectors x are enumerated as Fincke and Pohst do it, with G₁ = L Lᵀ in balls: in

.. math:: x\, G_1 x^T = \sum_j \Big( \sum_{i \ge j} L_{ij} x_i \Big)^2 \le r

the last coordinate is bounded, then the one before it, and so on, each rounded outwards.

References
----------
Fincke, Pohst, "Improved methods for calculating vectors of short length in a lattice" (1985).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import flint
import numpy as np

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.errors import EnumerationLimitError, NotASiegelPointError
from igl_periods.siegel import cholesky
from igl_periods.symplectic import product, standard_form, unimodular_inverse

from .lattice_isometries import assignments, reduced_basis

# Partial vectors tried before an enumeration counts as too large.
VECTOR_LIMIT = 500_000
# Enough for deciding which vectors are tried: the balls contain the exact numbers anyway.
_PRECISION_OF_BOUNDS = 64


def ball_isometries(G1: flint.arb_mat, G2: flint.arb_mat) -> Iterator[Ints]:
    """Enumerate all integer U with U J Uᵀ = J for which U G₁ Uᵀ and G₂ overlap.

    Computed with the working precision, ``flint.ctx.prec``.

    Parameters
    ----------
    G1, G2 : (2g, 2g) arb_mat
        Symmetric, positive definite, g ≥ 1; the search is fast where they are nearly reduced.

    Raises
    ------
    NotASiegelPointError
        If G₁ is not positive definite for all matrices in its balls.
    EnumerationLimitError
        If there are too many short vectors, or too many partial maps had to be tried.
    """
    J = standard_form(G1.nrows() // 2)
    V1, V2 = reduced_basis(_in_floats(G1)), reduced_basis(_in_floats(G2))
    problem = _BallProblem(_in_basis(V1, G1), _in_basis(V2, G2), V1 @ J @ V1.T, V2 @ J @ V2.T)
    back = unimodular_inverse(V2)
    for W in assignments(problem):
        yield product(back, product(W, V1))


def short_vectors_in_balls(G: flint.arb_mat, bound: flint.arb) -> Ints:
    """All integer x for which x G xᵀ ≤ ``bound`` is possible, and perhaps a few others; (N, n).

    Raises
    ------
    NotASiegelPointError
        If G is not positive definite for all matrices in its balls.
    EnumerationLimitError
        If there are too many.
    """
    n = G.nrows()
    with flint.ctx.workprec(_PRECISION_OF_BOUNDS):
        L = cholesky(G)
        if L is None:
            raise NotASiegelPointError(
                "the balls are so large that the energies need not be positive definite: ask for "
                "more digits"
            )
        columns = L.transpose().tolist()
        found: list[list[int]] = []
        stack = [([0] * n, n - 1, bound.upper())]
        for _ in range(VECTOR_LIMIT):
            if not stack:
                return np.array(found, dtype=np.int64).reshape(-1, n)
            x, j, room = stack.pop()
            column = columns[j]
            known = sum((column[i] * x[i] for i in range(j + 1, n) if x[i]), flint.arb(0))
            radius = room.sqrt()
            low = _integer(((-known - radius) / column[j]).lower().ceil())
            high = _integer(((-known + radius) / column[j]).upper().floor())
            for value in range(low, high + 1):
                part = column[j] * value + known
                rest = (room - part * part).upper()
                if rest < 0:
                    continue
                longer = [*x[:j], value, *x[j + 1 :]]
                if j == 0:
                    found.append(longer)
                else:
                    stack.append((longer, j - 1, rest))
    raise EnumerationLimitError(
        f"more than {VECTOR_LIMIT} partial vectors in the enumeration of vectors with square at "
        f"most {float(bound.mid()):.6g}"
    )


@dataclass(frozen=True, eq=False)
class _BallProblem:
    """Two lattices with symmetric forms G in balls and skew forms M."""

    G1: flint.arb_mat
    G2: flint.arb_mat
    M1: Ints
    M2: Ints

    def images(self) -> list[Ints]:
        """For each basis vector of the second lattice, the vectors of its length in the first."""
        lengths = [self.G2[k, k] for k in range(self.G2.nrows())]
        vectors = short_vectors_in_balls(self.G1, max(x.upper() for x in lengths))
        values = _squares(vectors, self.G1)
        return [
            vectors[np.array([value.overlaps(length) for value in values], dtype=bool)]
            for length in lengths
        ]

    def fitting(self, k: int, image: Ints) -> Callable[[int, Ints], Bools]:
        """The test whether candidates for row j pair with the image of row k as they should."""
        energy = self.G1 * flint.arb_mat([[x] for x in image.tolist()])
        skew = self.M1 @ image

        def fits(j: int, candidates: Ints) -> Bools:
            right: Bools = candidates @ skew == self.M2[j, k]
            rows = np.flatnonzero(right)
            if rows.size:
                pairings = flint.arb_mat(candidates[rows].tolist()) * energy
                wanted = self.G2[j, k]
                right[rows] = [value.overlaps(wanted) for value in pairings.entries()]
            return right

        return fits


def _squares(vectors: Ints, G: flint.arb_mat) -> list[flint.arb]:
    """X G xᵀ for each row x."""
    if not len(vectors):
        return []
    images = (flint.arb_mat(vectors.tolist()) * G).tolist()
    return [
        sum((y * x for y, x in zip(image, row) if x), flint.arb(0))
        for image, row in zip(images, vectors.tolist())
    ]


def _in_basis(V: Ints, G: flint.arb_mat) -> flint.arb_mat:
    change = flint.arb_mat(V.tolist())
    return change * G * change.transpose()


def _in_floats(G: flint.arb_mat) -> Floats:
    return np.array([float(x.mid()) for x in G.entries()]).reshape(G.nrows(), G.ncols())


def _integer(x: flint.arb) -> int:
    return int(x.mid().fmpz())
