"""Gluings of triangles from JSON: ``{"lengths": [[…]], "twin": [[…]]}``."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from igl_periods.complexes import DeltaComplex
from igl_periods.errors import MeshError


def read_gluing(path: str | PathLike[str]) -> DeltaComplex:
    """Read triangles glued along their sides from a JSON file.

    The file holds an object with the keys ``lengths`` and ``twin``, lists of three numbers per
    triangle as in :meth:`DeltaComplex.from_gluing`, and maybe what :meth:`DeltaComplex.to_json`
    writes beside them: exact lengths, polygons.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    MeshError
        If it is no such object.
    ComplexError
        If the gluing is none.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise MeshError(f"the file holds no gluing: it is not text ({error}).") from error
    return DeltaComplex.from_json(text)
