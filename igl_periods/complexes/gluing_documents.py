r"""Surfaces as JSON: ``{"lengths": [[…]], "twin": [[…]]}``, and more where more is known.

==============  =================================================================================
``lengths``     (m, 3) numbers, the doubles of the complex
``twin``        (m, 3) half-edges 3 f + s, −1 on the boundary
``same``        (m, 3) booleans, where some glued sides run in the same direction
``exact``       ``{"kinds": (m, 3), "lengths": [text, …]}``: ``"sqrt(3/4)"`` or a ball
``polygons``    ``{"vertices": [[[x, y], …], …], "gluing": [[[p, s], [p, s]], …], "field": …}``
==============  =================================================================================

A coordinate of a polygon is a text, ``"3/4"``; a list of texts, the coefficients of an element of
the field of the polynomial ``{"polynomial": [-1, -1, 1], "root": 1}`` (its real roots are counted
from 0, in increasing order); a ball; or a number, where it is a double that may be rounded.  From
polygons the surface is glued again, which gives the same complex.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any

import flint
import numpy as np

from igl_periods.errors import ComplexError, MeshError

from .exact_lengths import LengthsByKind, by_kind, square_root
from .exact_numbers import ComputedNumber, FieldElement, Number, RealField
from .gluings import reversing_sides
from .polygon_gluings import GluedPolygons

if TYPE_CHECKING:
    from .delta_complex import DeltaComplex

_DIGITS, _BITS = 200, 720


def document_of(K: DeltaComplex) -> dict[str, Any]:
    """The surface as an object of JSON."""
    document: dict[str, Any] = {"lengths": K.lengths.tolist(), "twin": K.twin.tolist()}
    if K.n_reversing_edges:
        document["same"] = reversing_sides(K.twin, K.sign).tolist()
    if K.polygons is not None:
        document["polygons"] = _polygons_document(K.polygons)
    elif K.exact_lengths is not None and K.mollification == 0.0:
        document["exact"] = _lengths_document(K)
    return document


def surface_in_document(make: type[DeltaComplex], text: str | Mapping[str, Any]) -> DeltaComplex:
    """The surface of an object of JSON, or of its text."""
    try:
        document = json.loads(text) if isinstance(text, str) else text
        lengths, twin = np.array(document["lengths"]), np.array(document["twin"])
        exact = _exact_lengths(document["exact"]) if "exact" in document else None
        given = document.get("polygons")
        polygons = None if given is None else _polygons(given)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise MeshError(
            f'the file holds no gluing: {{"lengths": [[…]], "twin": [[…]]}} with three numbers for '
            f"each triangle is expected ({error})."
        ) from error
    if polygons is not None:
        K = make.from_polygons(*polygons)
        same = K.twin.shape == twin.shape and bool((K.twin == twin).all())
        if not same or not np.allclose(K.lengths, lengths, rtol=1e-9, atol=0.0):
            raise ComplexError("the polygons of the file are not divided into the triangles of it.")
        return K
    K = make.from_gluing(lengths, twin, document.get("same"))
    if exact is None:
        return K
    kinds, formulas = exact
    if kinds.shape != K.twin.shape or not 0 <= kinds.min() <= kinds.max() < len(formulas):
        raise ComplexError(f"the exact lengths of the file are not those of {K.n_faces} faces.")
    return replace(K, exact_lengths=by_kind(K.edge, kinds, formulas))


def _lengths_document(K: DeltaComplex) -> dict[str, Any]:
    exact = K.exact_lengths
    assert exact is not None
    if isinstance(exact, LengthsByKind):
        kind, formulas = exact.kind, list(exact.formulas)
        texts = [_formula_text(formula) for formula in formulas]
    else:
        kind = np.arange(K.n_edges)
        texts = [_ball_text(x) for x in exact(_BITS)]
    return {"kinds": kind[K.edge].tolist(), "lengths": texts}


def _formula_text(formula: Any) -> str:
    if isinstance(formula, partial) and formula.func is square_root:
        return f"sqrt({formula.args[0]})"
    if isinstance(formula, partial) and formula.func is _ball:
        return str(formula.args[0])
    with flint.ctx.workprec(_BITS):
        return _ball_text(formula())


def _ball_text(x: flint.arb) -> str:
    with flint.ctx.workprec(_BITS):
        return str(x.str(_DIGITS, more=True))


def _exact_lengths(document: Any) -> tuple[Any, list[Any]]:
    kinds = np.array(document["kinds"], dtype=np.int64)
    return kinds, [_formula(text) for text in document["lengths"]]


def _formula(text: str) -> Any:
    if text.startswith("sqrt(") and text.endswith(")"):
        return partial(square_root, Fraction(text[5:-1]))
    return partial(_ball, text)


def _ball(text: str, bits: int = 0) -> flint.arb:
    with flint.ctx.workprec(_BITS):
        return flint.arb(text)


def _polygons_document(polygons: GluedPolygons) -> dict[str, Any]:
    numbers = [c for p in polygons.vertices for v in p for c in v]
    field = next((x.field for x in numbers if isinstance(x, FieldElement)), None)
    document: dict[str, Any] = {
        "vertices": [
            [[_number_document(c, polygons.rounded) for c in v] for v in p]
            for p in polygons.vertices
        ],
        "gluing": [[list(one), list(other)] for one, other in polygons.gluing],
    }
    if field is not None:
        document["field"] = {"polynomial": list(field.coefficients), "root": field.index}
    return document


def _number_document(x: Number, rounded: bool) -> Any:
    if isinstance(x, FieldElement):
        return [str(c) for c in x.coefficients]
    if isinstance(x, ComputedNumber):
        return _ball_text(x.ball(_BITS))
    return float(x) if rounded else str(x)


def _polygons(document: Any) -> tuple[Any, Any]:
    field = document.get("field")
    known = None if field is None else RealField(tuple(field["polynomial"]), field["root"])
    vertices = [
        [tuple(_number(c, known) for c in vertex) for vertex in polygon]
        for polygon in document["vertices"]
    ]
    return vertices, [tuple(map(tuple, pair)) for pair in document["gluing"]]


def _number(x: Any, field: RealField | None) -> Any:
    if isinstance(x, list):
        if field is None:
            raise ValueError("a coordinate in a field that is not given")
        return field.element(*(Fraction(c) for c in x))
    if isinstance(x, str) and "+/-" in x:
        return ComputedNumber(partial(_ball, x))
    return Fraction(x) if isinstance(x, str) else float(x)
