"""OBJ: lines of vertices and of faces, which count from 1, or backwards."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from igl_periods.errors import MeshError

from .libigl import check_vertices, read_with_libigl
from .mesh_file import MeshFile, checked_degrees
from .text import FACE, check_lines, text_lines


def mesh_from_obj(file: Path) -> MeshFile:
    """The mesh in an OBJ file."""
    lines = text_lines(file.read_bytes())
    vertices = [line for line in lines if line[:1] == b"v" and line[1:2].isspace()]
    faces = [line for line in lines if line[:1] == b"f" and line[1:2].isspace()]
    check_vertices(vertices)
    check_lines(faces, FACE, "face")
    if any(b"-" in line for line in faces):
        faces = _counted_from_one(lines)
    degrees = np.array([len(face.split()) - 1 for face in faces], dtype=np.int64)
    checked_degrees(degrees)
    return read_with_libigl(b"\n".join((*vertices, *faces, b"")), ".obj", len(vertices), degrees)


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
