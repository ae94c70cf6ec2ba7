"""Gluings of triangles from JSON: ``{"lengths": [[…]], "twin": [[…]]}``."""

from __future__ import annotations

import json
from os import PathLike
from pathlib import Path

import numpy as np

from igl_periods.complexes import DeltaComplex
from igl_periods.errors import MeshError


def read_gluing(path: str | PathLike[str]) -> DeltaComplex:
    """Read triangles glued along their sides from a JSON file.

    The file holds an object with the keys ``lengths`` and ``twin``, lists of three numbers per
    triangle as in :meth:`DeltaComplex.from_gluing`.

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
        document = json.loads(Path(path).read_text(encoding="utf-8"))
        lengths, twin = np.array(document["lengths"]), np.array(document["twin"])
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise MeshError(
            f'the file holds no gluing: {{"lengths": [[…]], "twin": [[…]]}} with three numbers for '
            f"each triangle is expected ({error})."
        ) from error
    return DeltaComplex.from_gluing(lengths, twin)
