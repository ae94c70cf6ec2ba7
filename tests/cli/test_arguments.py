"""What the commands say about the surface: components, the double, gluings."""

import json

import igl
import numpy as np
import pytest
from support.random_surfaces import noisy_torus, torus_of_revolution

from igl_periods.cli.program import main
from igl_periods.symplectic.canonical_basis import standard_form


def test_components_are_computed_one_by_one(tmp_path, capsys):
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    W, G = noisy_torus(7, 6, 0.1, 2)
    path = tmp_path / "two.off"
    igl.write_triangle_mesh(
        str(path), np.concatenate([V, W + 9.0]), np.concatenate([F, G + len(V)])
    )
    assert main(["compute", str(path)]) == 1
    assert capsys.readouterr().err.count("one by one") == 1
    assert main(["compute", str(path), "--component", "all"]) == 0
    assert "Component 2 of 2" in capsys.readouterr().out
    assert main(["compute", str(path), "--component", "all", "--json"]) == 0
    parts = json.loads(capsys.readouterr().out)["components"]
    assert [part["surface"]["vertices"] for part in parts] == [96, 42]
    assert main(["compute", str(path), "--component", "2", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["surface"]["vertices"] == 42
    assert main(["compute", str(path), "--component", "3"]) == 1
    assert "there is no component 3" in capsys.readouterr().err
    one = tmp_path / "one.off"
    igl.write_triangle_mesh(str(one), V, F)
    assert main(["compute", str(one), "--component", "2"]) == 1
    assert "there is no component 2: there is only one." in capsys.readouterr().err


def test_the_double_of_a_surface_with_boundary(tmp_path, capsys):
    # A torus without one face has a boundary; its double has genus 2.
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    path = tmp_path / "open.off"
    igl.write_triangle_mesh(str(path), V, F[1:])
    assert main(["compute", str(path)]) == 1
    assert "--double" in capsys.readouterr().err
    assert main(["compute", str(path), "--double", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["surface"]["genus"] == 2
    gamma = np.array(document["mesh_marking"]["real_structure"])
    assert np.array_equal(gamma @ standard_form(2) @ gamma.T, -standard_form(2))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("[]", "holds no gluing"),
        ('{"lengths": [[1, 1, 1]], "twin": [[0, 1]]}', "twin must have shape"),
        ('{"lengths": [[1, 1, 1], [1]], "twin": []}', "holds no gluing"),
        ("{", "holds no gluing"),
        ("[" * 100_000, "holds no gluing"),
        ("1" * 5000, "holds no gluing"),
    ],
)
def test_gluings_that_are_refused(tmp_path, capsys, content, message):
    path = tmp_path / "gluing.json"
    path.write_text(content)
    assert main(["compute", str(path)]) == 1
    assert message in capsys.readouterr().err
