"""Polygons with holes from files, and what is none."""

import json

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.domains.domain_files import is_domain_file, read_domain
from igl_periods.surfaces import planar_domain

FRAME = [
    [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]],
    [[1, 1], [3, 1], [3, 3], [1, 3], [1, 1]],
]
POLYGON = {"type": "Polygon", "coordinates": FRAME}
FEATURE = {"type": "Feature", "geometry": POLYGON, "properties": {"name": "frame"}}
OUTER = [0, 4, 4 + 4j, 4j]
HOLE = [1 + 1j, 3 + 1j, 3 + 3j, 1 + 3j]


def svg(path, shapes, attributes=""):
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{shapes}</svg>')
    return path


def capacity(outer, holes):
    return ip.capacity_matrix(planar_domain(outer, holes), degree=4).matrix[1, 1]


@pytest.mark.parametrize(
    "document",
    [
        POLYGON,
        FEATURE,
        {"type": "FeatureCollection", "features": [FEATURE]},
        {"type": "GeometryCollection", "geometries": [POLYGON]},
        {"type": "MultiPolygon", "coordinates": [FRAME]},
    ],
)
def test_geojson(tmp_path, document):
    path = tmp_path / "frame.geojson"
    path.write_text(json.dumps(document))
    outer, holes = read_domain(path)
    assert outer[:4].tolist() == OUTER
    assert [hole[:4].tolist() for hole in holes] == [HOLE]


@pytest.mark.parametrize(
    "shapes",
    [
        '<path d="M0 0h4v4H0z M1 1v2h2v-2z"/>',
        '<rect x="1" y="1" width="2" height="2"/><rect width="4" height="4"/>',
        '<g transform="translate(-1,2)"><polygon points="0,0 4,0 4,4 0,4"/>'
        '<polygon points="1,1 1,3 3,3 3,1" transform="rotate(90,2,2)"/></g>',
        '<polyline points="0,0 4,0 4,4 0,4 0,0"/><path d="M 1 1 L 3 1 L 3 3 L 1 3 L 1 1"/>',
    ],
)
def test_svg(tmp_path, shapes):
    pytest.importorskip("svgelements")
    outer, holes = read_domain(svg(tmp_path / "frame.svg", f"<title>a frame</title>{shapes}"))
    assert len(holes) == 1
    assert capacity(outer, holes) == pytest.approx(10.2340925693681, rel=1e-5)


def test_svg_upwards_is_upwards(tmp_path):
    pytest.importorskip("svgelements")
    path = svg(tmp_path / "t.svg", '<polygon points="0,0 4,0 0,3"/>', 'viewBox="0 0 4 4"')
    outer, holes = read_domain(path)
    assert not holes
    z = outer - outer[0]
    corner = z[np.argmax(np.abs(z.imag))]
    assert corner.imag < 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{}", "not a GeoJSON file with a polygon"),
        ("[1", "not a GeoJSON file with a polygon"),
        ('{"type": "Point", "coordinates": [0, 0]}', "holds Point: one Polygon is needed"),
        ('{"type": "FeatureCollection", "features": []}', "holds nothing: one Polygon"),
        (
            json.dumps({"type": "FeatureCollection", "features": [FEATURE, FEATURE]}),
            "holds Polygon, Polygon: one Polygon",
        ),
        ('{"type": "Feature", "geometry": null}', "holds nothing"),
        ('{"type": "Polygon", "coordinates": []}', "not a GeoJSON file with a polygon"),
        ('{"type": "Polygon", "coordinates": [[["x", "y"]]]}', "not a GeoJSON file with a polygon"),
    ],
)
def test_geojson_that_is_no_polygon(tmp_path, text, message):
    path = tmp_path / "none.geojson"
    path.write_text(text)
    with pytest.raises(ip.MeshError, match=message):
        read_domain(path)


@pytest.mark.parametrize(
    ("shapes", "message"),
    [
        ('<circle r="2"/>', "a circle of the drawing has curves .Arc."),
        ('<path d="M0 0 C1 1 2 2 3 0z"/>', "a path of the drawing has curves .CubicBezier."),
        (
            '<polyline points="0,0 1,0 1,1"/>',
            r"a polyline .* is not closed: .* \(0, 0\) to \(1, 1\)",
        ),
        ('<line x1="0" y1="0" x2="1" y2="1"/>', "a line of the drawing is not closed"),
        ("<text>abc</text>", "the drawing has no shapes"),
    ],
)
def test_drawings_of_no_polygon(tmp_path, shapes, message):
    pytest.importorskip("svgelements")
    with pytest.raises(ip.MeshError, match=message):
        read_domain(svg(tmp_path / "none.svg", shapes))


def test_other_files(tmp_path):
    (tmp_path / "none.svg").write_text("hello")
    pytest.importorskip("svgelements")
    with pytest.raises(ip.MeshError, match="not an SVG file"):
        read_domain(tmp_path / "none.svg")
    with pytest.raises(ip.MeshError, match=r"in files .geojson and .svg, not in a.obj"):
        read_domain(tmp_path / "a.obj")
    with pytest.raises(FileNotFoundError):
        read_domain(tmp_path / "missing.geojson")
    assert is_domain_file("A.SVG")
    assert not is_domain_file("a.json")
