"""The command line: what it prints, its JSON, its exit codes."""

import json
import os
import pty
import shlex
import subprocess
import sys
from pathlib import Path

import igl
import numpy as np
import pytest
from matching import mobius
from random_surfaces import noisy_torus, torus_of_revolution

import igl_periods as ip
from igl_periods.cli.picture_arguments import reduced_surface as _reduced
from igl_periods.cli.program import _parser, main
from igl_periods.symplectic.canonical_basis import standard_form

DATA = Path(__file__).parents[1] / "data"


@pytest.fixture
def torus(tmp_path):
    path = tmp_path / "torus.off"
    igl.write_triangle_mesh(str(path), *torus_of_revolution(2.0, 0.8, 20, 12))
    return path


def test_summary_in_words(torus, capsys):
    assert main(["compute", str(torus)]) == 0
    printed = capsys.readouterr().out
    assert "240 vertices" in printed
    assert "genus 1" in printed
    assert "Π of this polyhedral surface is known to within" in printed
    assert "polyhedral" in printed


def test_json_is_complete_and_consistent(torus, capsys):
    assert main(["compute", str(torus), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == 1
    pm = ip.period_matrix(*ip.load_mesh(torus)[:2])
    mesh, reduced = document["mesh_marking"], document["reduced_marking"]
    matrix = np.array(mesh["matrix"]["real"]) + 1j * np.array(mesh["matrix"]["imag"])
    assert np.array_equal(matrix, pm.matrix)
    assert mesh["bound"] == pm.bound
    assert mesh["certified"] is True
    for name in ("primal", "dual", "mean", "dirichlet", "entry_bounds", "symplectic_eigenvalues"):
        values = mesh[name]
        if isinstance(values, dict):
            values = np.array(values["real"]) + 1j * np.array(values["imag"])
        assert np.array_equal(values, getattr(pm, name))
    other = np.array(reduced["matrix"]["real"]) + 1j * np.array(reduced["matrix"]["imag"])
    np.testing.assert_allclose(mobius(np.array(reduced["gamma"]), matrix), other, rtol=1e-12)
    assert document["surface"] == {
        "vertices": 240, "edges": 720, "faces": 480, "genus": 1, "mollification": 0.0
    }  # fmt: skip
    assert document["mesh"]["loaded"]["triangles"] == 480
    assert document["options"] == {
        "weights": "intrinsic", "delaunay": True, "degree": 1, "tolerance": None, "rigorous": False,
        "repair": False, "double": False, "component": None, "reduce": None
    }  # fmt: skip
    assert document["version"] == ip.__version__


def test_rigorous_bounds_are_said_to_be_proved(torus, capsys):
    main(["compute", str(torus), "--rigorous"])
    words = capsys.readouterr().out
    assert "This is proved." in words
    assert "allowance" not in words
    main(["compute", str(torus)])
    assert "This is a theorem, with an allowance for rounding." in capsys.readouterr().out
    main(["compute", str(torus), "--rigorous", "--degree", "3", "--json"])
    document = json.loads(capsys.readouterr().out)
    assert document["mesh_marking"]["rigorous"] is True
    assert document["reduced_marking"]["rigorous"] is True
    assert document["options"]["rigorous"] is True


def test_cycles_in_json_are_closed_walks_on_the_mesh(torus, capsys):
    main(["compute", str(torus), "--json"])
    cycles = json.loads(capsys.readouterr().out)["mesh_marking"]["cycles"]
    _, F = igl.read_triangle_mesh(torus)
    edges = {
        tuple(edge) for edge in np.sort(F[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)).tolist()
    }
    for walk in (cycles["a"][0], cycles["b"][0]):
        steps = zip(walk, walk[1:] + walk[:1])
        assert all(tuple(sorted(step)) in edges for step in steps)


def test_without_reduction(torus, capsys):
    assert main(["compute", str(torus), "--no-reduce"]) == 0
    printed = capsys.readouterr().out
    assert "genus 1, in the marking of the mesh, not Siegel reduced:" in printed
    assert "--reduce" not in printed
    assert "is known to within" in printed
    assert main(["compute", str(torus), "--no-reduce", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["reduced_marking"] is None
    assert document["options"]["reduce"] is False
    assert main(["compute", str(torus), "--json"]) == 0
    marking = json.loads(capsys.readouterr().out)["mesh_marking"]
    assert document["mesh_marking"] == marking


def test_high_genus_is_reduced_only_when_asked_for(torus, capsys, monkeypatch):
    # As if the limit were below the genus of the torus.
    for module in ("periods.matrix", "reports.terminal_text"):
        monkeypatch.setattr(f"igl_periods.{module}.SIEGEL_GENUS_LIMIT", 0)
    assert main(["compute", str(torus)]) == 0
    printed = capsys.readouterr().out
    assert "not Siegel reduced" in printed
    assert "above genus 0; --reduce does it" in printed
    assert main(["compute", str(torus), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["reduced_marking"] is None
    assert main(["compute", str(torus), "--reduce"]) == 0
    assert "genus 1, Siegel reduced:" in capsys.readouterr().out
    assert main(["compute", str(torus), "--reduce", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["reduced_marking"]["gamma"]
    assert document["options"]["reduce"] is True


def test_pictures_of_high_genus_are_in_the_marking_of_the_mesh(torus, monkeypatch):
    options = _parser().parse_args(["render", str(torus), "-o", "torus.png"])
    pm = ip.period_matrix(*ip.load_mesh(torus)[:2])
    assert np.array_equal(_reduced(options)[0].matrix, pm.reduced().matrix)
    monkeypatch.setattr("igl_periods.periods.matrix.SIEGEL_GENUS_LIMIT", 0)
    assert np.array_equal(_reduced(options)[0].matrix, pm.matrix)


def test_extrinsic_weights_come_without_a_bound(torus, capsys):
    assert main(["compute", str(torus), "--weights", "extrinsic", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["mesh_marking"]["bound"] is None
    assert main(["compute", str(torus), "--weights", "extrinsic"]) == 0
    assert "There is no bound" in capsys.readouterr().out


def test_without_flips_the_bound_is_larger(tmp_path, capsys):
    path = tmp_path / "noisy.obj"
    igl.write_triangle_mesh(str(path), *noisy_torus(9, 6, 0.2, 0))
    bounds = []
    for options in ([], ["--no-delaunay"]):
        assert main(["compute", str(path), "--json", *options]) == 0
        bounds.append(json.loads(capsys.readouterr().out)["mesh_marking"]["bound"])
    assert bounds[0] < bounds[1]


def test_tolerance_and_degree(capsys):
    for options in (["--tolerance", "1e-6"], ["--degree", "5"]):
        assert main(["compute", str(DATA / "lawson_2_1.off"), "--json", *options]) == 0
        assert json.loads(capsys.readouterr().out)["mesh_marking"]["bound"] < 1e-6
    assert main(["compute", str(DATA / "omega_1.json"), "--tolerance", "1e-17"]) == 0
    assert "warning: the bound is" in capsys.readouterr().err


def test_a_reader_who_has_had_enough_is_no_error(torus):
    python, mesh = shlex.quote(sys.executable), shlex.quote(str(torus))
    command = f"{python} -m igl_periods compute {mesh} --json | head -c 10"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=True)
    assert done.stderr == ""


def test_version(capsys):
    with pytest.raises(SystemExit) as exit_:
        main(["--version"])
    assert exit_.value.code == 0
    assert ip.__version__ in capsys.readouterr().out


def test_components_are_computed_one_by_one(tmp_path, capsys):
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    W, G = noisy_torus(7, 6, 0.1, 2)
    path = tmp_path / "two.off"
    igl.write_triangle_mesh(
        str(path), np.concatenate([V, W + 9.0]), np.concatenate([F, G + len(V)])
    )
    assert main(["compute", str(path)]) == 1
    assert "--component" in capsys.readouterr().err
    assert main(["compute", str(path), "--component", "all"]) == 0
    assert "Component 2 of 2" in capsys.readouterr().out
    assert main(["compute", str(path), "--component", "all", "--json"]) == 0
    parts = json.loads(capsys.readouterr().out)["components"]
    assert [part["surface"]["vertices"] for part in parts] == [96, 42]
    assert main(["compute", str(path), "--component", "2", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["surface"]["vertices"] == 42
    assert main(["compute", str(path), "--component", "3"]) == 1
    assert "there is no component 3" in capsys.readouterr().err


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


def test_genus_zero_as_json(tmp_path, capsys):
    path = tmp_path / "sphere.off"
    V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    igl.write_triangle_mesh(str(path), V, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    assert main(["compute", str(path), "--json"]) == 0
    marking = json.loads(capsys.readouterr().out)["mesh_marking"]
    assert (marking["bound"], marking["cycles"]) == (0.0, {"a": [], "b": []})


def test_a_sphere_is_no_error(tmp_path, capsys):
    path = tmp_path / "sphere.off"
    V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    igl.write_triangle_mesh(str(path), V, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    assert main(["compute", str(path)]) == 0
    assert "genus 0" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "no mesh file"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "not closed: it has 3 boundary edges"),
        ("nonsense", "bad.off"),
    ],
)
def test_refused_meshes_exit_with_one(tmp_path, capsys, content, message):
    path = tmp_path / "bad.off"
    if content is not None:
        path.write_text(content)
    assert main(["compute", str(path)]) == 1
    error = capsys.readouterr().err
    assert message in error
    assert error.startswith("igl-periods: ")


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["compute"],
        ["compute", "x.off", "--weights", "other"],
        ["compute", "x.off", "--reduce", "--no-reduce"],
    ],
)
def test_wrong_usage_exits_with_two(arguments, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(arguments)
    assert exit_.value.code == 2
    assert "usage" in capsys.readouterr().err


def test_stages_are_shown_on_a_terminal_only(torus):
    command = [sys.executable, "-m", "igl_periods", "compute", str(torus)]
    piped = subprocess.run(command, capture_output=True, text=True, check=True)
    assert piped.stderr == ""
    reader, terminal = pty.openpty()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=terminal, check=True)
    os.close(terminal)
    shown = os.read(reader, 10_000).decode()
    os.close(reader)
    for stage in ("reading the file", "homology", "harmonic forms", "Siegel reduction"):
        assert stage in shown


@pytest.mark.parametrize(
    ("name", "surface"),
    [
        ("lawson_2_1.off", "Lawson xi_{2,1}"),
        ("lawson_2_1_sphere.json", "Lawson xi_{2,1}"),
        ("omega_3.json", "Lawson xi_{2,1}"),
        ("hyperelliptic_x6_1.json", "Lawson xi_{2,1}"),
        ("klein.json", "Klein"),
        ("omega_2.json", "Bolza"),
        ("omega_1.json", "Omega_1"),
        ("wente_20x20.obj", "Wente"),
    ],
)
def test_surfaces_are_identified(capsys, name, surface):
    assert main(["identify", str(DATA / name)]) == 0
    first = capsys.readouterr().out.split("\n\n")[1].splitlines()[0]
    assert surface.lower() in first.lower()
    assert "consistent with the certificate" in first


def test_a_generic_surface_is_none_of_the_named_ones(tmp_path, capsys):
    path = tmp_path / "generic.obj"
    igl.write_triangle_mesh(str(path), *noisy_torus(12, 9, 0.1, 4))
    assert main(["identify", str(path)]) == 0
    assert "consistent" not in capsys.readouterr().out


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


def test_a_matrix_that_cannot_be_reduced_is_not_lost(monkeypatch, capsys):
    def refuse(pm, max_genus):
        raise ip.ComplexError("too extreme for double precision")

    monkeypatch.setattr("igl_periods.periods.matrix.siegel_reduced", refuse)
    assert main(["compute", str(DATA / "lawson_2_1.off")]) == 0
    output = capsys.readouterr()
    assert "in the marking of the mesh, not Siegel reduced" in output.out
    assert "warning: the matrix was not reduced: too extreme for double precision" in output.err
