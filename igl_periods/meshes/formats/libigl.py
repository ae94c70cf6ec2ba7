"""OBJ and OFF through libigl.

libigl trusts what a file declares, and ends the process or reads something else where it is wrong;
therefore the lines are counted first, libigl is given nothing but the vertices and the faces, and
what it returns must agree with the count.
"""

from __future__ import annotations

import math
import tempfile

import igl
import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

from .mesh_file import MeshFile
from .text import VERTEX, check_lines

_FEWEST_DIGITS_OF_INFINITY = 308


def read_with_libigl(text: bytes, extension: str, n_vertices: int, degrees: Ints) -> MeshFile:
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


def check_vertices(rows: list[bytes]) -> None:
    """Refuse lines that hold no vertex, or an infinite one."""
    check_lines(rows, VERTEX, "vertex")
    for row in rows:
        # Only such numbers can be too large for floating point, and libigl prints where they are.
        if (b"e" in row or b"E" in row or len(row) > _FEWEST_DIGITS_OF_INFINITY) and not all(
            math.isfinite(float(x)) for x in row.removeprefix(b"v").split()
        ):
            raise MeshError(f"a vertex has infinite coordinates: {row[:60].decode()!r}.")
