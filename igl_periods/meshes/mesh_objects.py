"""Meshes of other libraries as V and F, told by where their classes come from.

None of these libraries is imported.  What their meshes have in common is little: positions are
called vertices, points, or ``vertex.positions``; faces may be rows, rows with leading counts in
one array, or blocks of equal cells; and ``triangles`` of trimesh are coordinates.  What is not a
mesh of triangles or polygons is refused, with what its own library does about it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import check_finite, checked_positions, mesh_reader
from igl_periods.errors import MeshError

from .formats.mesh_file import checked_degrees
from .polygons import triangulated

_Mesh = tuple[Any, Any]
# Cells of meshio that are not faces.
_NO_FACES = ("vertex", "line", "line3")


@mesh_reader
def mesh_of_object(mesh: Any) -> _Mesh | None:
    """V and F of a mesh of trimesh, Open3D, PyVista or meshio, or of whatever has such arrays.

    Raises
    ------
    MeshError
        If it is not a mesh of triangles or polygons, or a polygon crosses itself.
    """
    for cls in type(mesh).__mro__:
        reader = _READERS.get(cls.__module__.split(".")[0])
        if reader is not None:
            return reader(mesh)
    if not hasattr(mesh, "vertices"):
        return None
    for name in ("faces", "triangles"):
        if hasattr(mesh, name):
            return mesh.vertices, getattr(mesh, name)
    raise MeshError(f"faces are missing: {type(mesh).__name__} has vertices, but no .faces.")


def _trimesh(mesh: Any) -> _Mesh:
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return np.asarray(mesh.vertices), np.asarray(mesh.faces)
    raise _no_mesh("trimesh", mesh, "of a scene take to_mesh(), or one of its geometries")


def _open3d(mesh: Any) -> _Mesh:
    """A legacy mesh, or one of tensors, which may live on another device."""
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):
        return np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    if not (hasattr(mesh, "vertex") and hasattr(mesh, "triangle")):
        raise _no_mesh("Open3D", mesh, "make a TriangleMesh of it")
    if "positions" not in mesh.vertex or "indices" not in mesh.triangle:
        raise MeshError("the mesh is empty: it has no vertex.positions or no triangle.indices.")
    return mesh.vertex["positions"].cpu().numpy(), mesh.triangle["indices"].cpu().numpy()


def _pyvista(mesh: Any) -> _Mesh:
    if not (hasattr(mesh, "points") and hasattr(mesh, "faces") and hasattr(mesh, "n_strips")):
        raise _no_mesh("PyVista", mesh, "take extract_surface().triangulate()")
    if mesh.n_strips:
        raise MeshError("the PolyData has strips of triangles: take mesh.triangulate().")
    corners, degrees = _with_leading_counts(np.asarray(mesh.faces, dtype=np.int64))
    V = checked_positions(mesh.points)
    return V, _triangles(V, corners, degrees)


def _vtk(mesh: Any) -> _Mesh:
    raise _no_mesh("VTK", mesh, "take pyvista.wrap(…)")


def _meshio(mesh: Any) -> _Mesh:
    if not (hasattr(mesh, "points") and hasattr(mesh, "cells")):
        raise _no_mesh("meshio", mesh, "a meshio.Mesh does")
    blocks: list[Ints] = [np.zeros((0, 3), dtype=np.int64)]
    V = checked_positions(mesh.points)
    for cells in mesh.cells:
        if cells.type in ("triangle", "quad", "polygon"):
            rows = np.asarray(cells.data, dtype=np.int64)
            degrees = np.full(len(rows), rows.shape[1])
            blocks.append(_triangles(V, rows.ravel(), degrees))
        elif cells.type not in _NO_FACES:
            raise MeshError(
                f"the meshio.Mesh has cells of type {cells.type!r}, and a surface is made of "
                "triangles. Hand over its surface alone: meshio.Mesh(points, [('triangle', F)])."
            )
    return V, np.concatenate(blocks)


def _with_leading_counts(faces: Ints) -> tuple[Ints, Ints]:
    """Corners and their numbers of faces in one array, k c_1 … c_k k c_1 … ."""
    starts, at = [], 0
    if faces.size and faces.size % (faces[0] + 1) == 0:
        rows = faces.reshape(-1, faces[0] + 1)
        if (rows[:, 0] == faces[0]).all():
            return rows[:, 1:].ravel(), rows[:, 0]
    while at < faces.size:
        starts.append(at)
        at += int(faces[at]) + 1
    return np.delete(faces, starts), faces[starts]


def _triangles(V: Floats, corners: Ints, degrees: Ints) -> Ints:
    """Triangles, and polygons divided as those of files are."""
    if (degrees == 3).all():
        return corners.reshape(-1, 3)
    checked_degrees(degrees)
    if corners.min() < 0 or corners.max() >= len(V):
        raise MeshError(
            f"faces refer to vertices {corners.min()} to {corners.max()}, and there are {len(V)}."
        )
    check_finite(V, corners)
    space = np.zeros((len(V), 3))
    space[:, : V.shape[1]] = V[:, :3]
    return triangulated(space, corners, degrees).F


def _no_mesh(library: str, thing: Any, advice: str) -> MeshError:
    return MeshError(
        f"a {type(thing).__name__} of {library} holds no triangles of a surface: {advice}."
    )


_READERS: dict[str, Callable[[Any], _Mesh]] = {
    "trimesh": _trimesh,
    "open3d": _open3d,
    "pyvista": _pyvista,
    "vtkmodules": _vtk,
    "meshio": _meshio,
}
