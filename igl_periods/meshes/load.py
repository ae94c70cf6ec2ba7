"""From a mesh file to vertices and triangles, with a report of what was found and changed.

A file is read as it is: polygons are divided into triangles, and STL corners at the same position
become one vertex, both counted; nothing else changes unless repair is asked for.  What is no
closed, oriented surface is loaded all the same, since it may have a use (the double of a surface
with boundary is closed); the report says what keeps it from being one, and
:func:`~igl_periods.complexes.check_surface` refuses it where a period matrix is wanted.
"""

from __future__ import annotations

import warnings
from os import PathLike

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import checked_corners, checked_positions, face_components
from igl_periods.errors import MeshError

from .facts import glued_in_pairs, mesh_facts
from .formats.read import read_mesh_file
from .polygons import triangulated
from .repair import repair_mesh
from .report import MeshReport as MeshReport
from .report import RepairStep
from .seams import WELD
from .welding import compressed


def load_mesh(
    path: str | PathLike[str],
    repair: bool = False,
    *,
    weld: float = WELD,
    largest_hole: int = 0,
) -> tuple[Floats, Ints, MeshReport]:
    """Read a triangle mesh from a file: V, F and a report.

    OBJ, OFF, PLY, STL, 3MF, glTF and GLB are read in double precision and in the order of the file,
    each of them compressed by gzip too (``mesh.obj.gz``).  Polygons are divided into triangles
    (:func:`~igl_periods.meshes.polygons.triangulated`).

    Parameters
    ----------
    path : path-like
    repair : bool
        Weld, drop, orient and split what keeps the mesh from being a surface
        (:func:`~igl_periods.meshes.repair.repair_mesh`), and count it.
    weld : float
        With ``repair``, how far apart the ends of boundary edges may be that are welded, in parts
        of the diagonal of the mesh; 0 for those at exactly the same place.
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
        If the format is unknown, or the file is empty, truncated or corrupt; if the outline of a
        polygon crosses itself.

    Warns
    -----
    UserWarning
        Of what is odd about the file, though it could be read.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F, report = ip.load_mesh(ip.sample_files()["wente_20x20"])
    >>> V.shape, F.shape
    ((400, 3), (800, 3))
    >>> report.result.components[0]
    MeshComponent(triangles=800, orientable=True, genus=1, boundary_loops=0)
    """
    mesh = read_mesh_file(path)
    try:
        triangles = triangulated(mesh.V, mesh.corners, mesh.degrees)
    except MeshError as error:
        raise MeshError(f"{path}: {error}") from error
    for warning in mesh.warnings:
        warnings.warn(f"{path}: {warning}", stacklevel=2)
    V, F = mesh.V, triangles.F
    loaded = result = mesh_facts(V, F)
    steps: tuple[RepairStep, ...] = ()
    if repair:
        V, F, steps = repair_mesh(V, F, weld=weld, largest_hole=largest_hole)
        result = mesh_facts(V, F)
    report = MeshReport(
        file=str(path),
        faces=mesh.degrees.size,
        polygons_fanned=triangles.fanned,
        polygons_clipped=triangles.clipped,
        polygons_not_planar=triangles.not_planar,
        unevenness=triangles.unevenness,
        repeated_corners=triangles.repeated_corners,
        stl_corners_welded=mesh.n_welded,
        warnings=mesh.warnings,
        loaded=loaded,
        repair=steps,
        result=result,
    )
    return V, F, report


def split_components(V: ArrayLike, F: ArrayLike) -> list[tuple[Floats, Ints]]:
    """Split a mesh into components: a pair (V, F) each, in the order of their first triangles.

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

    Examples
    --------
    >>> import igl_periods as ip
    >>> import numpy as np
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> two = np.concatenate([V, V + 9]), np.concatenate([F, F + len(V)])
    >>> [len(faces) for _, faces in ip.split_components(*two)]
    [192, 192]
    """
    positions = checked_positions(V)
    faces = checked_corners(F, len(positions))
    twin, _, _ = glued_in_pairs(faces)
    _, label = face_components(twin)
    _, first = np.unique(label, return_index=True)
    return [compressed(positions, faces[label == label[f]]) for f in np.sort(first)]
