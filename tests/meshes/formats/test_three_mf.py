"""3MF: components, transforms, units, parts; and archives that are none."""

# ruff: noqa: E501  # one line for each case

import io
import zipfile

import numpy as np
import pytest
from support.scene_files import F0, V0, loaded, volume

import igl_periods as ip

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
MESH = (
    "<mesh><vertices>"
    + "".join(f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in V0.tolist())
    + "</vertices><triangles>"
    + "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in F0.tolist())
    + "</triangles></mesh>"
)


def model(objects, items, unit="millimeter", more=""):
    return (
        f'<?xml version="1.0"?><model unit="{unit}" xmlns="{CORE}" xmlns:p="{PRODUCTION}" {more}>'
        f"<resources>{objects}</resources><build>{items}</build></model>"
    )


def archive(**parts):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as file:
        for name, text in parts.items():
            file.writestr(f"3D/{name}.model", text)
    return content.getvalue()


ONE = f'<object id="1" type="model">{MESH}</object>'


def test_3mf_components_transforms_and_units(tmp_path):
    # Rows from the left: first the component (a mirror), then the item (twice the size, moved).
    pair = (
        '<object id="2"><components><component objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>'
        '<component objectid="1" transform="0 1 0 -1 0 0 0 0 1 9 0 0"/></components></object>'
    )
    items = '<item objectid="2" transform="2 0 0 0 2 0 0 0 2 0 0 5"/>'
    V, F = loaded(tmp_path, archive(**{"3dmodel": model(ONE + pair, items)}), "a.3mf")
    n = len(V0)
    np.testing.assert_array_equal(V[:n], 2 * V0 * [-1, 1, 1] + [0, 0, 5])
    x, y, z = V0.T
    np.testing.assert_allclose(V[n:], np.stack([2 * (9 - y), 2 * x, 2 * z + 5], axis=1), rtol=1e-14)
    for part in (F[: len(F0)], F[len(F0) :]):
        np.testing.assert_allclose(volume(V, part), 8 * volume(V0, F0), rtol=1e-12)
    # An object in another part, in inches, placed by one in centimetres.
    inches = model(ONE, "", unit="inch")
    far = '<object id="7"><components><component p:path="/3D/other.model" objectid="1"/></components></object>'
    here = model(far, '<item objectid="7"/>', unit="centimeter", more='requiredextensions="p"')
    V, F = loaded(tmp_path, archive(**{"3dmodel": here, "other": inches}), "a.3mf")
    np.testing.assert_allclose(V, 2.54 * V0, rtol=1e-15)
    np.testing.assert_array_equal(F, F0)


def twice(k):
    return 2 * f'<component objectid="{k}"/>'


def deep(n):
    """Objects of two copies of the one before, n times."""
    objects = (
        f'<object id="{k + 2}"><components>{twice(k + 1)}</components></object>' for k in range(n)
    )
    return ONE + "".join(objects)


BAD_3MF = {
    "itself": (
        model('<object id="1"><components><component objectid="1"/></components></object>', '<item objectid="1"/>'),
        "has itself as a component",
    ),
    "empty build": (model(ONE, ""), "places no object"),
    "no such object": (model(ONE, '<item objectid="5"/>'), "object 5 of .* is used"),
    "2^60 copies": (model(deep(60), '<item objectid="61"/>'), "too many triangles"),
    "corner too large": (model(ONE.replace('v1="0"', 'v1="999"', 1), '<item objectid="1"/>'), "vertex 999"),
    "number": (model(ONE.replace('x="', 'x="a', 1), '<item objectid="1"/>'), "no 3MF as it should"),
    "cut": (model(ONE, '<item objectid="1"/>')[:-30], "no 3MF as it should be"),
    "document type": (
        '<!DOCTYPE a [<!ENTITY b "c">]>' + model(ONE, '<item objectid="1"/>').split("?>")[1],
        "has no document type",
    ),
    "extension": (
        model(ONE, '<item objectid="1"/>', more='requiredextensions="v" xmlns:v="urn:volumetric"'),
        "requires the extension urn:volumetric",
    ),
    "unit": (model(ONE, '<item objectid="1"/>', unit="mile"), "no 3MF as it should be"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD_3MF)
def test_3mf_that_is_refused(tmp_path, name):
    document, reason = BAD_3MF[name]
    with pytest.raises(ip.MeshError, match=reason):
        loaded(tmp_path, archive(**{"3dmodel": document}), "a.3mf")


def test_archives_that_are_none(tmp_path):
    with pytest.raises(ip.MeshError, match="not a zip archive"):
        loaded(tmp_path, b"PK\3\4 and no more", "a.3mf")
    with pytest.raises(ip.MeshError, match=r"has no 3D/3dmodel\.model"):
        loaded(tmp_path, archive(other="x"), "a.3mf")
