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

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from .delta_complex import DeltaComplex
from .triangles import double_areas

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Faces handled at once: few enough for the cache, enough for matrix products.
_FEWEST_AT_ONCE = 2_048
_NUMBERS_AT_ONCE = 100_000


@dataclass(frozen=True, eq=False)
class LinearForms:
    """Forms c + df on some faces, each face with a weight.

    Attributes
    ----------
    lengths : (m, 3) float
        Sides of the faces.
    corner_vertex : (m, 3) int
    scale : (m,) float or None
        Root of the weight of each face; None where all weights are 1.
    jumps : Jumps
        Values of the cochains along the sides.
    potentials : (n_vertices, k) float
        The functions f.
    """

    lengths: Floats
    corner_vertex: Ints
    scale: Floats | None
    jumps: Jumps
    potentials: Floats

    @classmethod
    def of(
        cls,
        K: DeltaComplex,
        cochains: csr_array,
        potentials: Floats,
        face_weights: Floats | None = None,
    ) -> LinearForms:
        """The forms on all faces, or on those of positive weight."""
        jumps = Jumps.of(K, cochains)
        if face_weights is None:
            return cls(K.lengths, K.corner_vertex, None, jumps, potentials)
        faces = np.flatnonzero(face_weights)
        return cls(
            K.lengths[faces],
            K.corner_vertex[faces],
            np.sqrt(face_weights[faces]),
            jumps.on(faces),
            potentials,
        )

    @property
    def n_forms(self) -> int:
        """Number of forms."""
        return self.potentials.shape[1]

    def gradients(self, block: slice) -> Floats:
        """Gradients on the faces f of a block, times √(weight · area); (2 f, k).

        First the components along side 2 of each face, then those across it.
        """
        l0, l1, l2 = self.lengths[block].T
        height = double_areas(self.lengths[block]) / l2
        # Differences of lengths first: that keeps digits on thin triangles.
        shear = 0.5 * (1.0 + ((l1 - l0) / l2) * ((l1 + l0) / l2))
        at_0, at_1, at_2 = (self.potentials[corner] for corner in self.corner_vertex[block].T)
        both = np.empty((2, *at_0.shape))
        u01, u02 = np.subtract(at_1, at_0, out=both[0]), np.subtract(at_2, at_0, out=both[1])
        # Side 2 runs from corner 0 to corner 1, side 1 from corner 2 to corner 0.
        self.jumps.add_to(u01, block.start, 2, 1)
        self.jumps.add_to(u02, block.start, 1, -1)
        along, across = np.sqrt(0.5 * height / l2), np.sqrt(0.5 * l2 / height)
        if self.scale is not None:
            along, across = along * self.scale[block], across * self.scale[block]
        u02 -= shear[:, None] * u01
        u01 *= along[:, None]
        u02 *= across[:, None]
        return both.reshape(2 * len(height), self.n_forms)


def gram_matrix(forms: LinearForms) -> Floats:
    """Energies of the forms, ∫ ω_i ∧ *ω_j; (k, k) symmetric."""
    D = np.zeros((forms.n_forms, forms.n_forms))
    for block in blocks(len(forms.lengths), forms.n_forms):
        X = forms.gradients(block)
        D += X.T @ X
    return D


def mutual_energies(one: LinearForms, two: LinearForms) -> Floats:
    """Energies ∫ ω_i ∧ *η_j of two families of forms on the same faces; (k, l)."""
    D = np.zeros((one.n_forms, two.n_forms))
    for block in blocks(len(one.lengths), max(one.n_forms, two.n_forms)):
        D += one.gradients(block).T @ two.gradients(block)
    return D


@dataclass(frozen=True, eq=False)
class Jumps:
    """The values of cochains along sides, where they are not 0, in the order of the faces."""

    face: Ints
    side: Ints
    cochain: Ints
    value: Floats

    @classmethod
    def of(cls, K: DeltaComplex, cochains: csr_array) -> Jumps:
        """The values of (k, n_edges) sparse cochains along the sides of all faces."""
        touched = np.zeros(K.n_edges, dtype=bool)
        touched[cochains.indices] = True
        half_edge = np.flatnonzero(touched[K.edge.ravel()])
        values = cochains.T.tocsr()[K.edge.ravel()[half_edge]].tocoo()
        h = half_edge[values.row]
        return cls(h // 3, h % 3, values.col, values.data * K.sign.ravel()[h])

    def on(self, faces: Ints) -> Jumps:
        """Those on some faces, ascending, numbered anew."""
        place = np.searchsorted(faces, self.face)
        mine = np.flatnonzero(np.r_[faces, -1][place] == self.face)
        return Jumps(place[mine], self.side[mine], self.cochain[mine], self.value[mine])

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
