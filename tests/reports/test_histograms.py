"""Histograms: as many as there is to tell, with axes that have names."""

import base64
import re
from xml.etree import ElementTree as ET

from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.reports.histograms import histograms

SVG = "{http://www.w3.org/2000/svg}"


def drawings(html):
    return [
        ET.fromstring(base64.b64decode(data))
        for figure in html
        for data in re.findall(r"data:image/svg\+xml;base64,([^\"]*)", figure)
    ]


def test_axes_have_names_and_numbers():
    pm = ip.period_matrix(*torus_of_revolution(2.0, 0.7, 12, 8))
    quality = ip.mesh_quality(pm.complex)
    shown = drawings(histograms(quality, ip.parametrize(pm, [1.0])))
    names = ["angles", "angles", "edges", "vertices", "triangles", "triangles"]
    assert len(shown) == len(names)
    for svg, name in zip(shown, names):
        words = [text.text for text in svg.iter(f"{SVG}text")]
        assert name in words
        assert sum(word.replace("−", "").replace(".", "").isdigit() for word in words) >= 5
    assert len(drawings(histograms(quality, None))) == 4


def test_the_same_numbers_make_the_same_picture():
    quality = ip.mesh_quality(*torus_of_revolution(2.0, 0.7, 12, 8))
    assert list(histograms(quality, None)) == list(histograms(quality, None))
