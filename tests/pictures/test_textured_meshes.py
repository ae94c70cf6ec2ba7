"""Textures read back: OBJ and GLB files."""

import json
import struct

import igl
import numpy as np
from support.parametrized_surfaces import random_coefficients

from igl_periods.differentials.parametrization import parametrize
from igl_periods.pictures.textured_meshes import write_glb, write_obj


def test_obj_read_back_has_the_same_map(surfaces, tmp_path):
    P = parametrize(surfaces["genus 3"], random_coefficients(3, 6))
    files = write_obj(tmp_path / "surface.obj", P, scale=1.0)
    assert [file.name for file in files] == ["surface.obj", "surface.mtl", "surface.png"]
    V, uv, _, F, uv_corner, _ = igl.readOBJ(files[0])
    assert np.array_equal(F, P.complex.corner_vertex)
    assert np.array_equal(V, P.complex.positions)
    z = uv[uv_corner] @ [1, 1j]
    assert np.array_equal(z, P.corner_uv)
    # The seams are those edges at which the two faces have different coordinates.
    here, there = np.arange(z.size), P.complex.twin.ravel()
    tail, head = (np.roll(uv_corner, k, axis=1).ravel() for k in (-1, 1))
    apart = (tail[here] != head[there]) | (head[here] != tail[there])
    assert np.array_equal(apart, P.cut.ravel())
    text = files[0].read_text()
    assert "mtllib surface.mtl" in text
    assert "map_Kd surface.png" in files[1].read_text()


def test_glb_is_well_formed_and_has_the_same_map(surfaces, tmp_path):
    P = parametrize(surfaces["genus 3"], random_coefficients(3, 6))
    (file,) = write_glb(tmp_path / "surface.glb", P, scale=2.0)
    data = file.read_bytes()
    magic, version, size, n_json, kind = struct.unpack("<4sIIII", data[:20])
    assert (magic, version, size, kind) == (b"glTF", 2, len(data), 0x4E4F534A)
    document = json.loads(data[20 : 20 + n_json])
    n_binary, kind = struct.unpack("<II", data[20 + n_json : 28 + n_json])
    binary = data[28 + n_json :]
    assert (kind, n_binary) == (0x004E4942, len(binary))
    assert document["buffers"] == [{"byteLength": n_binary}]

    def accessor(i):
        entry = document["accessors"][i]
        view = document["bufferViews"][entry["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        raw = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        array = np.frombuffer(raw, {5126: "<f4", 5125: "<u4"}[entry["componentType"]])
        return array.reshape(entry["count"], -1)

    attributes = document["meshes"][0]["primitives"][0]["attributes"]
    uv, corner = accessor(attributes["TEXCOORD_0"]), accessor(3).reshape(-1, 3)
    assert np.array_equal(corner, P.corner)
    z = (uv[:, 0] + 1j * (1.0 - uv[:, 1])) / 2.0
    np.testing.assert_allclose(z, P.uv, rtol=0, atol=1e-5 * np.abs(P.uv).max())
    positions = accessor(attributes["POSITION"])
    np.testing.assert_allclose(positions, P.complex.positions[P.vertex], rtol=1e-6, atol=1e-6)
    assert document["accessors"][0]["min"] == positions.min(axis=0).tolist()
    view = document["bufferViews"][4]
    assert binary[view["byteOffset"] :][:8] == b"\x89PNG\r\n\x1a\n"
