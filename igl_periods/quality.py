r"""How good a mesh is for a period matrix, and what limits the accuracy.

The bound of a period matrix from piecewise linear forms is a sum over the faces of the intrinsic
Delaunay triangulation (:mod:`igl_periods.energy_excess`).  So the question what is wrong with a
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

from .delaunay import delaunay_flips, transport
from .delta_complex import DeltaComplex, cone_angles, cotan_weights
from .energy_excess import energy_excess
from .face_forms import spread_to_vertices
from .harmonic import dirichlet_matrix, harmonic_potentials
from .homology import cohomology_basis
from .mesh_facts import counted
from .triangles import angles

Floats = NDArray[np.float64]

# Angles below this count as thin; a vertex above this angle slows the convergence down visibly.
_THIN = np.radians(10.0)
_WIDE = 2.5 * np.pi
# A part of the bound worth a remark, and of the faces that counts as few.
_REMARKABLE, _FEW = 0.25, 0.05
# Weights that are 0 but for rounding, on edges of cocircular triangles.
_COCIRCULAR = 1e-12


@dataclass(frozen=True, eq=False)
class MeshQuality:
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
        held = np.cumsum(np.sort(self.excess)[::-1])
        return 1 + int(np.searchsorted(held, 0.5 * held[-1]))


def mesh_quality(K: DeltaComplex) -> MeshQuality:
    """Measure what decides about the accuracy of the period matrix.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.

    Raises
    ------
    ComplexError
        If it is not.
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
        near_cone=np.asarray((theta > _WIDE)[L.corner_vertex].any(axis=1)),
    )


def advice(quality: MeshQuality) -> list[str]:
    """What limits the accuracy, and what to do about it; one sentence or two each."""
    if quality.symplectic_eigenvalues.size == 0:
        return ["The surface is a sphere: there are no periods, and nothing limits them."]
    lines = [
        f"The period matrix of this polyhedral surface is known to within {quality.bound:.2g}, "
        "relative to its size, from linear functions on its triangles.",
        *(_causes(quality) or [_no_cause(quality)]),
    ]
    if quality.half_of_the_bound < _FEW * quality.excess.size:
        lines.append(
            f"Half of the bound originates in {quality.half_of_the_bound} of "
            f"{quality.excess.size} triangles: refining just those places will lower it."
        )
    if quality.flips:
        lines.append(
            f"{quality.non_delaunay_edges} of {quality.weights.size} edges of the mesh are not "
            f"Delaunay; {counted(quality.flips, 'flip', 'flips')} mended that, at no cost to the "
            "surface."
        )
    if quality.mollification:
        lines.append(
            f"Some triangles are degenerate: {quality.mollification:.3g} was added to the length "
            "of every edge, and the bound is about that surface."
        )
    return lines


def _causes(quality: MeshQuality) -> list[str]:
    """Thin triangles and wide vertices, where they have a remarkable part in the bound."""
    causes = []
    thin = quality.delaunay_angles.min(axis=1) < _THIN
    if quality.part(thin) > _REMARKABLE:
        causes.append(
            f"{quality.part(thin):.0%} of that comes from "
            f"{counted(int(np.count_nonzero(thin)), 'triangle', 'triangles')} with an angle below "
            "10° in every triangulation on these vertices. Vertices spread more evenly would do "
            "better."
        )
    if quality.part(quality.near_cone) > _REMARKABLE:
        theta = quality.cone_angles
        wide = counted(int(np.count_nonzero(theta > _WIDE)), "vertex", "vertices")
        causes.append(
            f"{quality.part(quality.near_cone):.0%} of that comes from around {wide} of total "
            f"angle above 450°, the largest {np.degrees(theta.max()):.0f}°. There the bound falls "
            f"only like h^{_rate(quality):.2g} with the size h of the triangles; local refinement, "
            "or degree ≥ 2 with its conical elements, restores the full order."
        )
    return causes


def _no_cause(quality: MeshQuality) -> str:
    return (
        "Neither thin triangles nor vertices of large total angle are to blame: the mesh is as "
        "coarse as it is. Functions of higher degree lower the bound fastest; it falls like "
        f"h^{_rate(quality):.2g} with the size h of the triangles of a finer triangulation of the "
        "same surface."
    )


def _rate(quality: MeshQuality) -> float:
    """The exponent of h with which the bound falls in the end."""
    return min(2.0, 4.0 * np.pi / float(quality.cone_angles.max()))
