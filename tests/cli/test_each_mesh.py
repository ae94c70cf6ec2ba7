"""Several meshes: each is answered, whatever becomes of the others; documents fit the schema."""

import json
from pathlib import Path

import igl
import jsonschema
import numpy as np
import pytest
from support.mesh_folders import TETRAHEDRON, two_tori
from support.random_surfaces import torus_of_revolution

from igl_periods.cli.program import main
from igl_periods.reports import json_schema

DATA = Path(__file__).parents[2] / "data"
KLEIN, OMEGA = str(DATA / "klein.json"), str(DATA / "omega_1.json")


@pytest.fixture
def documents(capsys):
    """The documents that a command prints, each of which fits the schema; its exit code; stderr."""
    schema = json_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)

    def run(*arguments):
        code = main([*map(str, arguments), "--json"])
        out, err = capsys.readouterr()
        decoder, found = json.JSONDecoder(), []
        while out := out.strip():
            document, end = decoder.raw_decode(out)
            validator.validate(document)
            found.append(document)
            out = out[end:]
        return found, code, err

    return run


@pytest.mark.parametrize("command", ["compute", "identify"])
def test_a_refused_mesh_does_not_keep_the_others(documents, capsys, command, tmp_path):
    nowhere = str(tmp_path / "nowhere.off")
    found, code, err = documents(command, KLEIN, nowhere, OMEGA)
    assert code == 1
    assert err == f"igl-periods: there is no mesh file {nowhere!r}\n"
    assert [document["file"] for document in found] == [KLEIN, nowhere, OMEGA]
    assert found[1]["error"]["kind"] == "FileNotFoundError"
    assert [found[k]["surface"]["genus"] for k in (0, 2)] == [3, 2]
    assert main([command, nowhere, KLEIN, OMEGA]) == 1
    sections = capsys.readouterr().out
    assert sections.index(KLEIN) < sections.index(OMEGA)
    assert "\n\n\n" not in sections
    assert main([command, KLEIN, OMEGA]) == 0


def test_each_section_is_what_the_mesh_alone_has(capsys):
    printed = []
    for meshes in ([KLEIN], [OMEGA], [KLEIN, OMEGA]):
        assert main(["compute", *meshes]) == 0
        printed.append(capsys.readouterr().out)
    assert printed[2] == f"{printed[0]}\n{printed[1]}"


def test_several_documents_are_lines(capsys):
    assert main(["compute", KLEIN, OMEGA, "--json"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [json.loads(line)["file"] for line in lines] == [KLEIN, OMEGA]


def test_an_unmet_tolerance_is_in_the_document(documents):
    (document,), code, err = documents("compute", OMEGA, "--tolerance", "1e-17")
    assert code == 0
    (warning,) = document["warnings"]
    assert warning["kind"] == "ToleranceWarning"
    assert warning["message"].startswith("the bound is")
    assert err == f"igl-periods: warning: {warning['message']}\n"
    (met,), _, err = documents("compute", OMEGA, "--tolerance", "1e-3")
    assert (met["warnings"], err) == ([], "")
    _, _, err = documents("compute", OMEGA, KLEIN, "--tolerance", "1e-17")
    assert err.startswith(f"igl-periods: warning: {OMEGA}: the bound is")


def test_a_warning_is_told_of_a_refused_mesh_too(tmp_path, documents):
    mesh = tmp_path / "odd.stl"
    mesh.write_bytes(b"\0" * 80 + (2).to_bytes(4, "little") + bytes(50))
    (document,), code, err = documents("compute", mesh)
    assert code == 1
    assert document["error"]["message"] in err
    for warning in document["warnings"]:
        assert f"warning: {warning['message']}" in err


def test_documents_of_every_kind_fit_the_schema(tmp_path, documents):
    (tmp_path / "sphere.off").write_text(TETRAHEDRON)
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    igl.write_triangle_mesh(str(tmp_path / "open.off"), V, F[1:])
    two = two_tori(tmp_path)
    for command in ("compute", "identify"):
        for arguments in (
            [tmp_path / "sphere.off"],
            [tmp_path / "open.off", "--double"],
            [tmp_path / "open.off", "--fill-holes", "3", "--weld", "1e-6"],
            [two, "--component", "all"],
            [two, "--component", "2"],
            [two, "--weights", "extrinsic", "--component", "1"],
            [KLEIN, "--degree", "2"],
        ):
            (document,), code, _ = documents(command, *arguments)
            assert code == 0
            assert "error" not in document


def test_the_schema_refuses_what_is_no_document():
    validator = jsonschema.Draft202012Validator(json_schema())
    good = {"schema": 1, "version": "1", "file": "a.off", "warnings": []}
    refusal = {**good, "error": {"kind": "MeshError", "message": "empty"}}
    assert validator.is_valid(refusal)
    assert not validator.is_valid(good)
    assert not validator.is_valid({**refusal, "schema": 2})
    assert not validator.is_valid({**refusal, "error": "empty"})


def test_named_surfaces_as_a_document(documents):
    (document,), code, _ = documents("identify", DATA / "lawson_2_1.off", "--mesh-error", "0.01")
    assert code == 0
    assert document["options"]["mesh_error"] == 0.01
    match = document["identification"]["matches"][0]
    assert match["name"] == "Lawson xi_{2,1}"
    assert np.shape(match["gamma"]) == (4, 4)
    assert "consistent" in match["claim"]
    assert "Bolza curve" in document["identification"]["compared"]
