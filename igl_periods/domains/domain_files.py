"""Plane domains from files: polygons with holes in GeoJSON and SVG.

A GeoJSON file holds one Polygon: as a geometry, in a feature, or alone in a collection; its
coordinates are those of the plane.  The shapes of an SVG drawing are closed and have straight sides
(polygon, rect, path); all of them together are one domain, whose outer boundary is the shape of the
largest area.  Transforms and the view box are applied, and y points upwards, as it does in the
plane.

What is anything else is refused: curves, lines that are not closed, several polygons.
"""

from __future__ import annotations

import json
from os import PathLike
from pathlib import Path
from typing import Any, TypeAlias
from xml.etree.ElementTree import ParseError

import numpy as np

from igl_periods.arrays import Complexes
from igl_periods.errors import MeshError
from igl_periods.machine import require

# Extensions of the files that hold plane domains.
DOMAIN_EXTENSIONS = (".geojson", ".svg")

Rings: TypeAlias = tuple[Complexes, list[Complexes]]


def is_domain_file(path: str | PathLike[str]) -> bool:
    """Whether a file of this name holds a plane domain."""
    return Path(path).suffix.lower() in DOMAIN_EXTENSIONS


def read_domain(path: str | PathLike[str]) -> Rings:
    """Read a polygon with holes from a GeoJSON or SVG file.

    Parameters
    ----------
    path : path-like
        ``name.geojson`` or ``name.svg``.

    Returns
    -------
    outer : (n,) complex
        The corners of the outer boundary.
    holes : list of (k,) complex
        Those of the holes: arguments of :func:`~igl_periods.surfaces.planar_domain`, which looks
        whether they are a domain.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    MeshError
        If the file holds no polygon with holes.
    MissingExtraError
        If svgelements, which reads SVG, is not installed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import igl_periods as ip
    >>> text = '{"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 1], [0, 0]]]}'
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "plate.geojson")
    ...     written = path.write_text(text)
    ...     outer, holes = ip.read_domain(path)
    >>> outer.tolist(), holes
    ([0j, (2+0j), (2+1j), 0j], [])
    """
    if not is_domain_file(path):
        known = " and ".join(DOMAIN_EXTENSIONS)
        raise MeshError(f"plane domains are in files {known}, not in {Path(path).name}.")
    if Path(path).suffix.lower() == ".svg":
        return _read_svg(path)
    try:
        document = json.loads(Path(path).read_text(encoding="utf-8"))
        geometries = list(_geometries(document))
        if len(geometries) != 1 or geometries[0]["type"] != "Polygon":
            found = ", ".join(str(geometry["type"]) for geometry in geometries) or "nothing"
            raise MeshError(f"the file holds {found}: one Polygon is needed.")
        rings = [np.array(ring, dtype=np.float64) for ring in geometries[0]["coordinates"]]
        outer, *holes = [ring[:, 0] + 1j * ring[:, 1] for ring in rings]
    except MeshError:
        raise
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, RecursionError) as error:
        raise MeshError(f"this is not a GeoJSON file with a polygon ({error}).") from error
    return outer, holes


def _geometries(document: Any) -> Any:
    """The geometries of a GeoJSON object, those of collections one by one."""
    kind = document["type"]
    if kind == "FeatureCollection":
        for feature in document["features"]:
            yield from _geometries(feature)
    elif kind == "GeometryCollection":
        for geometry in document["geometries"]:
            yield from _geometries(geometry)
    elif kind == "Feature":
        if document["geometry"] is not None:
            yield from _geometries(document["geometry"])
    elif kind == "MultiPolygon":
        for polygon in document["coordinates"]:
            yield {"type": "Polygon", "coordinates": polygon}
    else:
        yield document


def _read_svg(path: str | PathLike[str]) -> Rings:
    require("reading SVG", "svgelements")
    import svgelements

    with Path(path).open("rb") as file:
        try:
            drawing = svgelements.SVG.parse(file)
        except (ParseError, ValueError) as error:
            raise MeshError(f"this is not an SVG file ({error}).") from error
    shapes = [shape for shape in drawing.elements() if isinstance(shape, svgelements.Shape)]
    rings = [ring for shape in shapes for ring in _rings(svgelements.Path(shape), type(shape))]
    if not rings:
        raise MeshError("the drawing has no shapes: a polygon is needed.")
    areas = [abs(np.imag(np.conj(z) * np.roll(z, -1)).sum()) for z in rings]
    outer = rings.pop(int(np.argmax(areas)))
    return outer, rings


def _rings(outline: Any, kind: type) -> list[Complexes]:
    """The closed polygons of a path."""
    name = kind.__name__.removeprefix("Simple").lower()
    rings = []
    for part in outline.reify().as_subpaths():
        segments = list(part)
        kinds = [type(segment).__name__ for segment in segments]
        curves = sorted(set(kinds) - {"Move", "Line", "Close"})
        if curves:
            raise MeshError(
                f"a {name} of the drawing has curves ({', '.join(curves)}): a polygon has straight "
                "sides. Replace curves by polygons in the drawing first."
            )
        # Upwards is −y.
        ends = [(segment.end.x, segment.end.y) for segment in segments]
        z = np.array([x - 1j * y for x, y in ends], dtype=np.complex128)
        if kinds[-1] != "Close" and z[0] != z[-1]:
            (a, b), (x, y) = ends[0], ends[-1]
            raise MeshError(
                f"a {name} of the drawing is not closed: it leads from ({a:.6g}, {b:.6g}) to "
                f"({x:.6g}, {y:.6g})."
            )
        rings.append(z)
    return rings
