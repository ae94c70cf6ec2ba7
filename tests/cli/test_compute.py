"""The command ``compute``: what it prints, its JSON, its exit codes."""

import json
from pathlib import Path

import igl
import numpy as np
from support.brute_force_equivalence import mobius
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.cli.program import main

DATA = Path(__file__).parents[2] / "data"


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


def test_a_matrix_that_cannot_be_reduced_is_not_lost(monkeypatch, capsys):
    def refuse(pm, max_genus):
        raise ip.ComplexError("too extreme for double precision")

    monkeypatch.setattr("igl_periods.periods.matrix.siegel_reduced", refuse)
    assert main(["compute", str(DATA / "lawson_2_1.off")]) == 0
    output = capsys.readouterr()
    assert "in the marking of the mesh, not Siegel reduced" in output.out
    assert "warning: the matrix was not reduced: too extreme for double precision" in output.err
