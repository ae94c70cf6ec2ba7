"""A torus in single precision, and files of scenes with it."""

import base64
import json

import numpy as np
from support.mesh_files import torus

import igl_periods as ip

V0, F0 = torus()
V0 = V0.astype(np.float32).astype(float)


def volume(V, F):
    """Positive where the faces are seen from outside."""
    a, b, c = (V[F[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def gltf(nodes, roots=(0,), **primitive):
    points, corners = V0.astype("<f4").tobytes(), F0.astype("<u2").tobytes()
    data = base64.b64encode(corners + points).decode()
    return {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": list(roots)}],
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0, **primitive}]}],
        "buffers": [{"byteLength": len(corners + points), "uri": f"data:x;base64,{data}"}],
        "bufferViews": [
            {"buffer": 0, "byteLength": len(corners)},
            {"buffer": 0, "byteOffset": len(corners), "byteLength": len(points)},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5123, "count": F0.size, "type": "SCALAR"},
            {"bufferView": 1, "componentType": 5126, "count": len(V0), "type": "VEC3"},
        ],
    }


def loaded(tmp_path, document, name="a.gltf"):
    path = tmp_path / name
    path.write_bytes(document if isinstance(document, bytes) else json.dumps(document).encode())
    return ip.load_mesh(path)[:2]
