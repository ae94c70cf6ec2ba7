"""OBJ: lines of vertices and of faces, which count from 1, or backwards."""

from __future__ import annotations

import re

import numpy as np

from igl_periods.errors import MeshError

from .mesh_file import MeshFile, checked_degrees
from .text import coordinates, row_of_indices, shown, text_lines

# An index, with those of texture and normal behind slashes.
_INDEX = rb"-?\d{1,9}(?:\.\d*)?(?:[eE][-+]?\d{1,2})?"
_FACE = re.compile(rb"fo?(?:\s+%b(?:/(?:%b)?){0,2})+" % (_INDEX, _INDEX))
# Curves and surfaces, and other files: parts of the object that are not polygons.
_OTHER = {b"surf", b"curv", b"curv2", b"bzp", b"bsp", b"cdc", b"cdp", b"res", b"call"}


def mesh_from_obj(data: bytes) -> MeshFile:
    """The mesh in an OBJ file."""
    vertices, degrees, others = [], [], set()
    corners: list[int] = []
    for line in text_lines(data):
        kind = line.split(None, 1)[0]
        if kind == b"v":
            vertices.append(line)
        elif kind in (b"f", b"fo"):
            face = _face(line, len(vertices))
            corners += face
            degrees.append(len(face))
        elif kind in _OTHER:
            others.add(kind.decode())
    V = coordinates(vertices, skip=1)
    found = f"only polygons are read, and the file holds {', '.join(sorted(others))} too."
    return MeshFile(
        V,
        np.array(corners, dtype=np.int64),
        checked_degrees(np.array(degrees, dtype=np.int64)),
        warnings=(found,) if others else (),
    )


def _face(line: bytes, n: int) -> list[int]:
    """The corners of a face, counted from 0; n vertices come before it."""
    if not _FACE.fullmatch(line):
        raise MeshError(f"this line is not a face, which is made of indices: {shown(line)}.")
    tokens = [token.partition(b"/")[0] for token in line.split()[1:]]
    numbers = row_of_indices(tokens, line)
    if min(numbers) < -n:
        raise MeshError(
            f"a face refers to vertex {min(numbers)}, counted backwards, and {n} vertices "
            "come before it: the file is truncated or corrupt."
        )
    return [i - 1 if i >= 0 else n + i for i in numbers]
