"""The PLY format: positions and polygons of a mesh, from text or binary files.

A PLY file is a header that declares *elements* (vertex, face, …), each a table whose columns are
numbers or lists of numbers, and then the tables themselves.  libigl reads it too, but ends the
whole process when faces have different numbers of corners or the file is cut short, and both
happen.  Here rows of equal size, the usual case, are one structured NumPy array over the bytes of
the file; only tables with lists of different lengths are walked through row by row.

References
----------
Turk, "The PLY polygon file format" (1994).
"""

from __future__ import annotations

import itertools
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

from .mesh_file import MeshFile, checked_degrees, fans

_NAMES = {
    "i1": ("char", "int8"),
    "u1": ("uchar", "uint8"),
    "i2": ("short", "int16"),
    "u2": ("ushort", "uint16"),
    "i4": ("int", "int32"),
    "u4": ("uint", "uint32"),
    "f4": ("float", "float32"),
    "f8": ("double", "float64"),
}
_TYPES = {name: kind for kind, names in _NAMES.items() for name in names}
_INTEGERS = {"i1", "u1", "i2", "u2", "i4", "u4"}
_STRUCT = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "f4": "f", "f8": "d"}
_BYTE_ORDER = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_CORNERS = ("vertex_indices", "vertex_index")


@dataclass(frozen=True)
class _Property:
    name: str
    kind: str
    count: str | None = None  # the type of a list's length


@dataclass(frozen=True)
class _Element:
    name: str
    size: int
    properties: tuple[_Property, ...]

    def names(self, is_list: bool) -> set[str]:
        """The properties that are numbers, or those that are lists of integers."""
        if not is_list:
            return {p.name for p in self.properties if p.count is None}
        return {p.name for p in self.properties if p.count and p.kind in _INTEGERS}


def read_ply(data: bytes) -> tuple[Floats, Ints, Ints]:
    """Read the vertices and the faces of a PLY file.

    Parameters
    ----------
    data : bytes
        The whole file.

    Returns
    -------
    V : (n, 3) float
    corners : (sum(degrees),) int
        The corners of all faces, one face after the other.
    degrees : (m,) int
        Number of corners of each face.

    Raises
    ------
    MeshError
        If the header is no PLY header, declares no x, y, z or no faces, or the tables are shorter
        than declared or hold no numbers.
    """
    order, elements, offset = _header(data)
    rows = iter([line for line in data[offset:].splitlines() if line.strip()] if not order else [])
    V = corners = degrees = None
    for element in elements:
        try:
            if order:
                columns, offset = _binary(data, offset, element, order)
            else:
                columns = _text(list(itertools.islice(rows, element.size)), element)
        except (struct.error, ValueError, OverflowError, IndexError) as error:
            raise MeshError(
                f"the table of {element.size} {element.name} rows ends early or holds no numbers "
                "that its header declares: the file is truncated or corrupt."
            ) from error
        column = dict(zip((p.name for p in element.properties), columns, strict=True))
        if element.name == "vertex" and set("xyz") <= element.names(is_list=False):
            V = np.column_stack([column[c][0] for c in "xyz"]).astype(np.float64)
        for name in _CORNERS if element.name == "face" else ():
            if name in element.names(is_list=True):
                corners, degrees = column[name]
    if V is None or corners is None or degrees is None:
        raise MeshError(
            "the header declares no vertices with x, y, z, or no faces with vertex_indices: it is "
            "a point cloud or something else than a polygon mesh."
        )
    return V, corners.astype(np.int64), degrees.astype(np.int64)


# The values of a column, and how many of them each row has.
_Column = tuple[NDArray[Any], NDArray[Any]]


def _header(data: bytes) -> tuple[str, list[_Element], int]:
    """Byte order ('' for text), the elements, and where the tables begin."""
    end = data.find(b"end_header")
    start_of_tables = data.find(b"\n", end) + 1
    if not data.startswith(b"ply") or end < 0 or start_of_tables == 0:
        raise MeshError("the file has no PLY header from 'ply' to 'end_header'.")
    order, elements = None, []
    for line in data[:end].decode("ascii", "replace").splitlines():
        match line.split():
            case ["format", name, *_] if name in _BYTE_ORDER:
                order = _BYTE_ORDER[name]
            case ["element", name, size] if size.isdigit() and len(size) < 19:
                elements.append(_Element(name, int(size), ()))
            case ["property", "list", count, kind, name] if (
                elements and _TYPES.get(count) in _INTEGERS and kind in _TYPES
            ):
                elements.append(
                    _extended(elements.pop(), _Property(name, _TYPES[kind], _TYPES[count]))
                )
            case ["property", kind, name] if elements and kind in _TYPES:
                elements.append(_extended(elements.pop(), _Property(name, _TYPES[kind])))
            case [("ply" | "comment" | "obj_info"), *_] | []:
                pass
            case _:
                raise MeshError(f"this line of the PLY header is not understood: {line!r}.")
    if order is None:
        raise MeshError("the PLY header has no format line.")
    for names in ([e.name for e in elements], *([p.name for p in e.properties] for e in elements)):
        if len(set(names)) < len(names):
            raise MeshError(f"the PLY header declares one name twice, of {', '.join(names)}.")
    return order, elements, start_of_tables


