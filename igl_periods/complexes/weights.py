r"""Weights of edges, and cone angles of vertices.

The cotangent weight :math:`\rho(e) = \tfrac12(\cot\alpha + \cot\beta)` is the ratio |e*| / |e| of
the dual edge, between the circumcentres of the two faces, measured on the surface; it is negative
where e is not Delaunay.  The *extrinsic* weight measures the dual edge in space, straight from one
circumcentre to the other.  It is the energy of no function on the surface.

The *cone angle* of a vertex is the sum of the angles there; the surface is flat where it is 2π.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 2.
Pinkall, Polthier, "Computing discrete minimal surfaces and their conjugates" (1993).
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.errors import ComplexError

from .delta_complex import DeltaComplex
from .gluings import first_half
from .triangles import angles, cotangents


def cone_angles(K: DeltaComplex) -> Floats:
    """Total angle at each vertex in radians, 2π where the surface is flat; shape (n_vertices,)."""
    corners = K.corner_vertex.ravel()
    return np.bincount(corners, angles(K.lengths).ravel(), K.n_vertices).astype(np.float64)


def cotan_weights(K: DeltaComplex) -> Floats:
    """The intrinsic weights ρ(e) = (cot α + cot β)/2; shape (n_edges,).

    Negative exactly on the edges that are not Delaunay.  Σ ρ(e) (df(e))² is the Dirichlet energy
    of the function that is linear on every triangle and has the values f at the vertices.
    """
    sums = np.bincount(K.edge.ravel(), cotangents(K.lengths).ravel(), K.n_edges)
    return np.asarray(0.5 * sums, dtype=np.float64)


def extrinsic_weights(K: DeltaComplex) -> Floats:
    """The extrinsic weights ‖y − y'‖/‖e‖, circumcentres measured in space; shape (n_edges,).

    The paper's naive alternative (its section 2).  It is not an energy of functions on the surface,
    so that no error bound follows from it.

    Raises
    ------
    ComplexError
        If the complex has no vertex positions.
    """
    if K.positions is None:
        raise ComplexError(
            "extrinsic weights need vertex positions, and this complex was made from lengths. "
            'Make it with DeltaComplex.from_mesh(V, F), or use weights="intrinsic".'
        )
    # The circumcentre has barycentric coordinates proportional to a² cot α.
    barycentric = K.lengths**2 * cotangents(K.lengths)
    barycentric /= barycentric.sum(axis=1, keepdims=True)
    centre = np.einsum("fs,fsd->fd", barycentric, K.positions[K.corner_vertex])
    half_edge = np.flatnonzero(first_half(K.twin))
    distance = np.linalg.norm(
        centre[half_edge // 3] - centre[K.twin.ravel()[half_edge] // 3], axis=1
    )
    weights = np.empty(K.n_edges)
    weights[K.edge.ravel()[half_edge]] = distance / K.lengths.ravel()[half_edge]
    return weights
