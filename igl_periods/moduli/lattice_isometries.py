r"""Isometries of lattices that respect a symplectic form, up to a tolerance.

A symmetric positive definite G makes Z^{2g} a lattice, with the symplectic form J beside it.
Wanted are all integer U with

.. math:: e^{-t} G_2 \le U G_1 U^T \le e^t G_2, \qquad U J U^T = J .

In an LLL-reduced basis v_1, …, v_{2g} of the second lattice, symplectic or not, all lengths are
small.  The image of v_k is one of finitely many vectors of nearly the same length in the first
lattice; these are enumerated.  Given images of some v_i, their pairings with the image of v_k must
be nearly right with G and exactly right with J, which leaves few; this is a backtracking search
that filters the candidates of all remaining rows after each choice.

Nothing is lost: with c = e^t the first condition implies
:math:`|U G_1 U^T - G_2|_{ij} \le (c - 1) \sqrt{G_{2,ii} G_{2,jj}}` in every basis, which is what
is used on the way, and it is checked itself at the end.

References
----------
Plesken, Souvignier, "Computing isometries of lattices" (1997).
Fincke, Pohst, "Improved methods for calculating vectors of short length in a lattice" (1985).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import scipy.linalg

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.errors import (
    EnumerationLimitError,
    NotASiegelPointError,
    NotPositiveDefiniteError,
)
from igl_periods.siegel import lll_basis, short_vectors
from igl_periods.symplectic import product, standard_form, unimodular_inverse

# Images of basis vectors tried before a search is given up.
SEARCH_LIMIT = 200_000


def isometries(G1: Floats, G2: Floats, tolerance: float) -> Iterator[Ints]:
    """Enumerate all integer U with U J Uᵀ = J and e^{−t} G₂ ≤ U G₁ Uᵀ ≤ e^t G₂.

    The tolerance is widened by the rounding errors of lengths, so that none is lost to them.

    Parameters
    ----------
    G1, G2 : (2g, 2g) float
        Symmetric, positive definite, g ≥ 1; the search is fast where they are nearly reduced.
    tolerance : float
        t > 0.

    Raises
    ------
    EnumerationLimitError
        If there are too many short vectors, or too many partial maps had to be tried.
    """
    J = standard_form(len(G1) // 2)
    V1, V2 = reduced_basis(G1), reduced_basis(G2)
    G1, G2 = V1 @ G1 @ V1.T, V2 @ G2 @ V2.T
    c = math.exp(tolerance) * (1 + _rounding(G1) + _rounding(G2))
    problem = _Problem(G1, G2, V1 @ J @ V1.T, V2 @ J @ V2.T, c)
    back = unimodular_inverse(V2)
    for W in assignments(problem):
        if _between(W @ G1 @ W.T, G2, c):
            yield product(back, product(W, V1))


def reduced_basis(G: Floats) -> Ints:
    """An LLL-reduced basis of the lattice with the form G, as rows."""
    try:
        return lll_basis(G)
    except NotPositiveDefiniteError as error:
        raise NotASiegelPointError(
            f"the energies of a point are {error}: it is too close to the boundary of the Siegel "
            "upper half-space to be compared"
        ) from error


def _rounding(G: Floats) -> float:
    """Relative error of lengths x G xᵀ of short vectors."""
    diagonal = np.diag(G)
    return 16 * len(G) * float(np.finfo(np.float64).eps * diagonal.max() / diagonal.min())


def _between(G: Floats, target: Floats, c: float) -> bool:
    eigenvalues = scipy.linalg.eigh(G, target, eigvals_only=True)
    return bool(eigenvalues[0] * c >= 1 and eigenvalues[-1] <= c)


class PairingProblem(Protocol):
    """What may be the image of a basis vector, and which images fit together."""

    def images(self) -> list[Ints]:
        """For each basis vector of the second lattice, its possible images in the first."""

    def fitting(self, k: int, image: Ints) -> Callable[[int, Ints], Bools]:
        """The test whether candidates for row j pair with the image of row k as they should."""


@dataclass(frozen=True)
class _Problem:
    """Two lattices with symmetric forms G and skew forms M, and the factor c of the comparison."""

    G1: Floats
    G2: Floats
    M1: Ints
    M2: Ints
    c: float

    def images(self) -> list[Ints]:
        """For each basis vector of the second lattice, the vectors of its length in the first."""
        lengths = np.diag(self.G2)
        vectors, values = short_vectors(self.G1, self.c * float(lengths.max()))
        lower, upper = values * self.c, values / self.c
        return [vectors[(lower >= length) & (upper <= length)] for length in lengths]

    def fitting(self, k: int, image: Ints) -> Callable[[int, Ints], Bools]:
        """The test whether candidates for row j pair with the image of row k as they should."""
        energy, skew = self.G1 @ image, self.M1 @ image
        allowed = (self.c - 1) * np.sqrt(self.G2[k, k] * np.diag(self.G2))

        def fits(j: int, candidates: Ints) -> Bools:
            near = np.abs(candidates @ energy - self.G2[j, k]) <= allowed[j]
            return np.asarray(near & (candidates @ skew == self.M2[j, k]))

        return fits


def assignments(problem: PairingProblem) -> Iterator[Ints]:
    """All W whose rows are images of the basis vectors with the right pairings, by backtracking."""
    images = problem.images()
    order = sorted(range(len(images)), key=lambda k: len(images[k]))
    n_tried = 0

    def extend(depth: int, candidates: list[Ints]) -> Iterator[Ints]:
        nonlocal n_tried
        if depth == len(order):
            yield np.vstack(candidates)
            return
        k = order[depth]
        for image in candidates[k]:
            n_tried += 1
            if n_tried > SEARCH_LIMIT:
                raise EnumerationLimitError(f"more than {SEARCH_LIMIT} images tried")
            fits = problem.fitting(k, image)
            rest = list(candidates)
            rest[k] = image[None]
            for j in order[depth + 1 :]:
                rest[j] = rest[j][fits(j, rest[j])]
                if not len(rest[j]):
                    break
            else:
                yield from extend(depth + 1, rest)

    yield from extend(0, images)
