"""OFF: a keyword, the numbers of vertices and faces, the vertices, the faces."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from igl_periods.errors import MeshError

from .libigl import check_vertices, read_with_libigl
from .mesh_file import MeshFile, checked_degrees
from .text import COUNT, FACE, check_lines, text_lines


def mesh_from_off(file: Path) -> MeshFile:
    """The mesh in an OFF file."""
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
    degrees = checked_degrees(np.array([face.count(b" ") for face in faces], dtype=np.int64))
    vertices = [b" ".join(row.split()[:3]) for row in body[:n_vertices]]
    check_vertices(vertices)
    check_lines(faces, FACE, "face")
    head = b"OFF\n%d %d 0" % (n_vertices, n_faces)
    return read_with_libigl(b"\n".join((head, *vertices, *faces, b"")), ".off", n_vertices, degrees)


def _off_face(row: bytes) -> bytes:
    """The number of corners and the corners, without the colour that may follow."""
    tokens = row.split()
    size = int(tokens[0]) + 1 if COUNT.fullmatch(tokens[0]) else 0
    face = tokens[:size]
    if not face or len(face) != size or not all(token.isdigit() for token in face):
        raise MeshError(f"this line is no face: {row[:60].decode(errors='replace')!r}.")
    return b" ".join(face)
