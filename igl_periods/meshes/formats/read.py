"""Mesh files: vertex positions and triangles, in double precision and in the order of the file.

OBJ and OFF are read by libigl, which triangulates a polygon by its fan (c_0, c_i, c_{i+1}).
libigl trusts what a file declares, and ends the process or reads something else where it is
wrong; therefore the lines are counted first, libigl is given nothing but the vertices and the
faces, and what it returns must agree with the count.  STL, three corners for every triangle and
no connectivity, needs no library; corners at the same position are the same vertex.

Other formats are left to Open3D.  It is not used for the first three because it drops polygons,
rounds coordinates to single precision and splits vertices along seams of textures.
"""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path

from igl_periods.complexes import check_finite, checked_positions
from igl_periods.errors import MeshError

from .mesh_file import MeshFile
from .obj import mesh_from_obj
from .off import mesh_from_off
from .open3d import mesh_from_open3d
from .ply import mesh_from_ply
from .stl import mesh_from_stl

# Extensions that Open3D reads and libigl does not.
_OPEN3D = (".gltf", ".glb", ".fbx")


def read_mesh_file(path: str | PathLike[str]) -> MeshFile:
    """Read OBJ, OFF, PLY or STL, or what Open3D reads.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    MeshError
        If the format is unknown, or the file is empty, truncated, or not what its extension says.
    """
    file = Path(path)
    if not file.exists():
        raise FileNotFoundError(f"there is no mesh file {str(file)!r}")
    if not file.is_file():
        raise MeshError(f"{file}: this is no file.")
    extension = file.suffix.lower()
    if extension not in EXTENSIONS:
        known = " ".join(EXTENSIONS)
        raise MeshError(f"{file}: the format {extension or '(none)'!r} is not one of {known}.")
    if file.stat().st_size == 0:
        raise MeshError(f"{file}: the file is empty.")
    try:
        mesh = _READERS[extension](file) if extension in _READERS else mesh_from_open3d(file)
        _check(mesh)
    except MeshError as error:
        raise MeshError(f"{file}: {error}") from error
    return mesh


def _check(mesh: MeshFile) -> None:
    if len(mesh.F) == 0:
        raise MeshError(f"the mesh is empty: {len(mesh.V)} vertices and no faces.")
    if mesh.F.min() < 0 or mesh.F.max() >= len(mesh.V):
        raise MeshError(
            f"faces refer to vertices {mesh.F.min()} to {mesh.F.max()} (counted from 0), and there "
            f"are {len(mesh.V)}: the file is truncated or corrupt."
        )
    check_finite(checked_positions(mesh.V), mesh.F)


_READERS: dict[str, Callable[[Path], MeshFile]] = {
    ".obj": mesh_from_obj,
    ".off": mesh_from_off,
    ".ply": mesh_from_ply,
    ".stl": mesh_from_stl,
}
# Extensions of the files that can be read.
EXTENSIONS = (*_READERS, *_OPEN3D)
