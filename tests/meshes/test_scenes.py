"""glTF and 3MF: surfaces at their places, outside out."""

import base64
import io
import json
import struct
import zipfile

import numpy as np
import pytest

import igl_periods as ip


def torus(n=7, m=5):
    i, j = np.divmod(np.arange(n * m), m)
    u, v = 2 * np.pi * (i + 0.1) / n, 2 * np.pi * (j + 0.2) / m
    V = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], axis=1)
    a, b = m * i + j, m * ((i + 1) % n) + j
    c, d = m * ((i + 1) % n) + (j + 1) % m, m * i + (j + 1) % m
    return V.astype(np.float32).astype(float), np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)


V0, F0 = torus()


def volume(V, F):
    """Positive where the faces are seen from outside."""
    a, b, c = (V[F[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def gltf(nodes, roots=(0,), **primitive):
    points, corners = V0.astype("<f4").tobytes(), F0.astype("<u2").tobytes()
    data = base64.b64encode(corners + points).decode()
    return {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": list(roots)}],
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0, **primitive}]}],
        "buffers": [{"byteLength": len(corners + points), "uri": f"data:x;base64,{data}"}],
        "bufferViews": [
            {"buffer": 0, "byteLength": len(corners)},
            {"buffer": 0, "byteOffset": len(corners), "byteLength": len(points)},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5123, "count": F0.size, "type": "SCALAR"},
            {"bufferView": 1, "componentType": 5126, "count": len(V0), "type": "VEC3"},
        ],
    }


def loaded(tmp_path, document, name="a.gltf"):
    path = tmp_path / name
    path.write_bytes(document if isinstance(document, bytes) else json.dumps(document).encode())
    return ip.load_mesh(path)[:2]


TURN = [0, 0, np.sin(0.3), np.cos(0.3)]
MIRROR = np.diag([1.0, 1, -1, 1])
NODES = {
    "as it is": [{"mesh": 0}],
    "translation": [{"mesh": 0, "translation": [1, 2, 3]}],
    "rotation": [{"mesh": 0, "rotation": TURN}],
    "mirror": [{"mesh": 0, "scale": [-1, 1, 1]}],
    "three mirrors": [{"mesh": 0, "scale": [-1, -2, -1]}],
    "two mirrors": [{"mesh": 0, "scale": [-1, 1, -1]}],
    "matrix": [{"mesh": 0, "matrix": MIRROR.T.ravel().tolist()}],
    "mirror above": [{"children": [1], "scale": [1, -1, 1]}, {"mesh": 0, "rotation": TURN}],
    "mirrors above and below": [
        {"children": [1], "scale": [2, -1, 1]},
        {"children": [2], "translation": [1, 0, 0]},
        {"mesh": 0, "scale": [1, 1, -3]},
    ],
}


@pytest.mark.parametrize("name", NODES)
def test_no_transform_turns_a_surface_inside_out(tmp_path, name):
    V, F = loaded(tmp_path, gltf(NODES[name]))
    factor = np.prod([np.prod(node.get("scale", 1)) for node in NODES[name]])
    np.testing.assert_allclose(volume(V, F), abs(factor) * volume(V0, F0), rtol=1e-12)


def test_a_mirrored_surface_has_the_mirrored_period_matrix(tmp_path):
    # Sheared, so that the torus has no symmetry that would hide a wrong orientation.
    shear = np.eye(4)
    shear[0, 1], shear[1, 2] = 0.7, 0.4
    one = loaded(tmp_path, gltf([{"mesh": 0, "matrix": shear.T.ravel().tolist()}]))
    mirrored = MIRROR @ shear
    other = loaded(tmp_path, gltf([{"mesh": 0, "matrix": mirrored.T.ravel().tolist()}]))
    np.testing.assert_array_equal(one[0] * [1, 1, -1], other[0])
    # The mirror image, its normals turned outside again: the same faces with opposite orientation.
    np.testing.assert_array_equal(np.sort(one[1]), np.sort(other[1]))
    tau, mirror = (
        ip.period_matrix(*mesh, degree=4).reduced().matrix[0, 0] for mesh in (one, other)
    )
    assert min(abs(mirror + np.conj(tau) + k) for k in (-1, 0, 1)) < 1e-6
    assert abs(tau.real) > 1e-4


