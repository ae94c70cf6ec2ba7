"""The PLY format: positions and polygons of a mesh, from text or binary files.

A PLY file is a header that declares *elements* (vertex, face, …), each a table whose columns are
numbers or lists of numbers, and then the tables themselves (``ply_tables``).  Faces are polygons,
or strips of triangles, joined by -1.  libigl reads PLY too, but ends the whole process when faces
have different numbers of corners or the file is cut short, and both happen.

References
----------
Turk, "The PLY polygon file format" (1994).
"""

from __future__ import annotations

import codecs
import re

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

from .mesh_file import MeshFile, checked_degrees, triangles_of_strip
from .ply_tables import Column, Element, Property, binary_tables, ends_early, text_tables
from .text import plain_text

_NAMES = {
    "i1": ("char", "int8"),
    "u1": ("uchar", "uint8"),
    "i2": ("short", "int16"),
    "u2": ("ushort", "uint16"),
    "i4": ("int", "int32"),
    "u4": ("uint", "uint32"),
    "i8": ("int64", "long", "longlong"),
    "u8": ("uint64", "ulong", "ulonglong"),
    "f4": ("float", "float32"),
    "f8": ("double", "float64"),
}
_TYPES = {name: kind for kind, names in _NAMES.items() for name in names}
_BYTE_ORDER = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_VERTICES = {"vertex", "vertices"}
_FACES = {"face", "faces", "polygon", "polygons", "triangle", "triangles"}
_STRIPS = {"tristrips", "tristrip", "triangle_strip", "triangle_strips"}
_CORNERS = ("vertex_indices", "vertex_index")
_END = {b"\r": rb"[\r]\s*end_header[ \t]*\r", b"\n": rb"[\r\n]\s*end_header[ \t]*\r?\n"}


def mesh_from_ply(data: bytes) -> MeshFile:
    """The mesh in a PLY file.

    Raises
    ------
    MeshError
        If the header is not a PLY header, declares no x, y, z or no faces, or the tables are
        shorter than declared or hold no numbers.
    """
    if data.startswith((codecs.BOM_UTF8, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = data[3:] if data.startswith(codecs.BOM_UTF8) else plain_text(data)
        return mesh_from_ply(text)
    order, elements, offset = _header(data)
    body = data[offset:]
    tables = binary_tables(body, elements, order) if order else text_tables(body, elements)
    V, corners, degrees = None, [], []
    for element, columns in zip(elements, tables, strict=True):
        try:
            if element.name in _VERTICES and set("xyz") <= columns.keys():
                V = np.column_stack([_coordinate(columns[c]) for c in "xyz"])
            elif element.name in _FACES | _STRIPS and (name := _list_of_corners(element)):
                polygons, sizes = _polygons(element, columns[name])
                corners.append(polygons)
                degrees.append(sizes)
        except MeshError:
            raise
        except ValueError as error:
            raise ends_early(element) from error
    if V is None or not corners:
        raise MeshError(
            "the header declares no vertices with x, y, z, or no faces with vertex_indices: it is "
            "a point cloud or something else than a polygon mesh."
        )
    return MeshFile(V, np.concatenate(corners), checked_degrees(np.concatenate(degrees)))


def _coordinate(column: Column) -> Floats:
    if (column.lengths != 1).any():
        raise ValueError("a list of coordinates")
    return column.floats()


def _list_of_corners(element: Element) -> str | None:
    """Which list of a face holds its corners; None if there is none."""
    lists = [p.name for p in element.properties if p.count is not None]
    for name in _CORNERS:
        if name in lists:
            return name
    likely = [name for name in lists if "vert" in name or "ind" in name]
    likely = [name for name in likely if not name.startswith(("tex", "uv"))]
    if len(likely) > 1:
        raise MeshError(
            f"faces have the lists {', '.join(likely)}, and none is called vertex_indices: it is "
            "not clear which one holds the corners."
        )
    return likely[0] if likely else None


def _polygons(element: Element, column: Column) -> tuple[Ints, Ints]:
    """Corners of all faces, and their numbers."""
    corners = column.integers()
    if element.name in _FACES:
        return corners, column.lengths
    strips = []
    for row in np.split(corners, np.cumsum(column.lengths)[:-1]):
        strips += [strip[strip != -1] for strip in np.split(row, np.flatnonzero(row == -1))]
    F = np.concatenate([np.zeros((0, 3), np.int64), *map(triangles_of_strip, strips)])
    return F.ravel(), np.full(len(F), 3, dtype=np.int64)


def _header(data: bytes) -> tuple[str, list[Element], int]:
    """Byte order ('' for text), the elements, and where the tables begin."""
    first = re.match(rb"\s*ply[ \t]*(\r?\n|\r)", data)
    end = first and re.compile(_END[first[1][-1:]]).search(data)
    if not first or not end:
        raise MeshError("the file has no PLY header from 'ply' to 'end_header'.")
    order, elements = None, []
    for line in data[first.end() : end.start()].decode("ascii", "replace").splitlines():
        match line.split():
            case ["format", name, *_] if name in _BYTE_ORDER:
                order = _BYTE_ORDER[name]
            case ["element", name, size] if size.isdigit() and len(size) < 19:
                elements.append(Element(name.lower(), int(size), ()))
            case ["property", "list", count, kind, name] if (
                elements and _TYPES.get(count, "f")[0] != "f" and kind in _TYPES
            ):
                column = Property(name.lower(), _TYPES[kind], _TYPES[count])
                elements.append(_extended(elements.pop(), column))
            case ["property", kind, name] if elements and kind in _TYPES:
                column = Property(name.lower(), _TYPES[kind])
                elements.append(_extended(elements.pop(), column))
            case [("comment" | "obj_info"), *_] | []:
                pass
            case _:
                raise MeshError(f"this line of the PLY header is not understood: {line!r}.")
    if order is None:
        raise MeshError("the PLY header has no format line.")
    for names in ([e.name for e in elements], *([p.name for p in e.properties] for e in elements)):
        if len(set(names)) < len(names):
            raise MeshError(f"the PLY header declares one name twice, of {', '.join(names)}.")
    return order, elements, end.end()


def _extended(element: Element, column: Property) -> Element:
    return Element(element.name, element.size, (*element.properties, column))
