r"""Surfaces of sage-flatsurf, read by their methods and written as plain data.

A surface of sage-flatsurf has polygons with labels; ``S.polygon(label).vertices()`` are vectors
over a field, and ``S.opposite_edge(label, k)`` is the side glued to side k, which runs from vertex
k to vertex k + 1 as here.  Numbers keep their field: the elements of Q and of embedded number
fields become exact ones with the same minimal polynomial.  Nothing of Sage is imported.

A side that is glued to itself, by the rotation by π about its midpoint, gets that as a vertex.

References
----------
Delecroix, Hooper, Rüth, "sage-flatsurf" (2023), https://flatsurf.github.io/sage-flatsurf/.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from igl_periods.complexes import DeltaComplex, FieldElement, Number, Point, read_point
from igl_periods.errors import ComplexError

_MOST_POLYGONS = 100_000
Side = tuple[Any, int]


def from_flatsurf(S: Any) -> DeltaComplex:
    """The complex of a closed surface of sage-flatsurf.

    Parameters
    ----------
    S : surface
        Any object with ``labels()``, ``polygon(label)`` and ``opposite_edge(label, edge)``, its
        polygons with ``vertices()``.

    Raises
    ------
    ComplexError
        If it has no such methods, infinitely many polygons or a boundary, or glues sides by
        similarities that are not isometries.

    Examples
    --------
    >>> import flatsurf  # doctest: +SKIP
    >>> import igl_periods as ip
    >>> ip.from_flatsurf(flatsurf.translation_surfaces.regular_octagon()).genus  # doctest: +SKIP
    2
    """
    for method in ("labels", "polygon", "opposite_edge"):
        if not callable(getattr(S, method, None)):
            raise ComplexError(
                f"a surface of sage-flatsurf has the method {method}, and {type(S).__name__} has "
                "none."
            )
    labels = []
    for label in S.labels():
        labels.append(label)
        if len(labels) > _MOST_POLYGONS:
            raise ComplexError(f"the surface has more than {_MOST_POLYGONS} polygons.")
    number = {label: p for p, label in enumerate(labels)}
    vertices = [[read_point(v)[0] for v in S.polygon(label).vertices()] for label in labels]
    opposite = {
        (p, k): _opposite(S, number, label, k)
        for p, label in enumerate(labels)
        for k in range(len(vertices[p]))
    }
    folded = {side for side, other in opposite.items() if side == other}
    place = _places(vertices, folded)
    pairs = [(place[a], place[b]) for a, b in opposite.items() if a < b]
    pairs += [(place[a], (place[a][0], place[a][1] + 1)) for a in sorted(folded)]
    return DeltaComplex.from_polygons(
        [_with_midpoints(p, polygon, folded) for p, polygon in enumerate(vertices)], pairs
    )


def to_flatsurf_dict(K: DeltaComplex) -> dict[str, Any]:
    """Polygons and gluings as plain data from which sage-flatsurf makes the surface.

    Returns
    -------
    dict
        ``"field"`` is None for Q, or ``{"polynomial": [c_0, …], "near": text}``, the generator of
        the field being the root nearest to that decimal number; ``"polygons"`` maps labels to lists
        of vertices, each coordinate the list of its coefficients as texts (one for a rational
        number); ``"gluings"`` are pairs of (label, edge).  In Sage,

        .. code-block:: python

            S = MutableOrientedSimilaritySurface(field)
            for label, vertices in data["polygons"].items():
                S.add_polygon(Polygon(vertices=vertices), label=label)
            for one, other in data["gluings"]:
                S.glue(one, other)

    Raises
    ------
    ComplexError
        If the surface was not glued from polygons with exact coordinates.

    Examples
    --------
    >>> import igl_periods as ip
    >>> sorted(ip.to_flatsurf_dict(ip.surfaces.l_shape(2, 2)))
    ['field', 'gluings', 'polygons']
    """
    polygons = K.polygons
    if polygons is None or not polygons.is_exact:
        raise ComplexError(
            "the surface was not glued from polygons with exact coordinates: make it with "
            "DeltaComplex.from_polygons, from integers, fractions or algebraic numbers."
        )
    numbers = [c for p in polygons.vertices for v in p for c in v]
    field = next((x.field for x in numbers if isinstance(x, FieldElement)), None)
    return {
        "field": None
        if field is None
        else {
            "polynomial": list(field.coefficients),
            "near": field.root(128).str(30, radius=False),
        },
        "polygons": {
            p: [[_coefficients(x), _coefficients(y)] for x, y in polygon]
            for p, polygon in enumerate(polygons.vertices)
        },
        "gluings": [(one, other) for one, other in polygons.gluing],
    }


def _opposite(S: Any, number: dict[Any, int], label: Any, k: int) -> tuple[int, int]:
    other = S.opposite_edge(label, k)
    if other is None or other[0] not in number:
        raise ComplexError(f"side {k} of the polygon {label!r} is glued to nothing.")
    return number[other[0]], int(other[1])


def _places(vertices: list[list[Point]], folded: set[tuple[int, int]]) -> dict[Side, Side]:
    """The numbers of the sides when the folded ones are halved; of those, of the first half."""
    place: dict[Side, Side] = {}
    for p, polygon in enumerate(vertices):
        extra = 0
        for k in range(len(polygon)):
            place[p, k] = p, k + extra
            extra += (p, k) in folded
    return place


def _with_midpoints(p: int, polygon: list[Point], folded: set[tuple[int, int]]) -> list[Point]:
    found: list[Point] = []
    for k, (a, b) in enumerate(zip(polygon, [*polygon[1:], polygon[0]])):
        found.append(a)
        if (p, k) in folded:
            found.append((_mean(a[0], b[0]), _mean(a[1], b[1])))
    return found


def _mean(x: Any, y: Any) -> Any:
    return (x + y) * Fraction(1, 2)


def _coefficients(x: Number) -> list[str]:
    return [str(c) for c in x.coefficients] if isinstance(x, FieldElement) else [str(x)]
