"""The arrays of a glTF file: buffers, views of them, and accessors, which say what they are."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any
from urllib.parse import unquote, unquote_to_bytes

import numpy as np
from numpy.typing import NDArray

from igl_periods.complexes import MOST_TRIANGLES
from igl_periods.errors import MeshError

_KINDS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def gltf_document(data: bytes) -> tuple[dict[str, Any], bytes | None]:
    """The JSON of a glTF or GLB file, and the buffer that a GLB file holds."""
    if not data.startswith(b"glTF"):
        return dict(json.loads(data.decode("utf-8-sig"))), None
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise MeshError(f"this is GLB of version {version}, and version 2 is read.")
    if length > len(data):
        raise MeshError(f"{length} bytes are announced, and there are {len(data)}: truncated.")
    chunks: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack_from("<I4s", data, at)
        chunks.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    return dict(json.loads(chunks[b"JSON"].decode("utf-8-sig"))), chunks.get(b"BIN\0")


class Accessors:
    """The arrays of a document, by their numbers."""

    def __init__(self, document: dict[str, Any], chunk: bytes | None, folder: Path) -> None:
        self._document = document
        self._folder = folder
        self._buffers: dict[int, bytes] = {} if chunk is None else {0: chunk}

    def __call__(self, number: int) -> NDArray[Any]:
        """The array of an accessor, one row an element; normalised integers are divided."""
        accessor = self._document["accessors"][_index(number)]
        count, width = int(accessor["count"]), _WIDTHS[accessor["type"]]
        kind = np.dtype(_KINDS[accessor["componentType"]])
        if not 0 <= count <= 3 * MOST_TRIANGLES:
            raise MeshError(f"an accessor of {count} elements is too large.")
        if "bufferView" in accessor:
            view, offset = accessor["bufferView"], accessor.get("byteOffset", 0)
            values = self._view(view, offset, kind, (count, width))
        elif "sparse" in accessor:
            values = np.zeros((count, width), dtype=kind)
        else:
            raise MeshError(
                "an accessor has no data of its own: it is compressed in a way that is not read."
            )
        if "sparse" in accessor:
            values = self._with_replaced_rows(values.copy(), accessor["sparse"])
        if accessor.get("normalized") and kind.kind != "f":
            scaled: NDArray[Any] = values.astype(np.float64) / np.iinfo(kind).max
            return np.maximum(scaled, -1.0)
        return values

    def _with_replaced_rows(self, values: NDArray[Any], sparse: Any) -> NDArray[Any]:
        count = int(sparse["count"])
        where, rows = sparse["indices"], sparse["values"]
        kind = np.dtype(_KINDS[where["componentType"]])
        at = self._view(where["bufferView"], where.get("byteOffset", 0), kind, (count, 1))
        shape = (count, values.shape[1])
        values[at[:, 0]] = self._view(
            rows["bufferView"], rows.get("byteOffset", 0), values.dtype, shape
        )
        return values

    def _view(
        self, number: int, offset: int, kind: np.dtype[Any], shape: tuple[int, int]
    ) -> NDArray[Any]:
        view = self._document["bufferViews"][_index(number)]
        start = _index(view.get("byteOffset", 0))
        data = self._buffer(view["buffer"])[start : start + _index(view["byteLength"])]
        row = shape[1] * kind.itemsize
        stride = _index(view.get("byteStride", row))
        needed = _index(offset) + (stride * (shape[0] - 1) + row if shape[0] else 0)
        if needed > len(data):
            raise MeshError(f"{needed} bytes are needed of a buffer view that has {len(data)}.")
        strides = (stride, kind.itemsize)
        return np.ndarray(shape, kind, buffer=data, offset=offset, strides=strides)

    def _buffer(self, number: int) -> bytes:
        if _index(number) not in self._buffers:
            uri = str(self._document["buffers"][number]["uri"])
            self._buffers[number] = self._loaded(uri)
        return self._buffers[number]

    def _loaded(self, uri: str) -> bytes:
        if uri.startswith("data:"):
            head, _, body = uri.partition(",")
            return base64.b64decode(body) if head.endswith(";base64") else unquote_to_bytes(body)
        if "://" in uri:
            raise MeshError(f"a buffer is not in the file but at {uri[:60]!r}.")
        try:
            return (self._folder / unquote(uri)).read_bytes()
        except OSError as error:
            raise MeshError(f"the buffer {uri[:60]!r}, which belongs to it, is missing.") from error


def _index(value: Any) -> int:
    if not isinstance(value, int) or value < 0:
        raise MeshError(f"the file has {value!r} where a number from 0 on is expected.")
    return value
