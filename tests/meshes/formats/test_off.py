"""OFF: its dialects."""

import numpy as np
import pytest
from support.mesh_files import TETRAHEDRON, written

from igl_periods.meshes.load import load_mesh


@pytest.mark.parametrize(
    "content",
    [
        "OFF 4 4 6\n{}",
        "OFF\n# comment\n\n4 4\n{}",
        "COFF\n4 4 0\n{}",
    ],
)
def test_dialects_of_off(tmp_path, content):
    V, F, _ = load_mesh(written(tmp_path / "good.obj", TETRAHEDRON))
    colour = " 1 1 1 1" if "COFF" in content else ""
    body = "".join(f"{x:g} {y:g} {z:g}{colour} # c\n" for x, y, z in V)
    body += "".join(f"3  {a} {b}\t{c} 255 0 0\n" for a, b, c in F)
    V_off, F_off, _ = load_mesh(written(tmp_path / "mesh.off", content.format(body) + "3 0 1 2\n"))
    np.testing.assert_array_equal(V_off, V)
    np.testing.assert_array_equal(F_off, F)
