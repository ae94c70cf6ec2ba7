"""PLY: one mesh in every type of number and every byte order, rows of equal and unequal length."""

import struct
from itertools import product

import numpy as np
import pytest

from igl_periods.meshes.formats.ply import mesh_from_ply

V = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 7]]
TRIANGLES = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
MIXED = [[3, 2, 1, 0], *TRIANGLES]
CODES = {
    "char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
    "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I",
    "float": "f", "double": "d", "float32": "f", "float64": "d",
}  # fmt: skip
INTEGERS = [name for name, code in CODES.items() if code not in "fd"]


def ply(faces, form, number, count, index):
    """A PLY file with the given types, and with an element and properties nobody asks for."""
    header = (
        f"ply\nformat {form} 1.0\ncomment by hand\nelement camera 1\nproperty uchar zoom\n"
        f"element vertex {len(V)}\n"
        + "".join(f"property {number} {c}\n" for c in ("x", "y", "z", "weight"))
        + f"element face {len(faces)}\nproperty list {count} {index} vertex_indices\nend_header\n"
    ).encode()
    vertices = [[*row, 5] for row in V]
    rows = [[len(face), *face] for face in faces]
    if form == "ascii":
        lines = [[3], *vertices, *rows]
        return header + "".join(" ".join(map(str, line)) + "\n" for line in lines).encode()
    order = "<" if form == "binary_little_endian" else ">"
    body = struct.pack("B", 3)
    body += b"".join(struct.pack(f"{order}4{CODES[number]}", *row) for row in vertices)
    for degree, *corners in rows:
        body += struct.pack(f"{order}{CODES[count]}", degree)
        body += struct.pack(f"{order}{degree}{CODES[index]}", *corners)
    return header + body


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian", "binary_big_endian"])
@pytest.mark.parametrize("faces", [TRIANGLES, MIXED], ids=["triangles", "mixed"])
def test_every_type_of_number_says_the_same(form, faces):
    for number, (count, index) in product(CODES, zip(INTEGERS, reversed(INTEGERS))):
        mesh = mesh_from_ply(ply(faces, form, number, count, index))
        points, corners, degrees = mesh.V, mesh.corners, mesh.degrees
        assert points.dtype == np.float64
        assert points.tolist() == V
        assert corners.tolist() == [corner for face in faces for corner in face]
        assert degrees.tolist() == [len(face) for face in faces]
