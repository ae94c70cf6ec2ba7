"""From a mesh file to vertices and triangles, with a report of what was found and changed.

A file is read as it is: polygons become the fans of their triangles, and STL corners at the same
position one vertex, both counted; nothing else changes unless repair is asked for.  What is no
closed, oriented surface is loaded all the same, since it may have a use (the double of a surface
with boundary is closed); the report says what keeps it from being one, and
:func:`~igl_periods.complexes.check_surface` refuses it where a period matrix is wanted.
"""

from __future__ import annotations

from os import PathLike

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import checked_corners, checked_positions, face_components

from .facts import glued_in_pairs, mesh_facts
from .formats.read import read_mesh_file
from .repair import repair_mesh
from .report import MeshReport as MeshReport
from .report import RepairStep
from .welding import compressed


def load_mesh(
    path: str | PathLike[str], repair: bool = False, *, largest_hole: int = 0
) -> tuple[Floats, Ints, MeshReport]:
    """Read a triangle mesh from a file.

    OBJ, OFF, PLY and STL are read in double precision and in the order of the file; glTF, GLB and
    FBX by Open3D.

    Parameters
    ----------
    path : path-like
    repair : bool
        Weld, drop, orient and split what keeps the mesh from being a surface
        (:func:`~igl_periods.meshes.repair.repair_mesh`), and count it.  Nothing moves.
    largest_hole : int
        With ``repair``, close boundary loops of up to that many edges.

    Returns
    -------
    V : (n, 3) float
        Vertex positions.
    F : (m, 3) int
        Corners of each triangle, as rows of ``V``.
    report : MeshReport
        What was in the file, what was changed, and what is still wrong.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    MeshError
        If the format is unknown, or the file is empty, truncated or corrupt.
    """
    mesh = read_mesh_file(path)
    loaded = mesh_facts(mesh.V, mesh.F)
    V, F, result = mesh.V, mesh.F, loaded
    steps: tuple[RepairStep, ...] = ()
    if repair:
        V, F, steps = repair_mesh(V, F, largest_hole=largest_hole)
        result = mesh_facts(V, F)
    report = MeshReport(
        file=str(path),
        faces=mesh.n_faces,
        polygons_fanned=mesh.n_polygons,
        stl_corners_welded=mesh.n_welded,
        loaded=loaded,
        repair=steps,
        result=result,
    )
    return V, F, report


def split_components(V: ArrayLike, F: ArrayLike) -> list[tuple[Floats, Ints]]:
    """Split a mesh into its components, in the order of their first triangles.

    Triangles are connected where exactly two of them share an edge.

    Parameters
    ----------
    V : (n, d) array-like
    F : (m, 3) array-like of int

    Returns
    -------
    list of (V, F)
        Each with its own vertices.

    Raises
    ------
    MeshError
        If the arrays have a wrong shape or type, or an index is out of range.
    """
    positions = checked_positions(V)
    faces = checked_corners(F, len(positions))
    twin, _, _ = glued_in_pairs(faces)
    _, label = face_components(twin)
    _, first = np.unique(label, return_index=True)
    return [compressed(positions, faces[label == label[f]]) for f in np.sort(first)]
