"""The text formats read once more, as simply as can be: what a file says is decided twice."""

import re
import struct

import numpy as np


def _rows(data):
    text = re.sub(rb"\\\r?\n", b" ", data.removeprefix(b"\xef\xbb\xbf"))
    rows = [line.split(b"#")[0].split() for line in re.split(rb"\r\n|\r|\n", text)]
    return [row for row in rows if row]


def _obj(data):
    V, polygons = [], []
    for kind, *values in _rows(data):
        if kind == b"v":
            V.append([float(x) for x in values[:3]])
        elif kind == b"f":
            corners = [int(corner.split(b"/")[0]) for corner in values]
            polygons.append([i - 1 if i > 0 else len(V) + i for i in corners])
    return V, polygons


def _off(data):
    rows = _rows(data)
    tokens = [*rows[0][1:], *(rows[1] if len(rows[0]) == 1 else [])]
    body = rows[1:] if len(rows[0]) > 1 else rows[2:]
    n, m = int(tokens[0]), int(tokens[1])
    V = [[float(x) for x in row[:3]] for row in body[:n]]
    return V, [[int(i) for i in row[1 : int(row[0]) + 1]] for row in body[n : n + m]]


def _stl(data):
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        rows = np.frombuffer(data, "<12f4,<u2", offset=84)["f0"]
        V = rows[:, 3:].reshape(-1, 3).astype(float).tolist()
    else:
        V = [[float(x) for x in row[1:4]] for row in _rows(data) if row[0] == b"vertex"]
    return V, np.arange(len(V)).reshape(-1, 3).tolist()


def _ply(data):
    head, rest = re.split(rb"end_header[^\n]*\n", data, maxsplit=1)
    form, elements = "", []
    for row in (line.decode("latin-1").split() for line in head.splitlines()):
        if row[:1] == ["format"]:
            form = row[1]
        elif row[:1] == ["element"]:
            elements.append((row[1], int(row[2]), []))
        elif row[:1] == ["property"]:
            elements[-1][2].append(row[1:])
    order = "<" if "little" in form else ">"
    next_row = _from_text(rest) if form == "ascii" else _from_bytes(rest, order)
    V, polygons = [], []
    for name, size, properties in elements:
        for _ in range(size):
            row, take = {}, next_row()
            for *kinds, column in properties:
                if kinds[0] == "list":
                    value = [take(kinds[2]) for _ in range(take(kinds[1]))]
                else:
                    value = take(kinds[0])
                row.setdefault(column, value)
            if name == "vertex":
                V.append([row[c] for c in "xyz"])
            if name == "face":
                polygons.append(row.get("vertex_indices", row.get("vertex_index")))
    return V, polygons


def _from_text(rest):
    rows = iter([line.split() for line in rest.splitlines() if line.strip()])

    def next_row():
        tokens = iter(next(rows))
        return lambda kind: _TEXT.get(kind, int)(next(tokens))

    return next_row


def _single(token):
    with np.errstate(over="ignore"):  # of columns that nobody looks at
        return np.float32(token)


_TEXT = {"double": float, "float64": float, "float": _single, "float32": _single}
_CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
          "float": "f", "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
          "int32": "i", "uint32": "I", "float32": "f", "float64": "d"}  # fmt: skip


def _from_bytes(rest, order):
    at = 0

    def take(kind):
        nonlocal at
        code = order + _CODES[kind]
        (value,) = struct.unpack_from(code, rest, at)
        at += struct.calcsize(code)
        return value

    return lambda: take


# From the content of a file that was accepted to its vertices and polygons.
READERS = {".obj": _obj, ".off": _off, ".ply": _ply, ".stl": _stl}
