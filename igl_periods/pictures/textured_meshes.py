"""Parametrized surfaces as textured meshes: Wavefront OBJ, and binary glTF 2.0.

The texture is one period of a checkerboard and repeats in both directions.  Texture coordinates
are z times a scale, per corner, so that they may jump across the seams.

References
----------
Khronos Group, "glTF 2.0 specification" (2021), sections 3.6 and 4.
"""

from __future__ import annotations

import io
import json
import os
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import igl
import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats, Ints
from igl_periods.differentials import Parametrization
from igl_periods.machine import require

from .cells import copy_shifts
from .scenes import checkerboard, checkerboard_scale
from .sheets import surface_in_space

# glTF: component types, buffer targets, filters and wrapping are OpenGL's constants.
_FLOAT, _UNSIGNED_INT = 5126, 5125
_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963
_LINEAR, _LINEAR_MIPMAP_LINEAR, _REPEAT = 9729, 9987, 10497
_MAGIC, _JSON, _BINARY = 0x46546C67, 0x4E4F534A, 0x004E4942


def write_obj(
    path: str | os.PathLike[str],
    P: Parametrization,
    scale: float | None = None,
    copies: Sequence[int] = (1,),
) -> list[Path]:
    """Write a textured mesh as OBJ, with a material and a texture beside it.

    Parameters
    ----------
    path : path-like
        ``name.obj``; ``name.mtl`` and ``name.png`` are written, too.
    P : Parametrization
    scale : float, optional
        Texture coordinates are ``scale`` z; by default such that the area of the surface is that
        of 3600 squares, on average.
    copies : sequence of int
        Of the cell of a periodic surface, as for :func:`periodic_copies`.

    Returns
    -------
    list of Path
        The three files.

    Raises
    ------
    ComplexError
        If the surface has no positions in space.
    MissingExtraError
        If Pillow is not installed.
    """
    obj = Path(path)
    material, texture = obj.with_suffix(".mtl"), obj.with_suffix(".png")
    V, F, corner = _copied(P, copies)
    uv = _texture_coordinates(P, scale)
    none, no_faces = np.zeros((0, 0)), np.zeros((0, 0), dtype=np.int64)
    igl.writeOBJ(str(obj), V, F, none, no_faces, uv, corner)
    obj.write_text(f"mtllib {material.name}\nusemtl checkerboard\n{obj.read_text()}")
    material.write_text(f"newmtl checkerboard\nKd 1 1 1\nmap_Kd {texture.name}\n")
    texture.write_bytes(_checkerboard_png())
    return [obj, material, texture]


def write_glb(
    path: str | os.PathLike[str],
    P: Parametrization,
    scale: float | None = None,
    copies: Sequence[int] = (1,),
) -> list[Path]:
    """Write a textured mesh as binary glTF, everything in one file, in single precision.

    Vertices are those of the surface cut to a disk, since glTF has texture coordinates at
    vertices only.  Parameters and errors as in :func:`write_obj`.
    """
    V, F, corner = _copied(P, copies)
    # A vertex for each pair of a place and a texture coordinate.
    pairs = np.stack([corner.ravel(), F.ravel()], axis=1)
    pairs, index = np.unique(pairs, axis=0, return_inverse=True)
    uv = _texture_coordinates(P, scale)[pairs[:, 0]]
    # The origin of a glTF texture is its upper left corner.
    arrays = [
        (V[pairs[:, 1]].astype("<f4"), _FLOAT, "VEC3"),
        (igl.per_vertex_normals(V, F)[pairs[:, 1]].astype("<f4"), _FLOAT, "VEC3"),
        (np.stack([uv[:, 0], 1.0 - uv[:, 1]], axis=1).astype("<f4"), _FLOAT, "VEC2"),
        (index.astype("<u4").ravel(), _UNSIGNED_INT, "SCALAR"),
    ]
    image = _checkerboard_png()
    document = _gltf(arrays, len(image))
    binary = b"".join(_padded(array.tobytes(), b"\0") for array, _, _ in arrays)
    binary += _padded(image, b"\0")
    text = _padded(json.dumps(document).encode(), b" ")
    header = struct.pack("<III", _MAGIC, 2, 28 + len(text) + len(binary))
    Path(path).write_bytes(
        header
        + struct.pack("<II", len(text), _JSON)
        + text
        + struct.pack("<II", len(binary), _BINARY)
        + binary
    )
    return [Path(path)]


def _copied(P: Parametrization, copies: Sequence[int]) -> tuple[Floats, Ints, Ints]:
    """Positions, faces, and the texture coordinates of their corners, of copies of a surface."""
    V, F = surface_in_space(P.complex)
    shifts = copy_shifts(P.complex.cell, copies)
    faces = np.concatenate([F + k * len(V) for k in range(len(shifts))])
    return (
        np.concatenate([V + t for t in shifts]),
        np.ascontiguousarray(faces),
        np.tile(P.corner, (len(shifts), 1)),
    )


def _texture_coordinates(P: Parametrization, scale: float | None) -> Floats:
    z = P.uv * (checkerboard_scale(P) if scale is None else scale)
    return np.stack([z.real, z.imag], axis=1)


def _checkerboard_png() -> bytes:
    require("a texture", "PIL")
    from PIL import Image

    stream = io.BytesIO()
    Image.fromarray(checkerboard()).save(stream, format="PNG")
    return stream.getvalue()


def _padded(data: bytes, filling: bytes) -> bytes:
    return data + filling * (-len(data) % 4)


def _gltf(arrays: list[tuple[NDArray[Any], int, str]], image_size: int) -> dict[str, Any]:
    """The document that describes positions, normals, texture coordinates, corners, an image."""
    sizes = [array.nbytes for array, _, _ in arrays] + [image_size]
    offsets = np.concatenate([[0], np.cumsum([size + -size % 4 for size in sizes])])
    views: list[dict[str, Any]] = [
        {"buffer": 0, "byteOffset": int(offset), "byteLength": size}
        for offset, size in zip(offsets, sizes, strict=False)
    ]
    for view in views[:3]:
        view["target"] = _ARRAY_BUFFER
    views[3]["target"] = _ELEMENT_ARRAY_BUFFER
    accessors: list[dict[str, Any]] = [
        {"bufferView": i, "componentType": component, "count": len(array), "type": kind}
        for i, (array, component, kind) in enumerate(arrays)
    ]
    positions = arrays[0][0]
    accessors[0] |= {
        "min": [float(x) for x in positions.min(axis=0)],
        "max": [float(x) for x in positions.max(axis=0)],
    }
    primitive = {
        "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
        "indices": 3,
        "material": 0,
    }
    return {
        "asset": {"version": "2.0", "generator": "igl_periods"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}],
        "materials": [
            {
                "pbrMetallicRoughness": {
                    "baseColorTexture": {"index": 0},
                    "metallicFactor": 0.0,
                    "roughnessFactor": 0.8,
                }
            }
        ],
        "textures": [{"source": 0, "sampler": 0}],
        "images": [{"bufferView": 4, "mimeType": "image/png"}],
        "samplers": [
            {
                "magFilter": _LINEAR,
                "minFilter": _LINEAR_MIPMAP_LINEAR,
                "wrapS": _REPEAT,
                "wrapT": _REPEAT,
            }
        ],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": int(offsets[-1])}],
    }