def _extended(element: _Element, column: _Property) -> _Element:
    return _Element(element.name, element.size, (*element.properties, column))


def _text(lines: list[bytes], element: _Element) -> list[_Column]:
    if len(lines) < element.size:
        raise ValueError(f"{len(lines)} rows")
    rows = [line.split() for line in lines]
    columns: list[_Column] = []
    at = np.zeros(len(rows), dtype=np.int64)
    for p in element.properties:
        if p.count is None:
            lengths: Ints = np.ones(len(rows), dtype=np.int64)
        else:
            lengths = np.array([int(row[i]) for row, i in zip(rows, at)], dtype=np.int64)
            at += 1
        tokens = [row[i : i + n] for row, i, n in zip(rows, at, lengths)]
        flat = list(itertools.chain.from_iterable(tokens))
        if len(flat) != lengths.sum() or (lengths < 0).any():
            raise ValueError("a row is too short")
        columns.append((_numbers(flat, p.kind), lengths))
        at += lengths
    return columns


def _numbers(tokens: list[bytes], kind: str) -> NDArray[Any]:
    if kind not in _INTEGERS:
        # What is too large for single precision becomes infinite.
        with np.errstate(over="ignore"):
            return np.array([float(token) for token in tokens]).astype(kind)
    numbers = np.array([int(token) for token in tokens], dtype=np.int64)
    limits = np.iinfo(kind)
    if numbers.size and not limits.min <= numbers.min() <= numbers.max() <= limits.max:
        raise ValueError("a number is too large for its type")
    return numbers.astype(kind)


def _binary(data: bytes, offset: int, element: _Element, order: str) -> tuple[list[_Column], int]:
    """The columns of one table and where the next one begins."""
    if element.size == 0:
        empty = np.zeros(0, dtype=np.int64)
        return [(empty, empty) for _ in element.properties], offset
    first, _ = _row(data, offset, element, order)
    fields: list[tuple[Any, ...]] = []
    for k, (p, values) in enumerate(zip(element.properties, first)):
        if p.count is not None:
            fields.append((f"n{k}", order + p.count))
        fields.append((f"v{k}", order + p.kind, (len(values),)))
    dtype = np.dtype(fields)
    end = offset + element.size * dtype.itemsize
    if end <= len(data):
        table = np.frombuffer(data, dtype, element.size, offset)
        lengths = [name for name in dtype.names or () if name.startswith("n")]
        if all((table[name] == table[name][0]).all() for name in lengths):
            return [_uniform(table[f"v{k}"]) for k in range(len(first))], end
    return _walked(data, offset, element, order)


def _uniform(values: NDArray[Any]) -> _Column:
    return values.ravel(), np.full(len(values), values.shape[1])


def _walked(data: bytes, offset: int, element: _Element, order: str) -> tuple[list[_Column], int]:
    rows = []
    for _ in range(element.size):
        row, offset = _row(data, offset, element, order)
        rows.append(row)
    columns: list[_Column] = []
    for k in range(len(element.properties)):
        lengths = np.array([len(row[k]) for row in rows])
        columns.append((np.array(list(itertools.chain.from_iterable(r[k] for r in rows))), lengths))
    return columns, offset


def _row(
    data: bytes, offset: int, element: _Element, order: str
) -> tuple[list[tuple[float, ...]], int]:
    """One row, a tuple of numbers for each property, and where the next row begins."""
    row: list[tuple[float, ...]] = []
    for p in element.properties:
        n = 1
        if p.count is not None:
            (n,) = struct.unpack_from(order + _STRUCT[p.count], data, offset)
            offset += struct.calcsize(order + _STRUCT[p.count])
        layout = f"{order}{n}{_STRUCT[p.kind]}"
        row.append(struct.unpack_from(layout, data, offset))
        offset += struct.calcsize(layout)
    return row, offset


def mesh_from_ply(file: Path) -> MeshFile:
    """The mesh in a PLY file."""
    V, corners, degrees = read_ply(file.read_bytes())
    F = fans(corners, checked_degrees(degrees))
    return MeshFile(V, F, degrees.size, int(np.count_nonzero(degrees > 3)))
