"""OFF: a keyword, the numbers of vertices and faces, the vertices, the faces.

The keyword says what a vertex has besides its position: ``[ST][C][N][4][n]OFF`` for texture,
colour, normal, a fourth coordinate w, other dimensions.  Common files have one vertex or face on a
line, colours behind them; but line breaks mean nothing in this format, so that where lines do not
fit the words are taken one after the other.

References
----------
Geomview manual, "OFF Files".
"""

from __future__ import annotations

import re
from itertools import chain

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.errors import MeshError

from .mesh_file import MeshFile, checked_degrees
from .text import COUNT, coordinates, row_of_indices, shown, text_lines

_KEYWORD = re.compile(rb"((?:ST|C|N)*)(4?)(n?)(?:OFF|off)(?![A-Za-z_])(.*)")
# How many numbers a vertex has for its texture and normal, and maybe for its colour.
_PARTS = {"ST": (2,), "N": (3,), "C": (4, 3)}


def mesh_from_off(data: bytes) -> MeshFile:
    """The mesh in an OFF file."""
    lines = text_lines(data)
    keyword = _KEYWORD.fullmatch(lines[0]) if lines else None
    if keyword is None and not (lines and COUNT.fullmatch(lines[0].split()[0])):
        raise MeshError("the first line is not OFF, COFF or NOFF, as in text files of this format.")
    extras, four, other, rest = (
        (b"", b"", b"", lines[0]) if keyword is None else keyword.groups(default=b"")
    )
    if b"BINARY" in rest:
        raise MeshError("the file is binary OFF, not OFF, COFF or NOFF, as in text files.")
    body = [rest, *lines[1:]] if rest.strip() else lines[1:]
    if other:
        body = _of_three_dimensions(body)
    n_vertices, n_faces, body = _counts(body)
    size = 4 if four else 3
    rows = _one_on_a_line(body, n_vertices, n_faces, size)
    if rows is None:
        rows = _free(body, n_vertices, n_faces, size, extras.decode())
    V = coordinates(rows[0], count=size)
    faces = [_corners(row) for row in rows[1]]
    degrees = np.array([len(face) for face in faces], dtype=np.int64)
    corners = np.array(list(chain.from_iterable(faces)), dtype=np.int64)
    V, warnings = _affine(V)
    return MeshFile(V, corners, checked_degrees(degrees), warnings=warnings)


def _of_three_dimensions(body: list[bytes]) -> list[bytes]:
    """What follows the dimension of nOFF."""
    dimension, *rest = body[0].split(None, 1) if body else [b""]
    if dimension != b"3":
        raise MeshError(f"the surface lies in dimension {shown(dimension)}, and 3 is read.")
    return [*rest, *body[1:]]


def _counts(body: list[bytes]) -> tuple[int, int, list[bytes]]:
    """The numbers of vertices and faces, and what follows them and the number of edges."""
    if body and len(body[0].split()) == 1:
        # Each on a line of its own.
        body = [b" ".join(body[:3]), *body[3:]]
    line = body[0].split(None, 3) if body else []
    if len(line) > 2 and not COUNT.fullmatch(line[2]):
        # Without a number of edges.
        line = [*line[:2], b"0", b" ".join(line[2:])]
    if len(line) < 2 or not all(COUNT.fullmatch(count) for count in line[:2]):
        raise MeshError("the numbers of vertices and faces are missing after the first line.")
    return int(line[0]), int(line[1]), [*line[3:], *body[1:]]


def _one_on_a_line(
    body: list[bytes], n: int, m: int, size: int
) -> tuple[list[bytes], list[bytes]] | None:
    """The lines of vertices and of faces, if each has its own."""
    vertices, faces = body[:n], body[n : n + m]
    widths = {len(row.split()) for row in vertices}
    if len(body) < n + m or (widths and min(widths) < size):
        return None
    # Two vertices on a line here, three there: those are not lines of vertices.
    if len(widths) > 1 and len(body) > n + m:
        return None
    whole = all(_length(row.split()) <= len(row.split()) for row in faces)
    return (vertices, faces) if whole else None


def _free(
    body: list[bytes], n: int, m: int, size: int, extras: str
) -> tuple[list[bytes], list[bytes]]:
    """Vertices and faces from words, whatever their lines."""
    words = list(chain.from_iterable(row.split() for row in body))
    failures = []
    for width in _widths(size, extras):
        at = n * width
        faces = []
        for _ in range(m):
            length = _length(words[at : at + 1])
            if at + length > len(words):
                break
            faces.append(b" ".join(words[at : at + length]))
            at += length
        if len(faces) == m and at == len(words):
            vertices = [b" ".join(words[i : i + size]) for i in range(0, n * width, width)]
            return vertices, faces
        failures.append((len(faces), at))
    _refuse(body, words, n, m, failures[0])
    raise AssertionError


def _widths(size: int, extras: str) -> list[int]:
    """How many numbers a vertex may have."""
    widths = [size]
    for part, lengths in _PARTS.items():
        if part in extras.replace("ST", "") or (part == "ST" and part in extras):
            widths = [width + length for length in lengths for width in widths]
    return widths


def _length(words: list[bytes]) -> int:
    """How many words the face has that begins here; more than there can be if none does."""
    known = words and COUNT.fullmatch(words[0]) and len(words[0]) < 10
    return 1 + int(words[0]) if known else 2**62


def _refuse(
    body: list[bytes], words: list[bytes], n: int, m: int, failure: tuple[int, int]
) -> None:
    """Say what is wrong with faces that do not come out even."""
    announced = f"{n} vertices and {m} faces are announced, and {len(body)} lines follow"
    done, at = failure
    if done == m:
        raise MeshError(
            f"{announced} that cannot be divided among them: {len(words) - at} words are left. The "
            "counts are wrong, or vertices have more numbers than the keyword says."
        )
    for row in body[n : n + m] if len(body) >= n + m else []:
        if _length(row.split()) > len(row.split()):
            raise MeshError(f"this line is not a face: {shown(row)}.")
    raise MeshError(f"{announced}: the file is truncated, or its counts are wrong.")


def _corners(row: bytes) -> list[int]:
    """The corners of a face, without the colour that may follow."""
    words = row.split()
    corners = row_of_indices(words[1 : _length(words)], row)
    if corners and min(corners) < 0:
        raise MeshError(f"this line is not a face: {shown(row)}.")
    return corners


def _affine(V: Floats) -> tuple[Floats, tuple[str, ...]]:
    """Positions from homogeneous coordinates."""
    if V.shape[1] == 3:
        return V, ()
    w = V[:, 3:]
    if (w == 0.0).any():
        raise MeshError("vertices with four coordinates, of which the last is 0, lie at infinity.")
    warning = "vertices have four coordinates: the first three were divided by the last."
    return V[:, :3] / w, (warning,) if (w != 1.0).any() else ()
