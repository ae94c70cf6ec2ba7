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

import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import igl
import numpy as np
from numpy.typing import NDArray

from .errors import MeshError
from .extras import missing_library, require
from .mesh_text import COUNT, FACE, VERTEX, check_lines, text_lines
from .ply import read_ply
from .stl import read_stl
from .validation import check_finite, checked_positions

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Extensions that Open3D reads and libigl does not.
_OPEN3D = (".gltf", ".glb", ".fbx")
_FEWEST_DIGITS_OF_INFINITY = 308


@dataclass(frozen=True, eq=False)
class MeshFile:
    """What a file holds.

    Attributes
    ----------
    V : (n, 3) float
    F : (m, 3) int
        Triangles; polygons are replaced by their fans.
    n_faces, n_polygons : int
        Faces in the file, and those of them with more than three corners.
    n_welded : int
        Vertices saved by giving STL corners at the same position one vertex.
    """

    V: Floats
    F: Ints
    n_faces: int
    n_polygons: int
    n_welded: int = 0


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
        mesh = _READERS[extension](file) if extension in _READERS else _read_open3d(file)
        _check(mesh)
    except MeshError as error:
        raise MeshError(f"{file}: {error}") from error
    return mesh


def first_equal_row(rows: NDArray[Any]) -> Ints:
    """For each row of a matrix the index of the first one equal to it; shape (n,)."""
    order = np.lexsort(rows.T)
    starts = np.ones(len(rows), dtype=bool)
    starts[1:] = (rows[order[1:]] != rows[order[:-1]]).any(axis=1)
    result = np.empty_like(order)
    # lexsort is stable, so that each group begins with the first of its rows.
    result[order] = order[starts][np.cumsum(starts) - 1]
    return result


