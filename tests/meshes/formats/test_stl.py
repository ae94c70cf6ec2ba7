"""STL: corners are welded and counted."""

import numpy as np
import pytest
from support.mesh_files import stl, torus, written
from support.mesh_index import kinds

from igl_periods.meshes.load import load_mesh


@pytest.mark.parametrize("binary", [False, True])
def test_stl_corners_are_welded_and_counted(tmp_path, binary):
    V, F = torus()
    V = V.astype(np.float32)
    V[0, 2] = 0.0
    content = stl(V.astype(float), F, binary)
    if not binary:
        # One of the corners at vertex 0 says -0.0, which is the same position.
        content = content.replace(b" 0.0\nendloop", b" -0.0\nendloop", 1)
        assert b" -0.0" in content
    V_read, F_read, report = load_mesh(written(tmp_path / "mesh.stl", content))
    assert (len(V_read), report.stl_corners_welded) == (len(V), 3 * len(F) - len(V))
    np.testing.assert_array_equal(V_read[F_read], V[F])
    assert kinds(report.loaded) == {(1, 0): 1}
