"""Pictures of polygons: every side has its letter, every vertex its dot."""

from collections import Counter
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.pictures import render_polygons

SVG = "{http://www.w3.org/2000/svg}"
PILLOW = ip.DeltaComplex.from_polygons(
    [[(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)]],
    [((0, 0), (0, 1)), ((0, 3), (0, 4)), ((0, 2), (0, 5))],
)


def drawn(K, tmp_path, **options):
    render_polygons(K, tmp_path / "picture.svg", **options)
    return ET.parse(tmp_path / "picture.svg").getroot()


def letters(svg):
    texts = (element.text for element in svg.iter(f"{SVG}text"))
    return Counter(text for text in texts if not text.startswith("total"))


@pytest.mark.parametrize(
    "K",
    [ip.surfaces.regular_polygon(8), ip.surfaces.l_shape(2, 3), ip.surfaces.double_polygon(7),
     ip.surfaces.triangle_unfolding(1, 2, 4)],
)  # fmt: skip
def test_sides_and_vertices(K, tmp_path):
    svg = drawn(K, tmp_path)
    sides = sum(len(p) for p in K.polygons.vertices)
    assert len(list(svg.iter(f"{SVG}polygon"))) == len(K.polygons.vertices)
    assert len(list(svg.iter(f"{SVG}line"))) == sides
    # Glued by translations: each letter twice, without a prime.
    assert set(letters(svg).values()) == {2}
    assert len(letters(svg)) == sides // 2
    assert len(list(svg.iter(f"{SVG}circle"))) >= sides
    assert "NaN" not in ET.tostring(svg, encoding="unicode")


def test_pictures_are_true_to_scale_and_upright(tmp_path):
    svg = drawn(ip.surfaces.l_shape(2, 3), tmp_path, width=500)
    polygon = next(svg.iter(f"{SVG}polygon"))
    xy = np.array([[float(x) for x in p.split(",")] for p in polygon.get("points").split()])
    scale = (xy[2, 0] - xy[0, 0]) / 2
    expected = [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (1, 3), (0, 3), (0, 1)]
    assert np.allclose((xy - xy[0]) * [1, -1] / scale, expected, atol=0.02)
    assert svg.get("width") == "500"
    assert xy.min() > 0
    assert xy[:, 0].max() < 500


def test_overlapping_polygons_are_drawn_apart(tmp_path):
    svg = drawn(ip.surfaces.triangle_unfolding(1, 1, 3), tmp_path)
    boxes = []
    for polygon in svg.iter(f"{SVG}polygon"):
        xy = np.array([[float(x) for x in p.split(",")] for p in polygon.get("points").split()])
        boxes.append((xy.min(axis=0), xy.max(axis=0)))
    for i, a in enumerate(boxes):
        for b in boxes[:i]:
            assert not ((a[0] < b[1]) & (b[0] < a[1])).all()


def test_rotations_have_primes_and_cone_points_their_angles(tmp_path):
    svg = drawn(PILLOW, tmp_path)
    assert letters(svg) == Counter({"a": 1, "a′": 1, "b": 1, "b′": 1, "c": 2})
    legend = [e.text for e in svg.iter(f"{SVG}text") if e.text.startswith("total")]
    assert legend == ["total angle π"] * 4
    octagon = drawn(ip.surfaces.regular_polygon(8), tmp_path)
    assert "total angle 6π" in [e.text for e in octagon.iter(f"{SVG}text")]
    # Marked points are hollow.
    unfolded = drawn(ip.surfaces.triangle_unfolding(1, 3, 4), tmp_path)
    hollow = [e for e in unfolded.iter(f"{SVG}circle") if e.get("fill") == "white"]
    assert hollow


def test_what_cannot_be_drawn(tmp_path):
    with pytest.raises(ip.RenderError, match="not glued from polygons"):
        render_polygons(ip.surfaces.origami("(1,2)", "(1,3)", 2), tmp_path / "picture.svg")
    with pytest.raises(ip.RenderError, match="width = 10: a picture of 100 pixels"):
        render_polygons(PILLOW, tmp_path / "picture.svg", width=10)
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        render_polygons(PILLOW, tmp_path / "nowhere" / "picture.svg")
