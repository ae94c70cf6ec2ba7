"""The STL format: three corners for every triangle, in text or 50 bytes each, no connectivity."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.errors import MeshError
from igl_periods.meshes.welding import compressed, first_equal_row

from .mesh_file import MeshFile
from .text import NUMBER, check_lines, text_lines

_HEADER = 84
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_CORNER = re.compile(rb"vertex(?:\s+%b){3}" % NUMBER)


def read_stl(data: bytes) -> Floats:
    """Read the corners of the triangles of an STL file, three for each; shape (3 m, 3).

    Raises
    ------
    MeshError
        If the file is truncated, corrupt or no STL.
    """
    n_facets = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
    if len(data) >= _HEADER and len(data) == _HEADER + _FACET.itemsize * n_facets:
        facets = np.frombuffer(data, _FACET, offset=_HEADER)
        return facets["corners"].reshape(-1, 3).astype(np.float64)
    if not data.lstrip().startswith(b"solid") or b"endsolid" not in data:
        raise MeshError(
            "this is neither text from 'solid' to 'endsolid' nor the number of bytes that a binary "
            "file announces: the file is truncated or no STL."
        )
    rows = [line for line in text_lines(data) if line.startswith((b"vertex", b"endfacet"))]
    corners = [row for row in rows if row != b"endfacet"]
    ends = rows[3::4]
    if ends != [b"endfacet"] * (len(rows) // 4) or len(corners) != 3 * len(ends):
        raise MeshError("not every facet has three vertices: the file is corrupt.")
    check_lines(corners, _CORNER, "vertex")
    numbers = [float(x) for row in corners for x in row.split()[1:]]
    return np.array(numbers).reshape(-1, 3)


def mesh_from_stl(file: Path) -> MeshFile:
    """The mesh in an STL file."""
    corners = read_stl(file.read_bytes())
    if len(corners) == 0:
        raise MeshError("the mesh is empty: no faces.")
    F = first_equal_row(corners).reshape(-1, 3)
    welded, faces = compressed(corners, F)
    return MeshFile(welded, faces, len(F), 0, len(corners) - len(welded))
