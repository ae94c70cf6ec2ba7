"""Results as JSON, for programs.

A complex matrix is ``{"real": [[…]], "imag": [[…]]}``.  Every mesh has one document, of one of
three kinds, told apart by what they hold:

==================  =====================================================================
``mesh_marking``    ``compute``: the period matrix, also Siegel reduced
``identification``  ``identify``: named surfaces near the period matrix
``error``           the mesh was refused: ``kind`` is the name of the exception
==================  =====================================================================

With ``--component all`` the first two are in a list ``components``.  Every document says of which
``file`` it is and what was warned of (``warnings``: a tolerance that was not met is one of them),
and has a ``schema`` number, which grows when a reader of the old form would misread the new one;
new keys may come at any time.  All of it is written down in ``documents.schema.json`` beside this
module, in the language of JSON Schema (:func:`json_schema`).
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.metadata import version
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.complexes import DeltaComplex, walk_vertices
from igl_periods.enclosures import PeriodEnclosure
from igl_periods.periods import PeriodMatrix
from igl_periods.surfaces import Identification
from igl_periods.topology import homology_basis

SCHEMA = 1


def json_schema() -> dict[str, Any]:
    """What documents look like, as JSON Schema (draft 2020-12)."""
    text = files(__package__).joinpath("documents.schema.json").read_text("utf-8")
    schema: dict[str, Any] = json.loads(text)
    return schema


def document_to_json(
    file: str, body: dict[str, Any], warned: Sequence[Warning | str] = ()
) -> dict[str, Any]:
    """The document of one mesh: what was found, or why nothing, and what was warned of."""
    return {
        "schema": SCHEMA,
        "version": version("igl_periods"),
        "file": file,
        **body,
        "warnings": [{"kind": type(w).__name__, "message": str(w)} for w in warned],
    }


def refusal_to_json(error: Exception) -> dict[str, Any]:
    """Why a mesh was refused."""
    return {"error": {"kind": type(error).__name__, "message": str(error)}}


def identification_to_json(
    pm: PeriodMatrix | PeriodEnclosure, found: Identification
) -> dict[str, Any]:
    """One surface: how well its matrix is known, and the named surfaces near it."""
    matches = [
        {
            "name": match.surface.name,
            "aliases": list(match.surface.aliases),
            "distance": match.distance,
            "deviation": match.deviation,
            "gamma": matrix_to_json(match.gamma),
            "claim": match.claim,
        }
        for match in found
    ]
    return {
        "surface": surface_to_json(pm),
        "certified": isinstance(pm, PeriodEnclosure) or pm.certified,
        "bound": None if pm.bound is None else float(pm.bound),
        "identification": {
            "matches": matches,
            "compared": list(found.compared),
            "undecided": list(found.undecided),
            "radius": found.radius,
        },
    }


def surface_to_json(pm: PeriodMatrix | PeriodEnclosure) -> dict[str, Any]:
    """What the matrix is about."""
    K = pm.complex
    return {
        "vertices": K.n_vertices,
        "edges": K.n_edges,
        "faces": K.n_faces,
        "genus": pm.genus,
        "mollification": K.mollification,
    }


def matrix_to_json(matrix: NDArray[Any]) -> Any:
    """Nested lists of numbers; complex matrices as a pair of real ones."""
    if np.iscomplexobj(matrix):
        return {"real": matrix.real.tolist(), "imag": matrix.imag.tolist()}
    return matrix.tolist()


def period_matrix_to_json(pm: PeriodMatrix) -> dict[str, Any]:
    """All estimates and bounds of a period matrix, in its marking."""
    eigenvalues = pm.symplectic_eigenvalues.tolist()
    return {
        "genus": pm.genus,
        "matrix": matrix_to_json(pm.matrix),
        "certified": pm.certified,
        "bound": pm.bound,
        "rigorous": pm.rigorous,
        "rounding_allowance": pm.rounding_allowance if pm.certified else None,
        "entry_bounds": None if pm.entry_bounds is None else matrix_to_json(pm.entry_bounds),
        "symplectic_eigenvalues": eigenvalues,
        "primal": matrix_to_json(pm.primal),
        "dual": matrix_to_json(pm.dual),
        "mean": matrix_to_json(pm.mean),
        "dirichlet": matrix_to_json(pm.dirichlet),
    }


def cycles_to_json(K: DeltaComplex) -> dict[str, list[list[int]]]:
    """The canonical cycles as closed walks: the vertices passed, as rows of V."""
    walks = [K.labels[walk_vertices(K, walk)].tolist() for walk in homology_basis(K)]
    g = len(walks) // 2
    return {"a": walks[:g], "b": walks[g:]}


def result_to_json(
    pm: PeriodMatrix, reduced: PeriodMatrix | None, gamma: NDArray[Any] | None
) -> dict[str, Any]:
    """One surface: its matrix in the marking of the mesh, and Siegel reduced.

    ``reduced`` is the matrix in the marking ``gamma`` acts to: Π_reduced = (aΠ + b)(cΠ + d)⁻¹.
    Both are None, and ``reduced_marking`` is null, if it was not reduced.
    """
    reduced_marking = None
    if reduced is not None and gamma is not None:
        reduced_marking = {**period_matrix_to_json(reduced), "gamma": matrix_to_json(gamma)}
    return {
        "surface": surface_to_json(pm),
        "mesh_marking": {**period_matrix_to_json(pm), "cycles": cycles_to_json(pm.complex)},
        "reduced_marking": reduced_marking,
    }
