"""Arrays are bit for bit those of libigl."""

import igl
import numpy as np
import pytest
from support.mesh_index import INDEX


@pytest.mark.parametrize("name", INDEX)
def test_arrays_are_bit_for_bit_those_of_libigl(load, meshes, name):
    V, F, _ = load(name)
    V_igl, F_igl = igl.read_triangle_mesh(meshes / name)
    assert V.dtype == np.float64
    assert F.dtype == np.int64
    np.testing.assert_array_equal(V, V_igl)
    np.testing.assert_array_equal(F, F_igl)
