"""glTF: transforms, instances, accessors; no surface is turned inside out."""

# ruff: noqa: E501, RUF005  # one line for each case

import base64
import json
import struct
import subprocess
import sys

import numpy as np
import pytest
from support import mesh_files
from support.mesh_index import kinds
from support.scene_files import F0, V0, gltf, loaded, volume

import igl_periods as ip
from igl_periods.meshes.load import load_mesh

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
    with pytest.raises(ip.MeshError, match=r"bytes are announced, and there are .*: truncated"):
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
    "projective": (gltf([{"mesh": 0, "matrix": list(range(16))}]), "not an affine map"),
    "no JSON": (b"{", "not glTF 2.0, truncated or corrupt"),
    "not an object": (b"[1, 2]", "not glTF 2.0, truncated or corrupt"),
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


def test_gltf_is_read_in_single_precision(tmp_path):
    V, F = mesh_files.torus()
    V_read, F_read, report = load_mesh(
        mesh_files.written(tmp_path / "mesh.gltf", mesh_files.gltf(V, F)), repair=True
    )
    assert report.result.is_closed_surface
    assert kinds(report.result) == {(1, 0): 1}
    # glTF stores single precision.
    np.testing.assert_array_equal(
        np.unique(V_read[F_read].reshape(-1, 3), axis=0),
        np.unique(V.astype(np.float32).astype(float), axis=0),
    )
    with pytest.raises(ip.MeshError, match="this is GLB of version"):
        load_mesh(mesh_files.written(tmp_path / "broken.glb", b"glTF and no more"))


def test_open3d_is_not_imported_to_read_files(tmp_path):
    path = mesh_files.written(tmp_path / "mesh.off", mesh_files.off(*mesh_files.torus()))
    code = (
        "import sys; from igl_periods.meshes.load import load_mesh; "
        f"load_mesh({str(path)!r}, repair=True); sys.exit('open3d' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
