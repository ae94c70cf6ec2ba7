r"""Meshes of Lawson's surfaces ξ_{m,k} without symmetry: jittered, centroidal, and poor ones.

The meshes of :mod:`.lawson` have all symmetries of ξ_{m,k}, and where these determine the conformal
type the symplectic mean is exact on any of them, however coarse.  An honest test of convergence
needs meshes without symmetry.  Here every disc gets its own vertices, while discs that share a side
share its vertices:

* *jittered*: the vertices of a symmetric mesh, displaced at random along the surface;
* *centroidal Voronoi*: random sites in each disc, moved to the centroids of their Voronoi regions
  by Lloyd's iteration, and joined by a Delaunay triangulation in a chart (:mod:`.lawson_chart`);
* *poor*: random sites that stay where they are, joined by a Delaunay triangulation of the chart
  stretched in a random direction: thin triangles, and edges that are far from Delaunay.

In the first two, the inner vertices are then moved along their normals to a minimal disc.

References
----------
Du, Faber, Gunzburger, "Centroidal Voronoi tessellations" (1999).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

from .chart import DiscChart
from .disc import SIDES, check_orders, minimal_disc
from .plateau import Patch, minimal, on_sides
from .surface import boundary_numbers, discs, glued

Random = np.random.Generator
Mesh = tuple[Floats, Ints]


def lawson_surface_jittered(m: int, k: int, n: int, amplitude: float = 0.2, seed: int = 0) -> Mesh:
    """Triangulate ξ_{m,k} like :func:`lawson_surface`, with randomly displaced vertices.

    Parameters
    ----------
    m, k, n : int
        As for :func:`lawson_surface`; its default pattern is used.
    amplitude : float
        Largest displacement in units of the shortest edge at the vertex, 0 ≤ amplitude ≤ 0.4.  At
        0.2 angles stay above 30°.
    seed : int

    Returns
    -------
    V : (n_vertices, 4) float
    F : (n_faces, 3) int

    Raises
    ------
    MeshError
        If m, k < 1, n < 2, the amplitude is out of range, or a minimal disc is not found.
    """
    if not 0 <= amplitude <= 0.4:
        raise MeshError(f"amplitude = {amplitude}: take 0 <= amplitude <= 0.4.")
    rng = np.random.default_rng(seed)
    patch = minimal_disc(m, k, n)
    # By symmetry all four sides of the disc are divided alike.
    angles = patch.angles[0]
    step = np.diff(angles, prepend=0.0, append=np.pi / 2).min()
    shape = (2 * (k + 1), 2 * (m + 1), angles.size)
    sides = angles + amplitude * step * rng.uniform(-1, 1, shape)
    reach = amplitude * _shortest_edges(patch)
    patches = []
    for i, j in discs(m, k):
        P0, P1, Q0, Q1 = boundary_numbers(m, k, i, j, 0) - [0, 0, shape[0], shape[0]]
        own = np.stack([sides[(P0, P1)[a], (Q0, Q1)[b]] for a, b in SIDES])
        patches.append(minimal(_displaced(replace(patch, angles=own), reach, rng)))
    return glued(m, k, patches)


def lawson_surface_voronoi(m: int, k: int, n_vertices: int, seed: int = 0) -> Mesh:
    """Triangulate ξ_{m,k} with exactly ``n_vertices`` vertices in centroidal Voronoi position.

    Parameters
    ----------
    m, k : int
    n_vertices : int
        Enough for at least three inner vertices in each disc.
    seed : int

    Returns
    -------
    V : (n_vertices, 4) float
    F : (n_faces, 3) int

    Raises
    ------
    MeshError
        If m, k < 1, there are too few vertices, or a minimal disc is not found.
    """
    rng = np.random.default_rng(seed)
    segments, counts = _distribution(m, k, n_vertices)
    chart = DiscChart.of(m, k, segments)
    patches = []
    for count in counts:
        sites = chart.lloyd(chart.random(count, rng))
        patches.append(minimal(chart.patch(sites, stretching=np.eye(2))))
    return glued(m, k, patches)


def lawson_surface_poor(
    m: int, k: int, n_vertices: int, stretch: float = 4.0, seed: int = 0
) -> Mesh:
    """Triangulate ξ_{m,k} badly: random vertices on the surface, triangles stretched at random.

    Parameters
    ----------
    m, k : int
    n_vertices : int
        Enough for at least three inner vertices in each disc.
    stretch : float
        By which factor the chart is stretched before it is triangulated, at least 1.
    seed : int

    Returns
    -------
    V : (n_vertices, 4) float
    F : (n_faces, 3) int

    Raises
    ------
    MeshError
        If m, k < 1, stretch < 1, or there are too few vertices.
    """
    if not 1 <= stretch < np.inf:
        raise MeshError(f"stretch = {stretch}: take a factor >= 1.")
    rng = np.random.default_rng(seed)
    segments, counts = _distribution(m, k, n_vertices)
    chart = DiscChart.of(m, k, segments)
    patches = [chart.patch(chart.random(count, rng), _stretching(stretch, rng)) for count in counts]
    return glued(m, k, patches)


def lawson_segments(m: int, k: int, n_vertices: int) -> int:
    """Number of edges along each side P_i Q_j in a mesh with ``n_vertices`` random vertices."""
    return max(2, round(1.1 * np.sqrt(n_vertices / (2 * (k + 1) * (m + 1)))))


def _stretching(factor: float, rng: Random) -> Floats:
    angle = rng.uniform(0, np.pi)
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    return np.asarray(R @ np.diag([factor, 1.0]) @ R.T)


def _displaced(patch: Patch, reach: Floats, rng: Random) -> Patch:
    """Sides as their angles say, inner vertices displaced at random by at most ``reach``."""
    x = patch.x.copy()
    x[patch.n_corners : patch.n_boundary] = on_sides(patch.ends, patch.angles)
    shift = rng.normal(size=x.shape)
    shift -= np.sum(shift * x, axis=1, keepdims=True) * x
    shift *= (reach * rng.uniform(0, 1, len(x)) / np.linalg.norm(shift, axis=1))[:, None]
    x[patch.n_boundary :] += shift[patch.n_boundary :]
    return replace(patch, x=x / np.linalg.norm(x, axis=1, keepdims=True))


def _shortest_edges(patch: Patch) -> Floats:
    """Length of the shortest edge at each vertex; (n,)."""
    shortest = np.full(len(patch.x), np.inf)
    for s in range(3):
        ends = np.delete(patch.faces, s, axis=1)
        length = np.linalg.norm(patch.x[ends[:, 0]] - patch.x[ends[:, 1]], axis=1)
        np.minimum.at(shortest, ends.ravel(), np.repeat(length, 2))
    return shortest


def _distribution(m: int, k: int, n_vertices: int) -> tuple[int, list[int]]:
    """Segments per side, and the number of inner vertices of each disc."""
    check_orders(m, k)
    n_discs = 2 * (k + 1) * (m + 1)
    segments = lawson_segments(m, k, n_vertices)
    inner = n_vertices - 2 * (k + 1) - 2 * (m + 1) - 2 * n_discs * (segments - 1)
    if inner < 3 * n_discs:
        raise MeshError(
            f"{n_vertices} vertices leave {inner} for the inside of {n_discs} discs; each needs 3."
        )
    share, rest = divmod(inner, n_discs)
    return segments, [share + 1] * rest + [share] * (n_discs - rest)
