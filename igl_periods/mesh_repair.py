"""Make a surface of a mesh that nearly is one, and count every change.

The steps, in this order, each a function from a mesh to a mesh:

* weld vertices *of the boundary* that lie at exactly the same position.  This closes the seams of
  files that repeat vertices, and touches no surface that is closed already: sheets of an immersed
  surface may meet in a vertex and stay apart;
* drop triangles that use a vertex twice, and all but one of those with the same three vertices;
* turn triangles over until they agree, in every component that is orientable;
* split non-manifold edges, pairing the triangles that run through the edge in opposite directions
  (Guéziec et al.), and give each fan of triangles at a vertex a vertex of its own;
* optionally close boundary loops, by a cone over the loop from its centre;
* drop vertices without triangles.

No vertex moves.  Slivers and triangles of area 0 stay: dropping them would open holes.

References
----------
Guéziec, Taubin, Lazarus, Horn, "Cutting and stitching: converting sets of polygons to manifold
surfaces" (2001).
"""

from __future__ import annotations

import igl
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .errors import MeshError
from .gluing import corner_vertices, next_corner
from .mesh_facts import collapsed, glued_in_pairs, orientable_faces
from .mesh_file import compressed, first_equal_row
from .mesh_report import RepairStep
from .validation import checked_positions

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def repair_mesh(
    V: ArrayLike, F: ArrayLike, *, largest_hole: int = 0
) -> tuple[Floats, Ints, tuple[RepairStep, ...]]:
    """Weld, drop, orient, split and fill what keeps a mesh from being a surface.

    Parameters
    ----------
    V : (n, d) array-like
    F : (m, 3) array-like of int
    largest_hole : int
        Boundary loops of up to that many edges are closed; none by default.

    Returns
    -------
    V : (n', d) float
    F : (m', 3) int
    steps : tuple of RepairStep
        Every step, with the number of things that it changed.

    Raises
    ------
    MeshError
        If the coordinates are not finite, or no triangle is left.
    """
    V, F = checked_positions(V), np.asarray(F, dtype=np.int64)
    steps = []
    F, welded = _weld_boundary(V, F)
    steps.append(RepairStep("boundary vertices welded to a coincident one", welded))
    F, dropped = _drop(F, collapsed(F))
    steps.append(RepairStep("triangles dropped that used a vertex twice", dropped))
    F, dropped = _drop(F, _repeated(F))
    steps.append(RepairStep("duplicate triangles dropped", dropped))
    if len(F) == 0:
        raise MeshError("no triangle is left after repair: all of them are collapsed.")
    F, turned = _orient(F)
    steps.append(RepairStep("triangles turned over", turned))
    V, F, added = _split_edges(V, F)
    steps.append(RepairStep("vertices added by splitting non-manifold edges", added))
    V, F, added = _split_vertices(V, F)
    steps.append(RepairStep("vertices added by splitting non-manifold vertices", added))
    V, F, filled = _fill_holes(V, F, largest_hole)
    steps.append(RepairStep(f"holes of up to {largest_hole} edges filled", filled))
    used, faces = compressed(V, F)
    steps.append(RepairStep("vertices without triangles dropped", len(V) - len(used)))
    return used, faces, tuple(steps)


def _weld_boundary(V: Floats, F: Ints) -> tuple[Ints, int]:
    _, _, faces_at = glued_in_pairs(F)
    free = np.flatnonzero(faces_at.ravel() == 1)
    on_boundary = np.unique(F.ravel()[np.concatenate([next_corner(free), next_corner(free, 2)])])
    new = np.arange(len(V))
    new[on_boundary] = on_boundary[first_equal_row(V[on_boundary])]
    return new[F], int(np.count_nonzero(new != np.arange(len(V))))


def _drop(F: Ints, wrong: NDArray[np.bool_]) -> tuple[Ints, int]:
    return F[~wrong], int(np.count_nonzero(wrong))


def _repeated(F: Ints) -> NDArray[np.bool_]:
    """Mask of the triangles that repeat the three vertices of an earlier one."""
    if len(F) == 0:
        return np.zeros(0, dtype=bool)
    repeated = first_equal_row(np.sort(F, axis=1)) != np.arange(len(F))
    # Two triangles with the same boundary and nothing else at it are a closed surface, a sphere.
    _, _, faces_at = glued_in_pairs(F)
    return repeated & (faces_at > 2).any(axis=1)


def _orient(F: Ints) -> tuple[Ints, int]:
    twin, same, _ = glued_in_pairs(F)
    if not same.any():
        return F, 0
    oriented, _ = igl.bfs_orient(F)
    turned = (oriented != F).any(axis=1) & orientable_faces(twin, same)
    return np.where(turned[:, None], oriented, F), int(np.count_nonzero(turned))


def _split_edges(V: Floats, F: Ints) -> tuple[Floats, Ints, int]:
    _, _, faces_at = glued_in_pairs(F)
    if faces_at.max() <= 2:
        return V, F, 0
    faces, origin = igl.split_nonmanifold(F)
    return V[origin], faces, origin.size - np.unique(F).size


def _split_vertices(V: Floats, F: Ints) -> tuple[Floats, Ints, int]:
    twin, same, _ = glued_in_pairs(F)
    fan, n_fans = corner_vertices(twin, same)
    first_corner = np.unique(fan, return_index=True)[1]
    origin = F.ravel()[first_corner]
    # The first fan of a vertex keeps it, the others get copies at the end of V.
    extra = np.ones(n_fans, dtype=bool)
    extra[np.unique(origin, return_index=True)[1]] = False
    new = np.where(extra, len(V) + np.cumsum(extra) - 1, origin)
    return np.vstack([V, V[origin[extra]]]), new[fan], int(np.count_nonzero(extra))


def _fill_holes(V: Floats, F: Ints, largest: int) -> tuple[Floats, Ints, int]:
    """A cone over each boundary loop of up to ``largest`` edges."""
    twin, _, _ = glued_in_pairs(F)
    free = np.flatnonzero(twin.ravel() < 0)
    start, end = F.ravel()[next_corner(free)], F.ravel()[next_corner(free, 2)]
    graph = coo_array((np.ones(free.size), (start, end)), shape=(len(V), len(V)))
    loop = connected_components(graph, directed=False)[1][start]
    _, loop, size = np.unique(loop, return_inverse=True, return_counts=True)
    filled = size <= largest
    chosen = filled[loop]
    centre = np.cumsum(filled) - 1
    # On an oriented surface each vertex of a loop starts one of its sides: this is their mean.
    centres = np.zeros((int(filled.sum()), V.shape[1]))
    np.add.at(centres, centre[loop[chosen]], V[start[chosen]])
    centres /= size[filled, None]
    cones = np.column_stack([end, start, len(V) + centre[loop]])[chosen]
    return np.vstack([V, centres]), np.vstack([F, cones]), int(filled.sum())
