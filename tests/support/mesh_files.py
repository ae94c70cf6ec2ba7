"""Small meshes, and what files of them look like in every format that is read."""

import base64
import json
import struct
from pathlib import Path

import numpy as np


def torus(n: int = 7, m: int = 5) -> tuple[np.ndarray, np.ndarray]:
    """A torus of revolution with 2 n m triangles, none of its coordinates short."""
    i, j = np.divmod(np.arange(n * m), m)
    u, v = 2 * np.pi * (i + 0.1) / n, 2 * np.pi * (j + 0.2) / m
    V = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], axis=1)
    a, b = m * i + j, m * ((i + 1) % n) + j
    c, d = m * ((i + 1) % n) + (j + 1) % m, m * i + (j + 1) % m
    return V, np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)


def cube(shift: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """The unit cube, moved along the first axis; six quadrilaterals, seen from outside."""
    V = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return V + np.array([shift, 0, 0]), np.array(quads)


def halved(quads: np.ndarray) -> np.ndarray:
    return np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def rows(matrix) -> str:
    return "".join(" ".join(repr(x) for x in row) + "\n" for row in np.asarray(matrix).tolist())


def off(V, polygons) -> str:
    faces = "".join(f"{len(p)} {' '.join(map(str, p))}\n" for p in polygons)
    return f"OFF\n{len(V)} {len(polygons)} 0\n{rows(V)}{faces}"


def obj(V, polygons) -> str:
    faces = "".join(f"f {' '.join(str(i + 1) for i in p)}\n" for p in polygons)
    return "".join(f"v {line}\n" for line in rows(V).splitlines()) + faces


def ply(V, polygons, form: str = "ascii") -> bytes:
    """PLY with a normal before and a flag behind every face's list, to be skipped."""
    header = (
        f"ply\nformat {form} 1.0\ncomment made for a test\nelement vertex {len(V)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(polygons)}\nproperty float quality\n"
        "property list uchar int vertex_indices\nproperty uchar flag\n"
        "element edge 1\nproperty int vertex1\nend_header\n"
    )
    if form == "ascii":
        faces = "".join(f"0.5 {len(p)} {' '.join(map(str, p))} 1\n" for p in polygons)
        return (header + rows(V) + faces + "0\n").encode()
    order = "<" if "little" in form else ">"
    faces = b"".join(struct.pack(f"{order}fB{len(p)}iB", 0.5, len(p), *p, 1) for p in polygons)
    return header.encode() + np.asarray(V, order + "f8").tobytes() + faces + b"\0\0\0\0"


def stl(V, F, binary: bool) -> bytes:
    corners = np.asarray(V)[np.asarray(F)]
    if binary:
        facets = b"".join(struct.pack("<12fH", 0, 0, 0, *c.ravel(), 0) for c in corners)
        return b"solid, says this header".ljust(80) + struct.pack("<I", len(F)) + facets
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {' '.join(map(repr, x))}\n" for x in c)
        + "endloop\nendfacet\n"
        for c in corners.tolist()
    )
    return f"solid test\n{facets}endsolid test\n".encode()


def gltf(V, F) -> str:
    """A minimal glTF 2.0 document, buffers inside."""
    positions, indices = np.asarray(V, "<f4"), np.asarray(F, "<u4")
    data = indices.tobytes() + positions.tobytes()
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    split = {"buffer": 0, "byteLength": indices.nbytes}
    rest = {"buffer": 0, "byteOffset": indices.nbytes, "byteLength": positions.nbytes}
    box = {"min": positions.min(axis=0).tolist(), "max": positions.max(axis=0).tolist()}
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}],
        "buffers": [{"byteLength": len(data), "uri": uri}],
        "bufferViews": [split, rest],
        "accessors": [
            {"bufferView": 0, "componentType": 5125, "count": indices.size, "type": "SCALAR"},
            {"bufferView": 1, "componentType": 5126, "count": len(V), "type": "VEC3", **box},
        ],
    }
    return json.dumps(document)


def glb(V, F) -> bytes:
    """The same in one binary file: a chunk of JSON and a chunk of buffers."""
    document = json.loads(gltf(V, F))
    uri = document["buffers"][0].pop("uri")
    data = base64.b64decode(uri.split(",")[1])
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def written(path: Path, content: str | bytes) -> Path:
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


FORMS = {
    "mesh.obj": obj,
    "mesh.OFF": off,
    "text.ply": ply,
    "little.ply": lambda V, p: ply(V, p, "binary_little_endian"),
    "big.ply": lambda V, p: ply(V, p, "binary_big_endian"),
}


TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


V4, F4 = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


GOOD_PLY = ply(V4, F4)
