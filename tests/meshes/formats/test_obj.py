"""OBJ: its dialects, and indices that count backwards."""

import pytest
from support.mesh_files import TETRAHEDRON, written

from igl_periods.meshes.load import load_mesh

OBJ_DIALECTS = {
    "byte-order mark": "\ufeff" + TETRAHEDRON,
    "carriage returns": TETRAHEDRON.replace("\n", "\r\n"),
    "comments": TETRAHEDRON.replace("\n", " # c\n") + "# end",
    "continued line": TETRAHEDRON.replace("f 1 3 2", "f 1 3 \\\n2"),
    "other elements": "mtllib a.mtl\no x\ng y\nusemtl m\ns 1\n" + TETRAHEDRON + "l 1 2\n",
    "texture and normals": "vt 0 0\nvn 0 0 1\n"
    + TETRAHEDRON.replace("f 1 3 2", "f 1/1/1 3/1/1 2/1/1").replace("f 1 2 4", "f 1//1 2//1 4//1"),
    "counted backwards": TETRAHEDRON.replace("f 1 3 2", "f -4/1 -2/1 -3/1"),
    "colours": TETRAHEDRON.replace("v 1 0 0", "v 1 0 0 0.5 0.5 0.5"),
    "exponents": TETRAHEDRON.replace("v 1 0 0", "v +1.E+00 .0 0e3"),
}


@pytest.mark.parametrize("dialect", OBJ_DIALECTS)
def test_dialects_of_obj(tmp_path, capfd, dialect):
    V, F, _ = load_mesh(written(tmp_path / "mesh.obj", OBJ_DIALECTS[dialect]))
    assert V.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    assert F.tolist() == [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    # Neither Python nor libigl writes anything.
    assert capfd.readouterr() == ("", "")


def test_backward_indices_count_from_the_line_of_the_face(tmp_path):
    lines = TETRAHEDRON.splitlines()
    early = "\n".join([*lines[:3], "f -3 -1 -2", *lines[3:]])
    _, F, _ = load_mesh(written(tmp_path / "mesh.obj", early))
    assert F[0].tolist() == [0, 2, 1]
