r"""Rounds of flips, and what they do to closed cochains.

A flip replaces the edge AB between the triangles ABp and BAq by the diagonal from p to q.  A closed
cochain c has on it the sum of its values on the way around,

.. math:: c(qp) = c(qA) + c(Ap) = c(qB) + c(Bp),

so that nothing but the flipped edges changes, and cohomology classes stay what they are.  Flips of
one round share no face: they commute, and are carried out at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, vstack

from igl_periods.arrays import Ints

_COCHAINS_AT_ONCE = 32


@dataclass(frozen=True, eq=False, repr=False)
class Flips:
    """One round of flips: the edges flipped, and the cochain on each in terms of its sides.

    ``c[edge] = first_sign c[first] + second_sign c[second]`` for every closed cochain c.  Seen
    along the old edge from A to B, with p on its left and q on its right, the sides are
    ``first`` A q, ``second`` p A, ``third`` B p and ``fourth`` q B.
    """

    edge: Ints
    first: Ints
    first_sign: NDArray[np.int8]
    second: Ints
    second_sign: NDArray[np.int8]
    third: Ints
    fourth: Ints

    def __repr__(self) -> str:
        return f"Flips({self.edge.size} edges)"

    @classmethod
    def union(cls, portions: list[Flips]) -> Flips:
        """Flips that share no face, as one round."""
        columns = zip(*(vars(flips).values() for flips in portions))
        return cls(*(np.concatenate(column) for column in columns))


def transport(cochains: csr_array, rounds: list[Flips]) -> csr_array:
    """Values of closed cochains after the flips; (k, n_edges) sparse int."""
    if not rounds:
        return cochains
    portions = [
        _carried(cochains[start : start + _COCHAINS_AT_ONCE], rounds)
        for start in range(0, max(cochains.shape[0], 1), _COCHAINS_AT_ONCE)
    ]
    return csr_array(vstack(portions, format="csr"))


def _carried(cochains: csr_array, rounds: list[Flips]) -> csr_array:
    """A few cochains after the flips, by a table of their values on the edges they have met."""
    by_edge = cochains.T.tocsr()
    met = np.flatnonzero(np.diff(by_edge.indptr))
    # Row 0 is for all edges on which the cochains are 0.
    values = np.zeros((met.size + 1, cochains.shape[0]), dtype=cochains.dtype)
    values[1:] = by_edge[met].toarray()
    row = np.zeros(cochains.shape[1], dtype=np.int64)
    row[met] = np.arange(1, met.size + 1)
    for flips in rounds:
        first, second = row[flips.first], row[flips.second]
        near = np.flatnonzero((first > 0) | (second > 0) | (row[flips.edge] > 0))
        sums = (
            flips.first_sign[near, None] * values[first[near]]
            + flips.second_sign[near, None] * values[second[near]]
        )
        edge = flips.edge[near]
        known = row[edge] > 0
        values[row[edge[known]]] = sums[known]
        row[edge[~known]] = np.arange(len(values), len(values) + np.count_nonzero(~known))
        values = np.concatenate([values, sums[~known]])
    met = np.flatnonzero(row)
    found = csr_array(values[row[met]].T).tocoo()
    return csr_array((found.data, (found.row, met[found.col])), shape=cochains.shape)
