r"""The lengths of a polyhedral surface, as balls of any precision.

A proof is about one surface, so it must be said which.  There are three ways:

* a complex that carries ``exact_lengths``, a function of the precision in bits, *is* the surface
  with these lengths: √2 is √2, whatever double stands in ``lengths``;
* from positions V the lengths are square roots of sums of squares, and the positions are exact as
  they are stored: integers, fractions, or doubles, every one of which is a rational number;
* otherwise the stored doubles are the lengths, exactly.

Lengths are functions of the precision (:mod:`igl_periods.complexes.exact_lengths`).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import flint
import numpy as np
from numpy.typing import ArrayLike, NDArray

from igl_periods.arrays import Ints, ReadOnlyArrays
from igl_periods.complexes import DeltaComplex, ExactLengths
from igl_periods.errors import ComplexError

_AGREEMENT = 1e-6


@dataclass(frozen=True)
class StoredLengths:
    """Doubles, as the rational numbers that they are; one for each edge."""

    lengths: tuple[float, ...]

    def __call__(self, bits: int) -> list[flint.arb]:
        """The lengths of the edges."""
        return [flint.arb(length) for length in self.lengths]


@dataclass(frozen=True, eq=False)
class Distances(ReadOnlyArrays):
    """Distances of points with rational coordinates, one for each edge.

    Attributes
    ----------
    positions : (n, d) array of float, int or Fraction
    ends : (n_edges, 2) int
        Rows of ``positions``.
    """

    positions: NDArray[Any]
    ends: Ints

    def __call__(self, bits: int) -> list[flint.arb]:
        """The lengths of the edges."""
        # Differences of doubles have up to 2,100 bits where magnitudes differ as much as they can;
        # rounded to a few more bits than are asked for they lose nothing that is needed.
        with flint.ctx.workprec(bits + 16):
            rows = [[_exact(x) for x in row] for row in self.positions.tolist()]
            return [
                sum(((a - b) * (a - b) for a, b in zip(rows[i], rows[j])), flint.arb(0)).sqrt()
                for i, j in self.ends.tolist()
            ]


def distances(V: ArrayLike, K: DeltaComplex) -> Distances:
    """The exact lengths of the edges of a mesh, from its positions as they are.

    Parameters
    ----------
    V : (n, d) array-like
        The positions that ``K`` was made from; integers and fractions are taken as they are.
    K : DeltaComplex
        Its ``labels`` are rows of ``V``.
    """
    ends = np.empty((K.n_edges, 2), dtype=np.int64)
    for s in range(3):
        forward = K.sign[:, s] > 0
        tail, head = K.corner_vertex[:, (s + 1) % 3], K.corner_vertex[:, (s + 2) % 3]
        ends[K.edge[forward, s]] = np.stack([tail, head], axis=1)[forward]
    return Distances(np.asarray(V)[K.labels], ends)


def lengths_of(K: DeltaComplex) -> ExactLengths:
    """The function that gives the exact lengths of the edges of a complex."""
    if K.exact_lengths is not None and K.mollification == 0.0:
        return K.exact_lengths
    stored = np.empty(K.n_edges)
    stored[K.edge.ravel()] = K.lengths.ravel()
    return StoredLengths(tuple(stored.tolist()))


def checked_balls(exact: ExactLengths, K: DeltaComplex, bits: int) -> list[flint.arb]:
    """The lengths of the edges at some precision, one ball for each.

    Raises
    ------
    ComplexError
        If there are not as many as there are edges, or they are not the lengths that the complex
        has in floating point.
    """
    balls = list(exact(bits))
    if len(balls) != K.n_edges:
        raise ComplexError(f"exact_lengths gives {len(balls)} lengths for {K.n_edges} edges.")
    stored = np.empty(K.n_edges)
    stored[K.edge.ravel()] = K.lengths.ravel()
    found = np.array([float(ball.mid()) for ball in balls])
    wrong = np.flatnonzero(~(np.abs(found - stored) <= _AGREEMENT * stored))
    if wrong.size:
        e = int(wrong[0])
        raise ComplexError(
            f"exact_lengths says that edge {e} has length {found[e]:.17g}, and the complex says "
            f"{stored[e]:.17g}: they are lengths of different surfaces."
        )
    return balls


def _exact(x: Any) -> flint.arb:
    return _rational(x) if isinstance(x, Fraction) else flint.arb(x)


def _rational(x: Fraction) -> flint.arb:
    return flint.arb(flint.fmpq(x.numerator, x.denominator))
