r"""glTF and GLB: meshes at the nodes of a scene, each moved by the transforms above it.

A node has a matrix, or translation, rotation and scale T R S; the matrices along the way from the
root are multiplied.  A transform of negative determinant is a reflection: it would turn the surface
inside out, and the period matrix into :math:`-\bar\Pi`, so that the faces are turned then.  A mesh
at several nodes is several surfaces.

The format is JSON and arrays of bytes.  Libraries for it hand over the JSON as it is, and leave
transforms and arrays to the reader, or pull in a scene graph with pictures.

References
----------
Khronos Group, "glTF 2.0 Specification" (2021), sections 3.5 to 3.7.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import MOST_TRIANGLES
from igl_periods.errors import MeshError

from .gltf_accessors import Accessors, gltf_document
from .mesh_file import MeshFile, mesh_of_triangles, triangles_of_strip
from .placement import Part, assembled, placed

# What a file may require without any effect on positions and triangles.
_HARMLESS = ("KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_", "MSFT_texture_")
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
# What comes of JSON that is not as it should be.
_WRONG = (
    *(ArithmeticError, AttributeError, LookupError, MemoryError, RecursionError),
    *(TypeError, ValueError, struct.error),
)


def mesh_from_gltf(data: bytes, folder: Path) -> MeshFile:
    """The mesh in a glTF or GLB file; ``folder`` is where its buffers lie."""
    try:
        document, chunk = gltf_document(data)
        _check_extensions(document)
        accessors = Accessors(document, chunk, folder)
        warnings: set[str] = set()
        parts = []
        for node, matrix in _placed_nodes(document):
            parts += _parts_at(document, accessors, node, matrix, warnings)
            if sum(len(part.F) for part in parts) > MOST_TRIANGLES:
                raise MeshError("instances of its meshes have too many triangles together.")
    except MeshError:
        raise
    except _WRONG as error:
        words = f"{type(error).__name__}: {error}"[:120]
        raise MeshError(f"the file is not glTF 2.0, truncated or corrupt ({words}).") from error
    if not parts:
        raise MeshError("there are no triangles in the scene of this file.")
    return mesh_of_triangles(*assembled(parts), warnings=tuple(sorted(warnings)))


def _check_extensions(document: dict[str, Any]) -> None:
    version = str(document["asset"]["version"])
    if not version.startswith("2."):
        raise MeshError(f"this is glTF of version {version[:10]}, and version 2 is read.")
    for name in document.get("extensionsRequired", []):
        if name != "KHR_mesh_quantization" and not str(name).startswith(_HARMLESS):
            raise MeshError(
                f"the file requires {name}, which is not read here: write it without compression "
                "and instancing."
            )


def _placed_nodes(document: dict[str, Any]) -> Iterator[tuple[dict[str, Any], Floats]]:
    """The nodes of the scene with a mesh, and their matrices."""
    nodes = document.get("nodes", [])
    below = {child for node in nodes for child in node.get("children", [])}
    roots = [i for i in range(len(nodes)) if i not in below]
    if document.get("scenes"):
        roots = document["scenes"][document.get("scene", 0)].get("nodes", [])
    waiting = [(i, np.eye(4)) for i in reversed(roots)]
    seen: set[int] = set()
    while waiting:
        i, above = waiting.pop()
        if i in seen:
            raise MeshError(f"node {i} is below two nodes, or below itself.")
        seen.add(i)
        matrix = above @ _matrix(nodes[i])
        waiting += [(child, matrix) for child in reversed(nodes[i].get("children", []))]
        if "mesh" in nodes[i]:
            yield nodes[i], matrix


def _matrix(node: dict[str, Any]) -> Floats:
    """The matrix of a node; the file has it column by column."""
    if "matrix" in node:
        matrix: Floats = np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    else:
        matrix = np.eye(4)
        matrix[:3, :3] = _rotation(node.get("rotation", [0, 0, 0, 1])) * np.array(
            node.get("scale", [1, 1, 1]), dtype=np.float64
        )
        matrix[:3, 3] = node.get("translation", [0, 0, 0])
    if not np.isfinite(matrix).all() or (matrix[3] != [0, 0, 0, 1]).any():
        raise MeshError("the matrix of a node is not an affine map.")
    return matrix


def _rotation(quaternion: list[float]) -> Floats:
    x, y, z, w = np.array(quaternion, dtype=np.float64)
    n = x * x + y * y + z * z + w * w
    if not n > 0.0:
        raise MeshError("the rotation of a node is not a quaternion.")
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + (2 / n) * (w * skew + skew @ skew)


def _parts_at(
    document: dict[str, Any],
    accessors: Accessors,
    node: dict[str, Any],
    matrix: Floats,
    warnings: set[str],
) -> list[Part]:
    """The triangles of the mesh at a node; primitives with the same positions share vertices."""
    mesh = document["meshes"][node["mesh"]]
    if "EXT_mesh_gpu_instancing" in node.get("extensions", {}):
        raise MeshError("a node has instances of EXT_mesh_gpu_instancing, which are not read.")
    if "skin" in node:
        warnings.add("a mesh with a skeleton was read as it is at rest.")
        matrix = np.eye(4)
    if any(node.get("weights", mesh.get("weights", []))):
        warnings.add("a mesh with morph targets was read without them.")
    faces: dict[int, list[Ints]] = {}
    for primitive in mesh["primitives"]:
        if (mode := primitive.get("mode", _TRIANGLES)) < _TRIANGLES:
            continue
        positions = primitive["attributes"]["POSITION"]
        n = len(accessors(positions))
        corners = (
            accessors(primitive["indices"])[:, 0].astype(np.int64)
            if "indices" in primitive
            else np.arange(n)
        )
        if corners.size and corners.max() >= n:
            raise MeshError(f"a triangle has vertex {corners.max()}, and there are {n}.")
        faces.setdefault(positions, []).append(_triangles(mode, corners))
    parts = []
    for positions, triangles in faces.items():
        with np.errstate(invalid="ignore", over="ignore"):
            V = accessors(positions).astype(np.float64)
        if V.shape[1] != 3:
            raise MeshError("positions have not three coordinates.")
        part = placed(Part(V, np.concatenate(triangles)), matrix)
        # Scaled to nothing is what programs make of hidden.
        parts += [part] * (len(part.F) > 0 and bool(matrix[:3, :3].any()))
    return parts


def _triangles(mode: int, corners: Ints) -> Ints:
    if mode == _STRIP:
        return triangles_of_strip(corners)
    if mode == _FAN:
        rim = corners[1:]
        return np.column_stack([rim[:-1], rim[1:], np.full(max(rim.size - 1, 0), corners[0])])
    if mode != _TRIANGLES or corners.size % 3:
        raise MeshError(f"{corners.size} corners of mode {mode} are not triangles.")
    return corners.reshape(-1, 3)
