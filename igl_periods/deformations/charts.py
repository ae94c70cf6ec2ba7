r"""What may move, and in which norm: vertices, or lengths.

A chart writes the surfaces near a given one as vectors x, 0 for the given one, with a norm
:math:`|dx|^2 = dx^T N\, dx` that is measured on the surface at x.  The shortest dx with J dx = r is
:math:`N^{-1} J^T (J N^{-1} J^T)^{-1} r`, so all that is needed of N is its inverse.

* **Vertices**: x holds their displacements.  N is the *mass norm*, a third of the areas of the
  faces at each vertex, relative to the whole area, plus s² times the Dirichlet energy,
  :math:`\int |dX|^2 / A + s^2 \int |\nabla dX|^2`.  The first alone (s = 0) allows ripples, which
  change the conformal structure at little cost; the second measures how much the surface is
  strained, which distributes the strain like the quadratic differentials of Π.
  Displacements may be restricted to combinations of given functions at the vertices.
* **Lengths**: x holds the :math:`\log (l_e / l_e^0)`, so that lengths stay positive.  N measures
  how the metric is strained, :math:`\int \operatorname{tr} \epsilon^2 / A`; thin triangles are
  stiff.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse
from scipy.sparse import csc_array, csc_matrix, csr_array

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import (
    DeltaComplex,
    cotan_weights,
    cotangents,
    edge_directions,
    edge_lengths,
    intrinsic_delaunay,
    with_edge_lengths,
    with_positions,
)
from igl_periods.errors import ComplexError
from igl_periods.harmonic import (
    face_areas,
    factor,
    laplacian,
    side_vectors,
    solve,
    spread_to_vertices,
)
from igl_periods.options import checked_number, checked_switch
from igl_periods.periods import Gradient

from .crossings import passes_through_itself
from .repulsion import Repulsion

# The length of bending in the norm of descents, in square roots of the area.
_BENDING = 0.3


class Chart(Protocol):
    """Coordinates of surfaces near a given one, and a norm of their changes."""

    def start(self) -> Floats:
        """The coordinates of the given surface, 0; (N,)."""

    def surface(self, x: Floats) -> DeltaComplex:
        """The surface at x; ComplexError where there is none."""

    def rows(self, K: DeltaComplex, gradient: Gradient) -> Floats:
        """Gradients (c, …) at the surface K as gradients by x; (c, N)."""

    def raised(self, K: DeltaComplex, rows: Floats) -> Floats:
        """N⁻¹ at the surface K applied to every row; (c, N)."""

    def strain(self, K: DeltaComplex, dx: Floats) -> float:
        """The largest relative change of an edge, about, as x moves by dx."""


@dataclass(frozen=True, eq=False)
class VertexChart:
    """Vertices move, freely or by combinations of given functions in each coordinate of space."""

    given: DeltaComplex
    smoothing: float
    basis: Floats | None = None  # (n, k)
    embedded: bool = False
    repulsion: Repulsion | None = None

    @classmethod
    def of(
        cls, K: DeltaComplex, functions: ArrayLike | None, smoothing: float, embedded: bool = False
    ) -> VertexChart:
        """The chart around a surface with positions, for functions (n, k) at its vertices.

        Raises
        ------
        ValueError
            If the functions have another shape, are not finite, or are linearly dependent; if the
            smoothing is negative; or if the surface is to stay embedded and is not.
        ComplexError
            If there are no positions.
        """
        edge_directions(K)
        smoothing = checked_number("smoothing", smoothing)
        if not 0.0 <= smoothing < np.inf:
            raise ValueError(f"smoothing = {smoothing}: it is a number from 0 on.")
        if checked_switch("embedded", embedded) and _meets_itself(K):
            raise ValueError("the surface passes through itself: leave embedded=True away.")
        if functions is None:
            return cls(K, smoothing, None, embedded)
        B = np.asarray(functions, dtype=np.float64)
        if B.ndim != 2 or len(B) != K.n_vertices or not np.isfinite(B).all():
            raise ValueError(
                f"a basis of displacements is a finite array of shape ({K.n_vertices}, k), a "
                f"function on the vertices in each column; not {B.shape}."
            )
        if np.linalg.matrix_rank(B) < B.shape[1]:
            raise ValueError("the functions of the basis are linearly dependent, or nearly.")
        return cls(K, smoothing, B, embedded)

    def repelling(self) -> VertexChart:
        """The same, in a norm of second order, for descents of :meth:`energy`."""
        return replace(self, repulsion=Repulsion.of(self.given))

    def energy(self, K: DeltaComplex) -> tuple[float, Floats]:
        """The Φ of the surface K, and its gradient by x; (N,)."""
        assert self.repulsion is not None and K.positions is not None
        energy, by_vertex = self.repulsion(K.positions)
        return energy, self._restricted(by_vertex).ravel()

    def start(self) -> Floats:
        """No displacement."""
        n, d = np.shape(self._positions)
        return np.zeros(d * (n if self.basis is None else self.basis.shape[1]))

    def surface(self, x: Floats) -> DeltaComplex:
        """The mesh with its vertices displaced."""
        moved = with_positions(self.given, self._positions + self._displacement(x))
        if self.embedded and _meets_itself(moved):
            raise ComplexError("the surface would pass through itself.")
        return moved

    def rows(self, K: DeltaComplex, gradient: Gradient) -> Floats:
        """Gradients by vertices, restricted to the functions of the basis."""
        assert gradient.vertices is not None
        by_vertex = self._restricted(gradient.vertices)
        return np.asarray(by_vertex.reshape(len(by_vertex), -1))

    def raised(self, K: DeltaComplex, rows: Floats) -> Floats:
        """The norm is that of :func:`displacement_norm`, the same in each coordinate."""
        bending = 0.0 if self.repulsion is None else _BENDING
        norm, d = displacement_norm(K, self.smoothing, bending), self._positions.shape[1]
        columns = rows.reshape(len(rows), -1, d).transpose(1, 0, 2)
        load = columns.reshape(len(columns), -1)
        if self.basis is None:
            solved = solve(factor(csc_matrix(sparse.tril(norm))), load)
        else:
            solved = np.linalg.solve(self.basis.T @ (norm @ self.basis), load)
        return np.asarray(solved.reshape(columns.shape).transpose(1, 0, 2).reshape(rows.shape))

    def strain(self, K: DeltaComplex, dx: Floats) -> float:
        """How much the ends of an edge move apart or turn, relative to its length."""
        moved = self._displacement(dx)
        tail, head, _ = edge_directions(K)
        relative = np.linalg.norm(moved[head] - moved[tail], axis=1) / edge_lengths(K)
        return float(relative.max())

    @property
    def _positions(self) -> Floats:
        assert self.given.positions is not None
        return self.given.positions

    def _restricted(self, by_vertex: Floats) -> Floats:
        return by_vertex if self.basis is None else np.asarray(self.basis.T @ by_vertex)

    def _displacement(self, x: Floats) -> Floats:
        coefficients = x.reshape(-1, self._positions.shape[1])
        return coefficients if self.basis is None else np.asarray(self.basis @ coefficients)


@dataclass(frozen=True, eq=False)
class LengthChart:
    """The lengths of edges move."""

    given: DeltaComplex

    def start(self) -> Floats:
        """The lengths as they are."""
        return np.zeros(self.given.n_edges)

    def surface(self, x: Floats) -> DeltaComplex:
        """The triangulation with the lengths times eˣ."""
        return with_edge_lengths(self.given, edge_lengths(self.given) * np.exp(x))

    def rows(self, K: DeltaComplex, gradient: Gradient) -> Floats:
        """Gradients by the logarithms of the lengths."""
        return gradient.lengths * edge_lengths(K)

    def raised(self, K: DeltaComplex, rows: Floats) -> Floats:
        """The norm is that of :func:`strain_norm`."""
        return solve(factor(csc_matrix(sparse.tril(strain_norm(K)))), rows.T).T

    def strain(self, K: DeltaComplex, dx: Floats) -> float:
        """The largest eigenvalue of ε."""
        traces, mu = _strains(K)
        sides = dx[K.edge]
        trace, shear = (np.sum(part * sides, axis=1) for part in (traces, mu))
        return float((0.5 * np.abs(trace) + np.abs(shear)).max())


def _meets_itself(K: DeltaComplex) -> bool:
    """In R³; ValueError elsewhere."""
    assert K.positions is not None
    if K.positions.shape[1] != 3:
        raise ValueError("embedded=True is for surfaces in R³.")
    return passes_through_itself(K.positions, K.corner_vertex)


def strain_norm(K: DeltaComplex) -> csc_array:
    """The matrix of ∫ tr ε² / A in the logarithms of lengths; (n_edges, n_edges) sparse."""
    traces, mu = _strains(K)
    by_face = 0.5 * traces[:, :, None] * traces[:, None, :]
    by_face += 2.0 * (mu[:, :, None] * mu[:, None, :].conj()).real
    area = face_areas(K)
    by_face *= (area / area.sum())[:, None, None]
    rows, columns = np.broadcast_arrays(K.edge[:, :, None], K.edge[:, None, :])
    entries = (by_face.ravel(), (rows.ravel(), columns.ravel()))
    return csc_array(entries, shape=(K.n_edges, K.n_edges))


def _strains(K: DeltaComplex) -> tuple[Floats, Complexes]:
    """The trace of ε and μ of each face per logarithm of each side; (m, 3) both."""
    E = side_vectors(K.lengths)
    area = face_areas(K)
    traces = K.lengths**2 * cotangents(K.lengths) / (2.0 * area[:, None])
    return traces, (E.prod(axis=1) / (8.0 * area**2))[:, None] * E.conj()


def displacement_norm(K: DeltaComplex, smoothing: float, bending: float = 0.0) -> csc_array:
    """The matrix of the norm of displacements, one coordinate at a time; (n, n) sparse.

    The square of the mass norm, plus ``smoothing``² times that of gradients, plus ``bending``⁴
    times that of Laplacians, in units of the whole area.
    """
    flipped, _ = intrinsic_delaunay(K, csr_array((0, K.n_edges), dtype=np.int64))
    area = face_areas(flipped)
    mass = spread_to_vertices(flipped, area) / area.sum()
    L = laplacian(flipped, cotan_weights(flipped))
    norm = sparse.diags_array(mass) + smoothing**2 * L
    if bending > 0.0:
        norm = norm + bending**4 * (L @ sparse.diags_array(1.0 / mass) @ L)
    return csc_array(norm)
