"""Make a surface of a mesh that nearly is one, and count every change.

The steps, in this order, each a function from a mesh to a mesh:

* drop triangles that repeat another one;
* stitch boundary edges that lie in pairs at the same place, by welding their ends (``seams``):
  first at exactly the same place, then within a tolerance.  This closes the seams of files that
  repeat vertices, and touches no surface that is closed already: sheets of an immersed surface may
  meet in a vertex and stay apart;
* drop triangles that use a vertex twice, and those that repeat another one now;
* turn triangles over until they agree, in every component that is orientable;
* split non-manifold edges, pairing the triangles that run through the edge in opposite directions
  (Guéziec et al.), and give each fan of triangles at a vertex a vertex of its own;
* contract edges without length (``contraction``);
* optionally close boundary loops, by a cone over the loop from its centre;
* drop vertices without triangles.

No vertex moves, but to another one within the tolerance.  Slivers stay, and triangles of area 0
whose sides have lengths: dropping them would open holes.

References
----------
Guéziec, Taubin, Lazarus, Horn, "Cutting and stitching: converting sets of polygons to manifold
surfaces" (2001).
"""

from __future__ import annotations

from numbers import Real

import igl
import numpy as np
from numpy.typing import ArrayLike, NDArray

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import (
    check_finite,
    checked_corners,
    checked_positions,
    components_of,
    corner_vertices,
    next_corner,
    orientable_faces,
)
from igl_periods.errors import MeshError
from igl_periods.options import checked_integer

from .contraction import contracted
from .facts import collapsed, glued_in_pairs, repeats
from .report import RepairStep
from .seams import WELD, stitched, tolerance_of
from .welding import compressed, first_equal_row

_LARGEST_WELD = 0.01


def repair_mesh(
    V: ArrayLike, F: ArrayLike, *, weld: float = WELD, largest_hole: int = 0
) -> tuple[Floats, Ints, tuple[RepairStep, ...]]:
    """Weld, drop, orient, split and fill what keeps a mesh from being a surface.

    Parameters
    ----------
    V : (n, d) array-like
    F : (m, 3) array-like of int
    weld : float
        How far apart the ends of boundary edges may be that are welded, in parts of the diagonal of
        the mesh; less than 0.01, and 0 for those at exactly the same place.  Positions in single
        precision are welded within four units in the last place of the largest, in any case.
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
        If the arrays have a wrong shape or type, an index is out of range, coordinates are not
        finite, the tolerance is none, the size of holes no number, or no triangle is left.
    """
    weld, largest_hole = checked_repair(weld, largest_hole)
    V = checked_positions(V)
    F = checked_corners(F, len(V))
    check_finite(V, F)
    steps = []
    F, repeated = _drop(F, _repeated(V, F))
    F, welded, _ = stitched(V, F, _free_sides(F), 0.0)
    steps.append(RepairStep("vertices welded by stitching boundary edges", welded))
    F, dropped = _drop(F, collapsed(F))
    if weld > 0.0 and len(F):
        F, welded, distance = stitched(V, F, _free_sides(F), tolerance_of(V, F, weld))
        steps.append(RepairStep("vertices welded within the tolerance", welded, distance))
    steps.append(RepairStep("triangles dropped that used a vertex twice", dropped))
    F, dropped = _drop(F, _repeated(V, F))
    steps.append(RepairStep("duplicate triangles dropped", repeated + dropped))
    if len(F) == 0:
        raise MeshError("no triangle is left after repair: all of them are collapsed.")
    F, turned = _orient(F)
    steps.append(RepairStep("triangles turned over", turned))
    V, F, added = _split_edges(V, F)
    steps.append(RepairStep("vertices added by splitting non-manifold edges", added))
    V, F, added = _split_vertices(V, F)
    steps.append(RepairStep("vertices added by splitting non-manifold vertices", added))
    F, contractions = contracted(V, F)
    steps.append(RepairStep("edges without length contracted", contractions))
    V, F, filled = _fill_holes(V, F, largest_hole)
    steps.append(RepairStep(f"holes of up to {largest_hole} edges filled", filled))
    used, faces = compressed(V, F)
    steps.append(RepairStep("vertices without triangles dropped", len(V) - len(used)))
    return used, faces, tuple(steps)


def checked_repair(weld: float, largest_hole: int) -> tuple[float, int]:
    """How far a repair goes, as numbers of Python; MeshError if that is nothing possible."""
    if not (isinstance(weld, Real) and 0.0 <= weld < _LARGEST_WELD):
        raise MeshError(
            f"weld = {weld!r}: vertices are welded within a part of the diagonal of the mesh, from "
            f"0 to less than {_LARGEST_WELD:g}."
        )
    try:
        size = checked_integer("largest_hole", largest_hole)
    except ValueError as error:
        raise MeshError(str(error)) from None
    if size < 0:
        raise MeshError(f"largest_hole = {size}: holes have a number of edges, or 0 for none.")
    return float(weld), size


def _free_sides(F: Ints) -> Ints:
    twin, _, _ = glued_in_pairs(F)
    return np.flatnonzero(twin.ravel() < 0)


def _drop(F: Ints, wrong: NDArray[np.bool_]) -> tuple[Ints, int]:
    return F[~wrong], int(np.count_nonzero(wrong))


def _repeated(V: Floats, F: Ints) -> NDArray[np.bool_]:
    """Mask of the triangles that repeat an earlier one.

    That is, one with the same vertices and the same orientation, or with the same vertices where
    edges are crowded, or at the same place and without neighbours.  Two triangles that are glued
    along all three sides are no such thing, but a sphere.
    """
    if len(F) == 0:
        return np.zeros(0, dtype=bool)
    _, _, faces_at = glued_in_pairs(F)
    least_first = F[np.arange(len(F))[:, None], (F.argmin(axis=1)[:, None] + np.arange(3)) % 3]
    places = first_equal_row(V)[F]
    return (
        repeats(least_first)
        | (repeats(np.sort(F, axis=1)) & (faces_at > 2).any(axis=1))
        | (repeats(np.sort(places, axis=1)) & (faces_at == 1).all(axis=1))
    )


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
    _, label = components_of(start, end, len(V))
    _, loop, size = np.unique(label[start], return_inverse=True, return_counts=True)
    filled = size <= largest
    chosen = filled[loop]
    centre = np.cumsum(filled) - 1
    # On an oriented surface each vertex of a loop starts one of its sides: this is their mean.
    centres = np.zeros((int(filled.sum()), V.shape[1]))
    np.add.at(centres, centre[loop[chosen]], V[start[chosen]] / size[loop[chosen], None])
    cones = np.column_stack([end, start, len(V) + centre[loop]])[chosen]
    return np.vstack([V, centres]), np.vstack([F, cones]), int(filled.sum())
