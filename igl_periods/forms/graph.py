r"""The double graph Λ = Γ ⊕ Γ* of a polyhedral surface and its quad-graph ◊.

Γ is the Delaunay tessellation of the surface: the edges e of a Delaunay triangulation whose weight
ρ(e) is positive.  An edge with ρ(e) = 0, such as the diagonal of a square, has the same
circumcentre on both sides, and separates no two faces of the tessellation.  The dual graph Γ* has
a vertex for every face of Γ and an edge e* for every edge e of Γ, which crosses it **from right to
left** and has the weight ρ(e*) = 1/ρ(e).  The dual of e* is −e.

e = (x, x') and e* = (y, y') are the diagonals of a counterclockwise quadrilateral (x, y, x', y')::

                 y'
               ↗ ↑ ↖                  e  = (x, x')  from left to right
             /   |   \                e* = (y, y')  from bottom to top
            x ——e|——→ x'              sides of the quadrilateral, directed from Γ to Γ*:
             \   |   /                (x, y), (x', y), (x', y'), (x, y')
               ↘ | ↙
                 y

The quadrilaterals are the faces of the quad-graph ◊; its vertices are those of Λ, its edges the
corners of the faces of Γ.

Arrays, with any leading axes:

==================  ======================  ======================================================
function on Λ₀      (…, n_vertices)         Γ₀ first, then Γ*₀
1-form on Λ₁        (…, 2, n_edges)         ``[0]`` on the edges e of Γ, ``[1]`` on the edges e*
2-form on Λ₂        (…, n_vertices)         a face of Λ has the index of the vertex it is dual to
1-form on ◊₁        (…, 2 n_edges)          on the sides of quadrilaterals, directed from Γ to Γ*
2-form on ◊₂        (…, n_edges)            the quadrilateral of an edge has its index
==================  ======================  ======================================================

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 2.
Mercat, "Discrete Riemann surfaces and the Ising model" (2001).
Bobenko, Springborn, "A discrete Laplace–Beltrami operator for simplicial surfaces" (2007).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Floats, Ints, ReadOnlyArrays
from igl_periods.complexes import (
    DeltaComplex,
    check_surface,
    cocircularity_allowance,
    components_of,
    cotan_weights,
    cotangents,
    forward_half_edges,
    next_corner,
    of_a_surface,
)
from igl_periods.display import facts_html
from igl_periods.errors import ComplexError

# Weights this small are rounding of 0, as they are for Delaunay flips: cotangents have a relative
# error of some ulps, and their sum is twice the weight.


@dataclass(frozen=True, eq=False)
class DoubleGraph(ReadOnlyArrays):
    """The double graph of a closed, oriented surface; made by :func:`double_graph`.

    Attributes
    ----------
    complex : DeltaComplex
        The triangulation.
    weights : (complex.n_edges,) float
        ρ ≥ 0 on all edges of the triangulation, exactly 0 on those that Γ does not have.
    edges : (n_edges,) int
        The edges of the triangulation that are edges of Γ, those with ρ > 0.
    rho : (n_edges,) float
        Their weights.
    tail, head : (2, n_edges) int
        Vertices of Λ at which the edges of Γ (row 0) and Γ* (row 1) start and end: x, y and
        x', y'.
    polygon : (m,) int
        The vertex of Λ, in Γ*, of the face of Γ that contains each triangle.
    sides : (4, n_edges) int
        The edges (x, y), (x', y), (x', y'), (x, y') of ◊ around each quadrilateral.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> K = ip.DeltaComplex.from_mesh(V, F)
    >>> graph = ip.double_graph(K)
    >>> len(graph.rho) == len(graph.edges)
    True
    """

    complex: DeltaComplex
    weights: Floats
    edges: Ints
    rho: Floats
    tail: Ints
    head: Ints
    polygon: Ints
    sides: Ints

    def __repr__(self) -> str:
        primal, dual = self.complex.n_vertices, self.n_vertices - self.complex.n_vertices
        return f"DoubleGraph({primal} vertices of Γ, {dual} of Γ*, {self.n_edges} edges of each)"

    def _repr_html_(self) -> str:
        facts = [
            ("vertices of Γ", self.complex.n_vertices),
            ("vertices of Γ*", self.n_vertices - self.complex.n_vertices),
            ("edges of Γ, of Γ*, quadrilaterals", self.n_edges),
            ("edges of the triangulation with ρ = 0", self.complex.n_edges - self.n_edges),
            ("ρ", f"{self.rho.min():.3g} to {self.rho.max():.3g}"),
        ]
        return facts_html("DoubleGraph Λ = Γ ⊕ Γ*", facts)

    @property
    def n_edges(self) -> int:
        """Number of edges of Γ, of Γ*, and of quadrilaterals."""
        return self.edges.size

    @property
    def n_vertices(self) -> int:
        """Number of vertices of Λ: those and the faces of Γ."""
        return int(self.polygon.max()) + 1


@of_a_surface
def double_graph(K: DeltaComplex, weights: ArrayLike | None = None) -> DoubleGraph:
    """The double graph of a Delaunay triangulation, or of abstract weights.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected; Delaunay
        unless weights are given.
    weights : (n_edges,) array-like, optional
        ρ ≥ 0; the intrinsic cotangent weights of ``K`` where they are not given.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected; if weights have a wrong shape, are
        not finite, or some are negative; or if so many are zero that the others do not divide
        the surface into discs.

    Notes
    -----
    A weight counts as zero up to the rounding that Delaunay flips allow for, about 1e-12.

    Examples
    --------
    The square torus of four squares: their diagonals are not edges of Γ.

    >>> from igl_periods import DeltaComplex
    >>> torus = DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=2)
    >>> graph = double_graph(torus)
    >>> torus.n_edges, graph.n_edges, graph.n_vertices
    (12, 8, 8)
    """
    check_surface(K)
    rho, allowance = _weights_and_allowance(K, weights)
    if np.any(rho < -allowance):
        raise ComplexError(
            f"{np.count_nonzero(rho < -allowance)} of {K.n_edges} weights are negative, the least "
            f"is {rho.min():.3g}: the triangulation is not Delaunay, and its double graph has no "
            "positive scalar product. Run Delaunay first: K, cocycles = "
            "igl_periods.intrinsic_delaunay(K, cocycles)."
        )
    kept = rho > allowance
    h, t = _halves(K)
    polygon = _merged_faces(K, h[~kept], t[~kept])
    corner = _merged_corners(K, h[~kept], t[~kept])
    edges = np.flatnonzero(kept)
    h, t = h[kept], t[kept]
    vertex = K.corner_vertex.ravel()
    return DoubleGraph(
        complex=K,
        weights=np.where(kept, rho, 0.0),
        edges=edges,
        rho=rho[edges],
        tail=np.stack([vertex[next_corner(h)], polygon[t // 3]]),
        head=np.stack([vertex[next_corner(h, 2)], polygon[h // 3]]),
        polygon=polygon,
        sides=corner[
            np.stack([next_corner(t, 2), next_corner(t), next_corner(h, 2), next_corner(h)])
        ],
    )


def _weights_and_allowance(K: DeltaComplex, weights: ArrayLike | None) -> tuple[Floats, Floats]:
    """The weights, and how far from 0 each may be and still be 0; (n_edges,) each."""
    if weights is None:
        size = np.bincount(K.edge.ravel(), np.abs(cotangents(K.lengths)).ravel(), K.n_edges)
        return cotan_weights(K), 0.5 * cocircularity_allowance(size.astype(np.float64))
    array = np.asarray(weights)
    if array.shape != (K.n_edges,) or array.dtype.kind not in "iuf":
        raise ComplexError(
            f"weights must be a real array of shape ({K.n_edges},), one per edge, not "
            f"{array.shape} of {array.dtype}."
        )
    rho: Floats = array.astype(np.float64)
    if not np.isfinite(rho).all():
        raise ComplexError("weights have entries that are NaN or infinite.")
    return rho, cocircularity_allowance(np.zeros_like(rho)) * np.abs(rho).max()


def _halves(K: DeltaComplex) -> tuple[Ints, Ints]:
    """Of each edge the half-edge that runs with it, its face on the left, and the other one."""
    h = forward_half_edges(K)
    return h, K.twin.ravel()[h]


def _merged_faces(K: DeltaComplex, h: Ints, t: Ints) -> Ints:
    """The vertex of Γ* of each triangle, when the triangles at the half-edges h, t are merged."""
    n, label = components_of(h // 3, t // 3, K.n_faces)
    if n != K.n_faces - h.size:
        raise ComplexError(
            f"the {h.size} edges of weight 0 separate only {K.n_faces} faces that merge to {n}, "
            "not to discs: these weights define no positive definite energy."
        )
    return K.n_vertices + label.astype(np.int64)


def _merged_corners(K: DeltaComplex, h: Ints, t: Ints) -> Ints:
    """The corner of a face of Γ, hence edge of ◊, of each corner of a triangle."""
    one = np.concatenate([next_corner(h), next_corner(h, 2)])
    other = np.concatenate([next_corner(t, 2), next_corner(t)])
    _, label = components_of(one, other, K.twin.size)
    return label.astype(np.int64)