def test_instances_nested_and_in_the_scene_only(tmp_path):
    nodes = [
        {"children": [1, 2], "scale": [2, 2, 2]},
        {"mesh": 0, "translation": [1, 0, 0]},
        {"mesh": 0, "translation": [9, 0, 0]},
        {"mesh": 0, "translation": [99, 0, 0]},
    ]
    V, F = loaded(tmp_path, gltf(nodes))
    assert (len(V), len(F)) == (2 * len(V0), 2 * len(F0))
    # Parents act on what their children have moved: 2 (x + 1), 2 (x + 9).
    expected = np.vstack([2 * (V0 + [1, 0, 0]), 2 * (V0 + [9, 0, 0])])
    np.testing.assert_allclose(V, expected, rtol=1e-15, atol=1e-15)
    assert len(ip.DeltaComplex.from_mesh(V, F).components()) == 2
    assert len(loaded(tmp_path, gltf(nodes, roots=[0, 3]))[1]) == 3 * len(F0)


def test_glb_quantised_sparse_strips_and_fans(tmp_path):
    document = gltf([{"mesh": 0}])
    data = base64.b64decode(document["buffers"][0].pop("uri").split(",")[1])
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(data), b"BIN\0") + data
    glb = struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
    V, F = loaded(tmp_path, glb, "a.glb")
    np.testing.assert_array_equal(V, V0)
    np.testing.assert_array_equal(F, F0)
    with pytest.raises(ip.MeshError, match="bytes are announced, and there are .*: truncated"):
        loaded(tmp_path, glb[:-20], "a.glb")
    strip = np.array([0, 1, 2, 3, 3, 4], "<i2").tobytes()
    points = np.array([[0, 0, 0], [127, 0, 0], [0, 127, 0], [127, 127, 0], [-128, 0, 0]], "i1")
    document = gltf([{"mesh": 0}], mode=5)
    body = base64.b64encode(strip + points.tobytes()).decode()
    document["buffers"] = [{"byteLength": 27, "uri": "data:;base64," + body}]
    document["bufferViews"] = [
        {"buffer": 0, "byteLength": 12},
        {"buffer": 0, "byteOffset": 12, "byteLength": 15, "byteStride": 3},
    ]
    document["accessors"] = [
        {"bufferView": 0, "componentType": 5122, "count": 6, "type": "SCALAR"},
        {"bufferView": 1, "componentType": 5120, "count": 5, "type": "VEC3", "normalized": True},
    ]
    document["extensionsRequired"] = ["KHR_mesh_quantization"]
    V, F = loaded(tmp_path, document)
    assert V.min() == -1 and V.max() == 1
    assert F.tolist() == [[0, 1, 2], [1, 3, 2]]
    document["meshes"][0]["primitives"][0]["mode"] = 6
    assert loaded(tmp_path, document)[1].tolist()[:3] == [[1, 2, 0], [2, 3, 0], [3, 3, 0]]


def changed(**changes):
    return {**gltf([{"mesh": 0}]), **changes}


BAD_GLTF = {
    "compressed": (changed(extensionsRequired=["KHR_draco_mesh_compression"]), "requires KHR_draco"),
    "old": (changed(asset={"version": "1.0"}), "glTF of version 1.0"),
    "cycle": (gltf([{"children": [1]}, {"children": [0], "mesh": 0}]), "below itself"),
    "nothing": (gltf([{}]), "no triangles in the scene"),
    "far away": (changed(buffers=[{"uri": "https://x/y.bin", "byteLength": 1}]), "not in the file but"),
    "missing": (changed(buffers=[{"uri": "y.bin", "byteLength": 1}]), "'y.bin', which belongs to it"),
    "projective": (gltf([{"mesh": 0, "matrix": list(range(16))}]), "no affine map"),
    "no JSON": (b"{", "no glTF 2.0, truncated or corrupt"),
    "not an object": (b"[1, 2]", "no glTF 2.0, truncated or corrupt"),
    "too short": (changed(bufferViews=[{"buffer": 0, "byteLength": 6}] * 2), "bytes are needed of"),
    "huge": (
        changed(accessors=[{"componentType": 5123, "count": 10**12, "type": "SCALAR", "bufferView": 0}] * 2),
        "is too large",
    ),
    "without data": (
        changed(accessors=[{"componentType": 5126, "count": 9, "type": "VEC3"}] * 2),
        "no data of its own",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD_GLTF)
def test_gltf_that_is_refused(tmp_path, name):
    document, reason = BAD_GLTF[name]
    with pytest.raises(ip.MeshError, match=reason):
        loaded(tmp_path, document)


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
    with pytest.raises(ip.MeshError, match="no zip archive"):
        loaded(tmp_path, b"PK\3\4 and no more", "a.3mf")
    with pytest.raises(ip.MeshError, match=r"has no 3D/3dmodel\.model"):
        loaded(tmp_path, archive(other="x"), "a.3mf")
