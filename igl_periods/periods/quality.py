r"""How good a mesh is for a period matrix, and what limits the accuracy.

The bound of a period matrix from piecewise linear forms is a sum over the faces of the intrinsic
Delaunay triangulation (:mod:`igl_periods.harmonic.excess`).  So the question what is wrong with a
mesh has an exact answer: the faces in which the bound originates.  What they have in common is
one of three things.

* Nothing: the mesh is coarse, and the bound falls with the square of the size of its triangles.
* Thin triangles, which stay thin in every triangulation on the same vertices.
* Vertices of total angle θ > 2π.  Harmonic functions behave like r^(2π/θ) there, and the bound
  falls like h^min(2, 4π/θ) only.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats, ReadOnlyArrays
from igl_periods.complexes import (
    DeltaComplex,
    angles,
    cone_angles,
    cotan_weights,
    delaunay_flips,
    of_a_surface,
    transport,
)
from igl_periods.display import facts_html, rounded_up
from igl_periods.harmonic import (
    dirichlet_matrix,
    energy_excess,
    harmonic_potentials,
    most_of,
    spread_to_vertices,
)
from igl_periods.topology import cohomology_basis

WIDE = 2.5 * np.pi
# Weights that are 0 but for rounding, on edges of cocircular triangles.
_COCIRCULAR = 1e-12


@dataclass(frozen=True, eq=False)
class MeshQuality(ReadOnlyArrays):
    """What decides about the accuracy of the period matrix of a mesh.

    Attributes
    ----------
    angles : (m, 3) float
        Angles of the triangles as given, in radians.
    weights : (n_edges,) float
        Their cotangent weights ρ(e); negative on edges that are not Delaunay.
    cone_angles : (n_vertices,) float
        Total angle at each vertex, in radians.
    mollification : float
        Length that was added to all edges, as the triangles were degenerate.
    flips : int
        Flips that lead to the intrinsic Delaunay triangulation.
    delaunay_angles : (m, 3) float
        Angles of the triangles there.
    symplectic_eigenvalues : (g,) float
        d_1 ≥ … ≥ d_g of the Dirichlet matrix there.
    excess : (m,) float
        Shares of the faces of the Delaunay triangulation in d_1 − 1.
    vertex_excess : (n_vertices,) float
        The same, a third of each face at each of its corners.
    near_cone : (m,) bool
        Faces of the Delaunay triangulation at a vertex of total angle above 5π/2.
    """

    angles: Floats
    weights: Floats
    cone_angles: Floats
    mollification: float
    flips: int
    delaunay_angles: Floats
    symplectic_eigenvalues: Floats
    excess: Floats
    vertex_excess: Floats
    near_cone: NDArray[np.bool_]

    def __repr__(self) -> str:
        bound, angles = rounded_up(self.bound, 3), _degrees(self.angles)
        return f"MeshQuality(bound {bound}, angles {angles}, {self.flips} flips)"

    def _repr_html_(self) -> str:
        return facts_html("MeshQuality", self._facts())

    def _facts(self) -> list[tuple[str, str]]:
        wide = int(np.count_nonzero(self.cone_angles > WIDE))
        return [
            ("bound", rounded_up(self.bound, 3)),
            ("angles", _degrees(self.angles)),
            ("total angles", f"{_degrees(self.cone_angles)}, {wide} above 450°"),
            ("edges that are not Delaunay", str(self.non_delaunay_edges)),
            ("flips", str(self.flips)),
            ("angles after flips", _degrees(self.delaunay_angles)),
            ("half of the bound", f"in {self.half_of_the_bound} of {self.excess.size} triangles"),
            ("mollification", f"{self.mollification:.3g}"),
        ]

    @property
    def bound(self) -> float:
        """d_1 − 1, the bound of the period matrix but for rounding; 0 for genus 0."""
        d = self.symplectic_eigenvalues
        return max(float(d[0]) - 1.0, 0.0) if d.size else 0.0

    @property
    def non_delaunay_edges(self) -> int:
        """Number of edges of negative weight, beyond rounding."""
        return int(np.count_nonzero(self.weights < -_COCIRCULAR))

    def part(self, faces: NDArray[np.bool_]) -> float:
        """The part of the bound that originates in some faces of the Delaunay triangulation."""
        total = float(self.excess.sum())
        return float(self.excess[faces].sum()) / total if total > 0.0 else 0.0

    @property
    def half_of_the_bound(self) -> int:
        """The least number of faces in which half of the bound originates."""
        return len(most_of(self.excess, 0.5))


def _degrees(angles: Floats) -> str:
    """The range of some angles."""
    return f"{np.degrees(angles.min()):.3g}° to {np.degrees(angles.max()):.3g}°"


@of_a_surface
def mesh_quality(K: DeltaComplex) -> MeshQuality:
    """What the accuracy of a period matrix depends on: angles, flips, shares of the bound.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected.

    Raises
    ------
    ComplexError
        If it is not.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> K = ip.DeltaComplex.from_mesh(V, F)
    >>> ip.mesh_quality(K)
    MeshQuality(bound 0.0286, angles 27.3° to 104°, 0 flips)
    """
    cocycles = cohomology_basis(K)
    L, rounds = delaunay_flips(K)
    cochains = transport(cocycles, rounds)
    potentials = harmonic_potentials(L, cotan_weights(L), cochains)
    D = dirichlet_matrix(L, cochains, potentials)
    shares = energy_excess(L, cochains, potentials, D)
    excess = shares[0] if len(shares) else np.zeros(L.n_faces)
    theta = cone_angles(K)
    return MeshQuality(
        angles=angles(K.lengths),
        weights=cotan_weights(K),
        cone_angles=theta,
        mollification=K.mollification,
        flips=sum(flips.edge.size for flips in rounds),
        delaunay_angles=angles(L.lengths),
        symplectic_eigenvalues=1.0 + shares.sum(axis=1),
        excess=excess,
        vertex_excess=spread_to_vertices(L, excess),
        near_cone=np.asarray((theta > WIDE)[L.corner_vertex].any(axis=1)),
    )
