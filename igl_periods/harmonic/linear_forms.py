r"""Closed forms that are linear on every triangle, and the energies of their gradients.

A closed cochain c and a function f at the vertices make the form c + df on the surface: on each
triangle the one of constant coefficients that integrates to c(e) + f(head) − f(tail) along its
sides.  In the chart with corner 0 at the origin, corner 1 at (l, 0) and corner 2 at (x, y) it has
the gradient

.. math:: \Big( \frac{u_{01}}{l},\ \frac{u_{02} - u_{01}\, x / l}{y} \Big), \qquad
          u_{ij} = \text{its integral from corner } i \text{ to corner } j,

and twice the area is l y.  Energies are sums of products of these gradients over the faces, so
that a matrix of energies is a Gram matrix, X Xᵀ, of forms that are written down explicitly: it is
their energy on the surface whatever f is, up to the rounding of sums of squares.

A cochain of a tree and a cotree is 0 on nearly all edges.  Its values are kept as a list of
*jumps*, which are added to the differences of f where they occur.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, apexes, index_type
from igl_periods.machine import threads_for
from igl_periods.run_log import progress

from .grouped_sums import sum_in_groups

# Faces handled at once: few enough for the cache, enough for matrix products.
_FEWEST_AT_ONCE = 512
_NUMBERS_AT_ONCE = 100_000


@dataclass(frozen=True, eq=False)
class WeightedFaces:
    """Some faces of a surface, each counted with a weight.

    Attributes
    ----------
    lengths : (m, 3) float
    corner_vertex : (m, 3) int
        Of 32 bits where they do.
    scale : (m,) float or None
        Root of the weight of each face; None where all weights are 1.
    """

    lengths: Floats
    corner_vertex: NDArray[Any]
    scale: Floats | None = None

    @classmethod
    def of(cls, K: DeltaComplex, weights: Floats | None = None) -> WeightedFaces:
        """All faces, or those of positive weight; weights (m,)."""
        index = index_type(K.n_vertices)
        if weights is None:
            return cls(K.lengths, K.corner_vertex.astype(index))
        faces = np.flatnonzero(weights)
        corner_vertex = K.corner_vertex[faces].astype(index)
        return cls(K.lengths[faces], corner_vertex, np.sqrt(weights[faces]))


@dataclass(frozen=True, eq=False)
class LinearForms:
    """Forms c + df on some faces.

    Attributes
    ----------
    faces : WeightedFaces
    jumps : Jumps
        Values of the cochains along the sides of the faces.
    potentials : (n_vertices, k) float
        The functions f.
    """

    faces: WeightedFaces
    jumps: Jumps
    potentials: Floats

    @property
    def n_forms(self) -> int:
        """Number of forms."""
        return self.potentials.shape[1]

    def gradients(self, block: slice) -> Floats:
        """Gradients on the faces f of a block, times √(weight · area); (2 f, k).

        First the components along side 2 of each face, then those across it.
        """
        foot, height = apexes(self.faces.lengths[block])
        base = self.faces.lengths[block, 2]
        at_0, at_1, at_2 = (self.potentials[corner] for corner in self.faces.corner_vertex[block].T)
        both = np.empty((2, *at_0.shape))
        u01, u02 = np.subtract(at_1, at_0, out=both[0]), np.subtract(at_2, at_0, out=both[1])
        # Side 2 runs from corner 0 to corner 1, side 1 from corner 2 to corner 0.
        self.jumps.add_to(u01, block.start, 2, 1)
        self.jumps.add_to(u02, block.start, 1, -1)
        along, across = np.sqrt(0.5 * height / base), np.sqrt(0.5 * base / height)
        if self.faces.scale is not None:
            along, across = along * self.faces.scale[block], across * self.faces.scale[block]
        u02 -= foot[:, None] * u01
        u01 *= along[:, None]
        u02 *= across[:, None]
        return both.reshape(2 * len(height), self.n_forms)


def gram_matrix(forms: LinearForms) -> Floats:
    """Energies of the forms, ∫ ω_i ∧ *ω_j; (k, k) symmetric."""

    def on_block(block: slice) -> Floats:
        X = forms.gradients(block)
        return np.asarray(X.T @ X)

    n = forms.n_forms
    return _summed(on_block, np.zeros((n, n)), len(forms.faces.lengths), n)


def mutual_energies(one: LinearForms, two: LinearForms) -> Floats:
    """Energies ∫ ω_i ∧ *η_j of two families of forms on the same faces; (k, l)."""

    def on_block(block: slice) -> Floats:
        return np.asarray(one.gradients(block).T @ two.gradients(block))

    n, k = one.n_forms, two.n_forms
    return _summed(on_block, np.zeros((n, k)), len(one.faces.lengths), max(n, k))


def _summed(on_block: Callable[[slice], Floats], D: Floats, n_faces: int, n_forms: int) -> Floats:
    """D and the sum of energies over all blocks."""
    portions = list(blocks(n_faces, n_forms))

    def terms() -> Iterator[Floats]:
        for block in portions:
            progress("energies on faces", block.start, n_faces)
            yield on_block(block)

    # The products of one block are summed before the next one begins.
    with threads_for(4.0 * _NUMBERS_AT_ONCE * n_forms):
        return D + sum_in_groups(terms(), len(portions), D.shape)


@dataclass(frozen=True, eq=False)
class Jumps:
    """The values of cochains along sides, where they are not 0, in the order of the faces."""

    face: Ints
    side: Ints
    cochain: Ints
    value: Floats

    @classmethod
    def of(cls, K: DeltaComplex, cochains: csr_array, weights: Floats | None = None) -> Jumps:
        """The values of (k, n_edges) sparse cochains on :class:`WeightedFaces` ``.of(K, weights)``.

        Faces are numbered as there.
        """
        touched = np.zeros(K.n_edges, dtype=bool)
        touched[cochains.indices] = True
        half_edge = np.flatnonzero(touched[K.edge.ravel()])
        place = half_edge // 3
        if weights is not None:
            half_edge = half_edge[weights[place] != 0.0]
            place = (np.cumsum(weights != 0.0) - 1)[half_edge // 3]
        values = cochains.T.tocsr()[K.edge.ravel()[half_edge]].tocoo()
        h = half_edge[values.row]
        return cls(place[values.row], h % 3, values.col, values.data * K.sign.ravel()[h])

    def of_cochains(self, columns: slice) -> Jumps:
        """Those of some of the cochains, numbered anew."""
        mine = (self.cochain >= columns.start) & (self.cochain < columns.stop)
        cochain = self.cochain[mine] - columns.start
        return Jumps(self.face[mine], self.side[mine], cochain, self.value[mine])

    def add_to(self, differences: Floats, start: int, side: int, sign: int) -> None:
        """Add ``sign`` times the values along a side of the faces from ``start`` on, (faces, k)."""
        low, high = np.searchsorted(self.face, [start, start + len(differences)])
        mine = low + np.flatnonzero(self.side[low:high] == side)
        differences[self.face[mine] - start, self.cochain[mine]] += sign * self.value[mine]


def blocks(n_faces: int, n_forms: int) -> Iterator[slice]:
    """Portions for which arrays of one column a form have a good size."""
    size = max(_FEWEST_AT_ONCE, _NUMBERS_AT_ONCE // max(n_forms, 1))
    for start in range(0, n_faces, size):
        yield slice(start, min(start + size, n_faces))
