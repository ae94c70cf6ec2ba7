"""Formats that Open3D reads, and when it is imported."""

import subprocess
import sys

import numpy as np
import pytest
from support.mesh_files import gltf, off, torus, written
from support.mesh_index import kinds

import igl_periods as ip
from igl_periods.meshes.load import load_mesh


def test_gltf_is_read_by_open3d(tmp_path):
    V, F = torus()
    V_read, F_read, report = load_mesh(written(tmp_path / "mesh.gltf", gltf(V, F)), repair=True)
    assert report.result.is_closed_surface
    assert kinds(report.result) == {(1, 0): 1}
    # glTF stores single precision.
    np.testing.assert_array_equal(
        np.unique(V_read[F_read].reshape(-1, 3), axis=0),
        np.unique(V.astype(np.float32).astype(float), axis=0),
    )
    with pytest.raises(ip.MeshError, match="Open3D reads no triangles"):
        load_mesh(written(tmp_path / "broken.glb", b"glTF and no more"))


def test_open3d_is_not_imported_where_it_is_not_needed(tmp_path):
    path = written(tmp_path / "mesh.off", off(*torus()))
    code = (
        "import sys; from igl_periods.meshes.load import load_mesh; "
        f"load_mesh({str(path)!r}, repair=True); sys.exit('open3d' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
