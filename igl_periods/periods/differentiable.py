"""What a period matrix offers of derivatives: :mod:`igl_periods.periods.derivative` as methods."""

from __future__ import annotations

from functools import cached_property

from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import DeltaComplex
from igl_periods.errors import ComplexError
from igl_periods.symplectic import estimate_derivative

from .derivative import (
    EntryCovariance,
    Gradient,
    checked_directions,
    checked_weights,
    derivative_along,
    entry_weights,
    gradient_of,
    noise_covariance,
)
from .solved_forms import SolvedForms, recomputed_forms


class Differentiable:
    """A period matrix that moves with the lengths and the vertices of its surface."""

    dirichlet: Floats
    cocycles: csr_array
    complex: DeltaComplex
    forms: SolvedForms | None

    def derivative(
        self,
        *,
        lengths: ArrayLike | None = None,
        vertices: ArrayLike | None = None,
        estimate: str = "matrix",
    ) -> Complexes:
        """How Π moves as the lengths of ``complex`` or its vertices do.

        Without kept forms (``keep_forms=True``), the first derivative solves for them once more.

        Parameters
        ----------
        lengths : (…, n_edges) array-like
            One direction or several, in the order of the edges (``complexes.edge_ends``).
        vertices : (…, n_vertices, d) array-like
            Instead of ``lengths``; rows as of ``complex.positions``.
        estimate : {"matrix", "primal", "dual", "mean"}

        Returns
        -------
        (…, g, g) complex
            :mod:`igl_periods.periods.derivative` says of what, at which degree.

        Raises
        ------
        ValueError
            If not exactly one of the directions is given, shapes are wrong, numbers are not
            finite, or there is no such estimate.
        ComplexError
            If there are no positions, or the forms were not kept and are not linear ones.
        """
        moved = checked_directions(self.complex, lengths, vertices)
        mean = estimate_derivative(self.dirichlet, estimate)
        return derivative_along(self.complex, self._solved, mean, moved)

    def gradient(self, W: ArrayLike, *, estimate: str = "matrix") -> Gradient:
        """The gradient of Re Σ W̄ Π by lengths and by vertices: ``derivative``, transposed.

        Parameters
        ----------
        W : (…, g, g) array-like
            One function or several.
        estimate : {"matrix", "primal", "dual", "mean"}

        Returns
        -------
        Gradient
            ``lengths`` (…, n_edges) and ``vertices`` (…, n_vertices, d).

        Raises
        ------
        ValueError, ComplexError
            As :meth:`derivative`.
        """
        weights = checked_weights(W, self._genus)
        mean = estimate_derivative(self.dirichlet, estimate)
        return gradient_of(self.complex, self._solved, mean, weights)

    def covariance(self, vertex_noise: ArrayLike) -> EntryCovariance:
        """How uncertain the entries of Π are if the vertices are, to first order.

        Parameters
        ----------
        vertex_noise : float, (n,), (n, d, d) or (n d, n d) array-like
            The standard deviation of every coordinate, one for each vertex; or covariances of
            positions, each vertex for itself or all together.

        Raises
        ------
        ValueError
            If it is none of these, negative, or not symmetric.
        ComplexError
            As :meth:`derivative`.
        """
        by_vertex = self.gradient(entry_weights(self._genus)).vertices
        if by_vertex is None:
            raise ComplexError("the surface has no positions, only lengths: no vertex has noise.")
        return noise_covariance(by_vertex, vertex_noise)

    @cached_property
    def _solved(self) -> SolvedForms:
        if self.forms is not None:
            return self.forms
        return recomputed_forms(self.complex, self.cocycles, self.dirichlet)

    @property
    def _genus(self) -> int:
        return len(self.dirichlet) // 2
