"""Text files of meshes: lines, numbers and indices, as programs of all countries write them.

Nothing is guessed.  ``1.0D+00`` is Fortran for 1.0; ``2,7`` is 2.7 where every number of the file
is written so, and refused where it may as well be a thousand.  UTF-16 is decoded.  What is no
finite number is refused and shown.
"""

from __future__ import annotations

import codecs
import re

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

# No two ways to match the same digits: or lines that do not match would take for ever.
NUMBER = rb"[-+]?(?:\d+(?:[.,]\d*)?|\.\d+)(?:[eEdD][-+]?\d+)?"
COUNT = re.compile(rb"\d{1,18}")
_NUMBER = re.compile(NUMBER)
_INDEX = re.compile(rb"[-+]?\d{1,15}(?:\.\d*)?(?:[eE][-+]?\d{1,2})?")
_DECIMAL_COMMA = re.compile(rb"[-+]?\d+,\d+(?:e[-+]?\d+)?")
_THOUSANDS = re.compile(rb"[-+]?[1-9]\d{0,2},\d{3}")
_FORTRAN = bytes.maketrans(b"dD", b"ee")
# The longer marks first: that of UTF-32 begins with that of UTF-16.
_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


def plain_text(data: bytes) -> bytes:
    """The text of a file in an encoding that extends ASCII; refuses binary files."""
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return data[len(mark) :] if encoding == "utf-8" else _decoded(data, encoding)
    # What CP/M and DOS put at the end.
    text = data.rstrip(b"\0\x1a")
    if b"\0" not in text:
        return text
    for encoding, empty in (("utf-16-le", data[1:200:2]), ("utf-16-be", data[0:200:2])):
        if empty.strip(b"\0") == b"":
            return _decoded(data, encoding)
    raise MeshError("the file is binary, where text is expected.")


def _decoded(data: bytes, encoding: str) -> bytes:
    return data.decode(encoding, "replace").encode().rstrip(b"\0\x1a")


def text_lines(data: bytes) -> list[bytes]:
    """Lines without comments and blank ones, continued ones joined."""
    joined = plain_text(data).replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")
    stripped = (line.split(b"#", 1)[0].strip() for line in joined.splitlines())
    return [line for line in stripped if line]


def coordinates(rows: list[bytes], skip: int = 0, count: int = 3) -> Floats:
    """The numbers of rows behind the first ``skip`` words; shape (n, count)."""
    tokens = [token for row in rows for token in row.split()[skip : skip + count]]
    if len(tokens) != count * len(rows):
        short = next(row for row in rows if len(row.split()) < skip + count)
        raise _no("vertex", "made of finite numbers", short)
    try:
        values = numbers(tokens)
    except ValueError as error:
        if isinstance(error, MeshError):
            raise
        wrong = next(i for i, token in enumerate(tokens) if not _NUMBER.fullmatch(token))
        raise _no("vertex", "made of finite numbers", rows[wrong // count]) from error
    if not np.isfinite(values).all():
        row = rows[int(np.argmin(np.isfinite(values))) // count]
        raise MeshError(f"a vertex has infinite coordinates: {shown(row)}.")
    return values.reshape(-1, count)


def numbers(tokens: list[bytes]) -> Floats:
    """Decimal numbers, maybe too large for floating point; ValueError if one is none."""
    joined = b" ".join(tokens)
    odd = joined.translate(None, b"0123456789+-.eE ")
    if odd:
        joined = joined.translate(_FORTRAN)
        odd = odd.translate(None, b"dD")
    if odd and not odd.translate(None, b","):
        return np.array([float(token) for token in _with_decimal_points(joined.split())])
    if odd:
        raise ValueError("what is not a number")
    return np.array([float(token) for token in joined.split()])


def _with_decimal_points(tokens: list[bytes]) -> list[bytes]:
    with_comma = [token for token in tokens if b"," in token]
    if (
        any(b"." in token for token in tokens)
        or not all(_DECIMAL_COMMA.fullmatch(token) for token in with_comma)
        or all(_THOUSANDS.fullmatch(token) for token in with_comma)
    ):
        raise MeshError(
            f"it is not clear what commas in numbers mean here, as in {shown(with_comma[0])}: "
            "decimals, thousands, or ends. Write decimal points, and spaces between numbers."
        )
    return [token.replace(b",", b".") for token in tokens]


def indices(tokens: list[bytes]) -> Ints:
    """Whole numbers, also written as 3.0; ValueError if one is none."""
    if any(not _INDEX.fullmatch(token) for token in tokens):
        raise ValueError("what is not a whole number")
    if not b"".join(tokens).translate(None, b"0123456789+-"):
        return np.array([int(token) for token in tokens], dtype=np.int64)
    return whole(np.array([float(token) for token in tokens]))


def whole(values: Floats) -> Ints:
    """Floating-point numbers as integers; ValueError if one is not a whole number below 2^53."""
    if not (np.abs(values) < 2.0**53).all() or (values != np.rint(values)).any():
        raise ValueError("what is not a whole number")
    return values.astype(np.int64)


def row_of_indices(tokens: list[bytes], row: bytes) -> list[int]:
    """The corners of a face, or an error that shows its row."""
    try:
        return indices(tokens).tolist()
    except ValueError as error:
        raise _no("face", "made of indices", row) from error


def shown(row: bytes) -> str:
    """The beginning of a row, for messages."""
    return repr(row[:60].decode(errors="replace"))


def _no(what: str, made: str, row: bytes) -> MeshError:
    return MeshError(f"this line is not a {what}, which is {made}: {shown(row)}.")
