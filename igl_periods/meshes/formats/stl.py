"""The STL format: three corners for every triangle, in text or 50 bytes each, no connectivity.

Nobody agrees about the rest.  In text, words come in capitals, and ``endsolid`` is missing or is
followed by anything; in binary files the header may begin with ``solid``, the number of triangles
may be wrong, and other things may follow them.  What counts is whole triangles.
"""

from __future__ import annotations

import re

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.errors import MeshError
from igl_periods.meshes.welding import compressed, first_equal_row

from .mesh_file import MeshFile, mesh_of_triangles
from .text import coordinates, plain_text, shown

_HEADER = 84
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
# Counts that programs write before they know how many triangles there will be.
_UNKNOWN = (0, 2**32 - 1)
_VERTEX = rb"\s+(vertex(?:\s+[^\s]+){3})"
_FACET_IN_TEXT = re.compile(
    rb"facet\s+normal(?:\s+(?!outer)\S+){0,3}\s+outer\s+loop%b\s+end\s?loop\s+end\s?facet(?!\S)"
    % (3 * _VERTEX)
)
# Between facets: the ends and beginnings of solids, with names of any words.
_FRAME = re.compile(rb"(?:end\s?)?(?:solid|facet)\b.*|color\b.*")


def read_stl(data: bytes) -> tuple[Floats, tuple[str, ...]]:
    """Read the corners of the triangles of an STL file.

    Returns
    -------
    corners : (3 m, 3) float
        Three for each triangle.
    warnings : tuple of str
        Of a wrong count, and bytes that were not read.

    Raises
    ------
    MeshError
        If the file is truncated, corrupt or no STL.
    """
    n_facets = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
    if len(data) >= _HEADER and len(data) == _HEADER + _FACET.itemsize * n_facets:
        return _binary(data, n_facets), ()
    if _is_text(data):
        text = plain_text(data).lower()
        ended = re.search(rb"end\s?solid", text[-1000:])
        return _text(text), () if ended else ("there is no 'endsolid': is the file complete?",)
    if len(data) < _HEADER:
        raise MeshError(
            "the file is not STL: neither text that begins with 'solid', nor long enough for the "
            f"header of a binary file, with {len(data)} bytes."
        )
    return _binary_by_its_length(data, n_facets)


def _is_text(data: bytes) -> bool:
    try:
        text = plain_text(data[:100_000])
    except MeshError:
        return False
    return re.match(rb"\s*(?:#.*\s*)*(?:solid|facet)\b", text, re.IGNORECASE) is not None


def _binary(data: bytes, n_facets: int) -> Floats:
    facets = np.frombuffer(data, _FACET, n_facets, offset=_HEADER)
    # NaN of any kind, which is refused later where it is used.
    with np.errstate(invalid="ignore"):
        return facets["corners"].reshape(-1, 3).astype(np.float64)


def _binary_by_its_length(data: bytes, announced: int) -> tuple[Floats, tuple[str, ...]]:
    """The triangles of a file whose length is not that of its count."""
    found, left = divmod(len(data) - _HEADER, _FACET.itemsize)
    if announced > found and announced not in _UNKNOWN:
        raise MeshError(
            f"{announced} triangles are announced, and there are bytes for {found}: the file is "
            "truncated, or no STL."
        )
    corners = _binary(data, found)
    behind = corners[3 * announced :]
    if announced not in _UNKNOWN and (left or not np.isfinite(behind).all() or not behind.any()):
        spare = len(data) - _HEADER - _FACET.itemsize * announced
        warning = f"{spare} bytes behind the {announced} triangles that are announced were ignored."
        return corners[: 3 * announced], (warning,)
    if left:
        raise MeshError(
            f"the file has {len(data)} bytes, which is not a whole number of triangles, and does "
            "not say how many there are: it is truncated, or not STL."
        )
    return corners, (f"{announced} triangles are announced, and there are {found}: all were read.",)


def _text(text: bytes) -> Floats:
    vertices: list[bytes] = []
    end = 0
    for facet in _FACET_IN_TEXT.finditer(text):
        _check_between(text[end : facet.start()])
        vertices += facet.groups()
        end = facet.end()
    rest = text[end:]
    last = re.search(rb"(?m)^\s*facet\s+normal", rest)
    if last and rest[last.start() :].count(b"vertex") <= 3 and b"endfacet" not in rest:
        raise MeshError("the last facet has no end: the file is truncated.")
    _check_between(rest)
    return coordinates(vertices, skip=1)


def _check_between(text: bytes) -> None:
    """Refuse what is neither a facet nor the frame of a solid."""
    for line in text.splitlines() if text.strip() else []:
        words = line.strip()
        if not words or words.startswith(b"#"):
            continue
        if not _FRAME.fullmatch(words) or words.startswith((b"facet", b"endfacet")):
            raise MeshError(
                "not every facet has three vertices, or its words are others than those of STL: "
                f"the file is corrupt at {shown(words)}."
            )


def mesh_from_stl(data: bytes) -> MeshFile:
    """The mesh in an STL file."""
    corners, warnings = read_stl(data)
    if len(corners) == 0:
        raise MeshError("the mesh is empty: no faces.")
    F = first_equal_row(corners).reshape(-1, 3)
    welded, faces = compressed(corners, F)
    return mesh_of_triangles(welded, faces, len(corners) - len(welded), warnings)
