"""Polygons become fans of triangles."""

import numpy as np
import pytest
from support.mesh_files import FORMS, cube, written
from support.mesh_index import kinds

from igl_periods.meshes.load import load_mesh


@pytest.mark.parametrize("name", FORMS)
def test_polygons_become_fans_in_the_order_of_the_file(tmp_path, name):
    # A cube with one side cut in two and one corner of the neighbouring sides made a pentagon.
    V, quads = cube()
    V = np.vstack([V, [0, 0.5, 0]])
    polygons = [[0, 1, 3], [8, 0, 3, 2], *quads[1:4].tolist(), [8, 2, 6, 4, 0], quads[5].tolist()]
    V_read, F, report = load_mesh(written(tmp_path / name, FORMS[name](V, polygons)))
    expected = [[p[0], p[i], p[i + 1]] for p in polygons for i in range(1, len(p) - 1)]
    assert F.tolist() == expected
    np.testing.assert_array_equal(V_read, V)
    assert (report.faces, report.polygons_fanned) == (7, 6)
    assert kinds(report.loaded) == {(0, 0): 1}
