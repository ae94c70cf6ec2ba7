"""Files compressed by gzip, and what is not a mesh though its name says so."""

from __future__ import annotations

import gzip
import zlib
from pathlib import Path

from igl_periods.errors import MeshError
from igl_periods.machine import available_memory

# The least part of the memory that is left once the content is read and taken apart.
_PARTS = 8
_NO_MESH = {
    b"version https://git-lfs": "a pointer of Git LFS and not the file itself: run 'git lfs pull'",
    b"<!doctype html": "a web page",
    b"<html": "a web page",
    b"%pdf": "a PDF document",
    b"\x89png": "a picture",
}


def content(file: Path, compressed: bool) -> bytes:
    """The bytes of a file, decompressed if they are compressed.

    Raises
    ------
    MeshError
        If the file is empty, or its compression is corrupt, or it would fill the memory.
    """
    try:
        data = _decompressed(file) if compressed else file.read_bytes()
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise MeshError(
            f"the file is not a gzip file, or truncated or corrupt ({error})."
        ) from error
    if not data:
        raise MeshError("the file is empty.")
    start = data[:100].lstrip().lower()
    for mark, what in _NO_MESH.items():
        if start.startswith(mark):
            raise MeshError(f"this is {what}.")
    if start.startswith(b"\x1f\x8b"):
        raise MeshError("the file is compressed by gzip: its name has to end in .gz.")
    return data


def _decompressed(file: Path) -> bytes:
    most = int(available_memory()) // _PARTS
    with gzip.open(file) as stream:
        data = stream.read(most + 1)
    if len(data) > most:
        raise MeshError(f"the file holds more than {most / 1e9:.3g} GB, too much for the memory.")
    return data