def compressed(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """Drop the vertices that no face uses."""
    used, faces = np.unique(F, return_inverse=True)
    return V[used], faces.reshape(F.shape)


def fans(corners: Ints, degrees: Ints) -> Ints:
    """Triangulate polygons, given one after the other: (c_0, c_i, c_{i+1}) for 0 < i < degree-1."""
    first = np.cumsum(degrees) - degrees
    triangles = degrees - 2
    apex = np.repeat(first, triangles)
    i = np.arange(apex.size) - np.repeat(np.cumsum(triangles) - triangles, triangles) + 1
    return corners[np.column_stack([apex, apex + i, apex + i + 1])]


def _check(mesh: MeshFile) -> None:
    if len(mesh.F) == 0:
        raise MeshError(f"the mesh is empty: {len(mesh.V)} vertices and no faces.")
    if mesh.F.min() < 0 or mesh.F.max() >= len(mesh.V):
        raise MeshError(
            f"faces refer to vertices {mesh.F.min()} to {mesh.F.max()} (counted from 0), and there "
            f"are {len(mesh.V)}: the file is truncated or corrupt."
        )
    check_finite(checked_positions(mesh.V), mesh.F)


def _checked_degrees(degrees: Ints) -> Ints:
    if (degrees < 3).any():
        f = int(np.argmax(degrees < 3))
        raise MeshError(f"face {f} (counted from 0) has {degrees[f]} corners.")
    return degrees


def _from_libigl(text: bytes, extension: str, n_vertices: int, degrees: Ints) -> MeshFile:
    """Let libigl read ``text``, which holds so many vertices, and faces of these degrees."""
    with tempfile.NamedTemporaryFile(suffix=extension) as copy:
        copy.write(text)
        copy.flush()
        V, F = _libigl(copy.name)
    if len(V) != n_vertices or len(F) != (degrees - 2).sum():
        raise MeshError(
            f"of {n_vertices} vertices and {degrees.size} faces not all could be read: the file is "
            "corrupt."
        )
    return MeshFile(V, F, degrees.size, int(np.count_nonzero(degrees > 3)))


def _libigl(name: str) -> tuple[Floats, Ints]:
    try:
        V, F = igl.read_triangle_mesh(name)
    except (RuntimeError, ValueError, MemoryError) as error:
        raise MeshError(
            "libigl cannot read the file: it is corrupt, truncated, or not of the format that its "
            "name says."
        ) from error
    return V.reshape(-1, 3), F.reshape(-1, 3).astype(np.int64)


def _check_vertices(rows: list[bytes]) -> None:
    check_lines(rows, VERTEX, "vertex")
    for row in rows:
        # Only such numbers can be too large for floating point, and libigl prints where they are.
        if (b"e" in row or b"E" in row or len(row) > _FEWEST_DIGITS_OF_INFINITY) and not all(
            math.isfinite(float(x)) for x in row.removeprefix(b"v").split()
        ):
            raise MeshError(f"a vertex has infinite coordinates: {row[:60].decode()!r}.")


def _read_obj(file: Path) -> MeshFile:
    lines = text_lines(file.read_bytes())
    vertices = [line for line in lines if line[:1] == b"v" and line[1:2].isspace()]
    faces = [line for line in lines if line[:1] == b"f" and line[1:2].isspace()]
    _check_vertices(vertices)
    check_lines(faces, FACE, "face")
    if any(b"-" in line for line in faces):
        faces = _counted_from_one(lines)
    degrees = np.array([len(face.split()) - 1 for face in faces], dtype=np.int64)
    _checked_degrees(degrees)
    return _from_libigl(b"\n".join((*vertices, *faces, b"")), ".obj", len(vertices), degrees)


def _counted_from_one(lines: list[bytes]) -> list[bytes]:
    """Faces whose negative indices, which count backwards from the face's line, are replaced."""
    faces, n = [], 0
    for line in lines:
        kind, *corners = line.split()
        n += kind == b"v"
        if kind == b"f":
            numbers = [int(corner.split(b"/")[0]) for corner in corners]
            if min(numbers) < -n:
                raise MeshError(
                    f"a face refers to vertex {min(numbers)}, counted backwards, and {n} vertices "
                    "come before it: the file is truncated or corrupt."
                )
            faces.append(b"f " + b" ".join(b"%d" % (i + (n + 1) * (i < 0)) for i in numbers))
    return faces


def _read_off(file: Path) -> MeshFile:
    lines = text_lines(file.read_bytes())
    keyword, *counts = lines[0].split() if lines else [b""]
    if keyword not in (b"OFF", b"COFF", b"NOFF") or b"BINARY" in counts:
        raise MeshError("the first line is not OFF, COFF or NOFF, as in text files of this format.")
    body = lines[1:]
    if not counts and body:
        counts, body = body[0].split(), body[1:]
    if len(counts) < 2 or not all(COUNT.fullmatch(count) for count in counts):
        raise MeshError("the numbers of vertices and faces are missing after the first line.")
    n_vertices, n_faces = int(counts[0]), int(counts[1])
    if len(body) < n_vertices + n_faces:
        raise MeshError(
            f"{n_vertices} vertices and {n_faces} faces are announced, and {len(body)} lines "
            "follow: the file is truncated."
        )
    faces = [_off_face(row) for row in body[n_vertices : n_vertices + n_faces]]
    degrees = _checked_degrees(np.array([face.count(b" ") for face in faces], dtype=np.int64))
    vertices = [b" ".join(row.split()[:3]) for row in body[:n_vertices]]
    _check_vertices(vertices)
    check_lines(faces, FACE, "face")
    head = b"OFF\n%d %d 0" % (n_vertices, n_faces)
    return _from_libigl(b"\n".join((head, *vertices, *faces, b"")), ".off", n_vertices, degrees)


def _off_face(row: bytes) -> bytes:
    """The number of corners and the corners, without the colour that may follow."""
    tokens = row.split()
    size = int(tokens[0]) + 1 if COUNT.fullmatch(tokens[0]) else 0
    face = tokens[:size]
    if not face or len(face) != size or not all(token.isdigit() for token in face):
        raise MeshError(f"this line is no face: {row[:60].decode(errors='replace')!r}.")
    return b" ".join(face)


def _read_ply(file: Path) -> MeshFile:
    V, corners, degrees = read_ply(file.read_bytes())
    F = fans(corners, _checked_degrees(degrees))
    return MeshFile(V, F, degrees.size, int(np.count_nonzero(degrees > 3)))


def _read_stl(file: Path) -> MeshFile:
    corners = read_stl(file.read_bytes())
    if len(corners) == 0:
        raise MeshError("the mesh is empty: no faces.")
    F = first_equal_row(corners).reshape(-1, 3)
    welded, faces = compressed(corners, F)
    return MeshFile(welded, faces, len(F), 0, len(corners) - len(welded))


def _read_open3d(file: Path) -> MeshFile:
    require(f"reading {file.suffix.lower()} files", "open3d")
    try:
        import open3d
    except (ImportError, OSError) as error:
        raise MeshError(
            f"Open3D, which reads such files, cannot start: {missing_library(error)}"
        ) from error

    with open3d.utility.VerbosityContextManager(open3d.utility.VerbosityLevel.Error):
        mesh = open3d.io.read_triangle_mesh(str(file))
    V, F = np.array(mesh.vertices), np.array(mesh.triangles, dtype=np.int64)
    if len(F) == 0:
        raise MeshError("Open3D reads no triangles from this file: it is corrupt or no mesh.")
    return MeshFile(V, F, len(F), 0)


_READERS: dict[str, Callable[[Path], MeshFile]] = {
    ".obj": _read_obj,
    ".off": _read_off,
    ".ply": _read_ply,
    ".stl": _read_stl,
}
# Extensions of the files that can be read.
EXTENSIONS = (*_READERS, *_OPEN3D)
