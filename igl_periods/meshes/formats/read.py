"""Mesh files: positions and polygons, in double precision and in the order of the file.

Readers trust nothing: every number is matched before it is converted, every count is compared with
what is there, and every reader gets all bytes of the file, decompressed.
"""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path

from igl_periods.complexes import check_finite, checked_positions
from igl_periods.errors import MeshError
from igl_periods.options import in_words

from .compression import content
from .gltf import mesh_from_gltf
from .mesh_file import MeshFile
from .obj import mesh_from_obj
from .off import mesh_from_off
from .ply import mesh_from_ply
from .stl import mesh_from_stl
from .three_mf import mesh_from_3mf

_COMPRESSED = ".gz"
# What to do with files that hold surfaces of another kind, or that no kept library reads rightly.
_EXPORTS = {
    **dict.fromkeys((".step", ".stp", ".iges", ".igs"), " Export the part as STL or 3MF."),
    **dict.fromkeys((".fbx", ".blend", ".dae"), " Export the mesh as glTF or OBJ."),
}


def extension_of(name: str) -> str:
    """The extension of a file in small letters, without that of compression."""
    path = Path(name.lower())
    return Path(path.stem).suffix if path.suffix == _COMPRESSED else path.suffix


def read_mesh_file(path: str | PathLike[str]) -> MeshFile:
    """Read a mesh, compressed or not.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    MeshError
        If the format is unknown, or the file is empty, truncated, or not what its extension says.
    """
    if not isinstance(path, (str, PathLike)):
        raise MeshError(f"a mesh is read from a path, not from {in_words(path)}.")
    file = Path(path)
    if not file.exists():
        raise FileNotFoundError(f"there is no mesh file {str(file)!r}")
    if not file.is_file():
        raise MeshError(f"{file}: this is not a file.")
    extension = extension_of(file.name)
    if extension not in EXTENSIONS:
        known = " ".join(EXTENSIONS)
        raise MeshError(
            f"{file}: the format {extension or '(none)'!r} is not one of {known}, with or without "
            f"{_COMPRESSED}.{_EXPORTS.get(extension, '')}"
        )
    try:
        data = content(file, file.suffix.lower() == _COMPRESSED)
        mesh = _reader(extension, file.parent)(data)
        _check(mesh)
    except MeshError as error:
        raise MeshError(f"{file}: {error}") from error
    return mesh


def _reader(extension: str, folder: Path) -> Callable[[bytes], MeshFile]:
    # The buffers of glTF may be files beside it.
    if extension in _GLTF:
        return lambda data: mesh_from_gltf(data, folder)
    return _READERS[extension]


def _check(mesh: MeshFile) -> None:
    if mesh.degrees.size == 0:
        raise MeshError(f"the mesh is empty: {len(mesh.V)} vertices and no faces.")
    if mesh.corners.min() < 0 or mesh.corners.max() >= len(mesh.V):
        raise MeshError(
            f"faces refer to vertices {mesh.corners.min()} to {mesh.corners.max()} (counted from "
            f"0), and there are {len(mesh.V)}: the file is truncated or corrupt."
        )
    check_finite(checked_positions(mesh.V), mesh.corners)


_GLTF = (".gltf", ".glb")
_READERS: dict[str, Callable[[bytes], MeshFile]] = {
    ".obj": mesh_from_obj,
    ".off": mesh_from_off,
    ".ply": mesh_from_ply,
    ".stl": mesh_from_stl,
    ".3mf": mesh_from_3mf,
}
# Extensions of the files that can be read.
EXTENSIONS = (*_READERS, *_GLTF)
