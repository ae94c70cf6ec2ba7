"""The command ``enclose``: every digit that it prints is proved."""

import json
import logging
import re
from pathlib import Path

import flint
import igl
import numpy as np
import pytest

import igl_periods as ip
from igl_periods.cli.program import main
from igl_periods.enclosures import PeriodEnclosure

DATA = Path(__file__).parents[2] / "data"


@pytest.fixture(scope="module")
def torus_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("enclose") / "torus.obj"
    igl.write_triangle_mesh(str(path), *ip.surfaces.torus_of_revolution(2.0, 1.0, 5, 4))
    return path


def test_digits_are_those_of_the_exact_matrix(capsys):
    assert main(["enclose", str(DATA / "klein.json"), "--digits", "12"]) == 0
    printed = capsys.readouterr().out
    exact = ip.surfaces.regular_map_period_matrix("klein")
    number = r"-?\d\.\d+"
    rows = re.findall(rf"^ +((?:[-+]? ?{number}(?: i)? *)+)$", printed, re.MULTILINE)
    entries = [re.findall(rf"({number}) ([-+]) ({number}) i", row) for row in rows]
    Pi = np.array([[complex(float(x), float(s + y)) for x, s, y in row] for row in entries])
    assert Pi.shape == (3, 3)
    found = ip.symplectic_isomorphisms(Pi, exact, 1e-9)
    assert len(found) == 336
    assert "digits are proved" in printed and "a theorem" in printed
    assert "exact numbers, square roots for instance" in " ".join(printed.split())


def test_a_mesh_is_the_one_with_its_exact_distances(torus_file, capsys):
    assert main(["enclose", str(torus_file), "--digits", "9", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    directly = ip.enclose(*ip.load_mesh(torus_file)[:2], digits=9)
    read = PeriodEnclosure.from_json(document)
    assert read.overlaps(directly)
    assert read.digits >= 9
    assert "exact distances" in document["lengths"]
    reduced = directly.change_basis(document["reduced"]["gamma"])
    balls = flint.acb_mat(
        [
            [flint.acb(flint.arb(x), flint.arb(y)) for x, y in zip(*rows)]
            for rows in zip(*(document["reduced"]["matrix"][part] for part in ("real", "imag")))
        ]
    )
    assert reduced.overlaps(balls)
    assert document["options"]["digits"] == 9
    assert document["mesh"]


def test_doubles_and_limits(tmp_path, capsys):
    path = tmp_path / "annulus.off"
    V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 5, 4)
    igl.write_triangle_mesh(str(path), V, F[1:])
    assert main(["enclose", str(path), "--digits", "4"]) == 1
    assert "boundary" in capsys.readouterr().err
    assert main(["enclose", str(path), "--digits", "4", "--double"]) == 0
    assert "genus 2, Siegel reduced" in capsys.readouterr().out


def test_what_cannot_be_reached_in_time_is_said(torus_file, capsys):
    command = ["enclose", str(torus_file), "--digits", "60", "--max-seconds", "0.1"]
    assert main(command) == 0
    shown = capsys.readouterr()
    assert "60 were asked for" in shown.err
    proved = int(re.search(r"(\d+) digits are proved", shown.out)[1])
    assert 0 <= proved < 60


@pytest.mark.parametrize("digits", ["0", "100000"])
def test_digits_out_of_range(digits, capsys):
    assert main(["enclose", str(DATA / "klein.json"), "--digits", digits]) == 1
    assert "a whole number from 1 to 1000" in capsys.readouterr().err


def test_progress_has_residuals_and_expected_times(caplog):
    with caplog.at_level(logging.INFO, logger="igl_periods"):
        assert main(["enclose", str(DATA / "omega_1.json"), "--digits", "12", "--quiet"]) == 0
    text = caplog.text
    assert re.search(r"jumps of 1e-\d+\.\d with \d+ functions, about \d+\.\d digits", text)
    assert re.search(r"next: degrees up to \d+, about \S+ s", text)
    assert "energies in balls" in text


def test_components(tmp_path, capsys):
    V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 4, 3)
    path = tmp_path / "two.off"
    igl.write_triangle_mesh(
        str(path), np.vstack([V, V + np.array([9, 0, 0])]), np.vstack([F, F + len(V)])
    )
    assert main(["enclose", str(path), "--digits", "3", "--component", "all", "--json"]) == 0
    components = json.loads(capsys.readouterr().out)["components"]
    assert [part["genus"] for part in components] == [1, 1]


def test_identify_in_balls(tmp_path, capsys):
    assert main(["identify", str(DATA / "klein.json"), "--digits", "15"]) == 0
    assert re.search(
        r"Klein quartic: .* consistent to 1\d digits, in balls", capsys.readouterr().out
    )
    K = ip.surfaces.flat_torus(1j * (1 + 1e-9))
    path = tmp_path / "nearly_square.json"
    path.write_text(json.dumps({"lengths": K.lengths.tolist(), "twin": K.twin.tolist()}))
    assert main(["identify", str(path), "--digits", "12"]) == 0
    said = capsys.readouterr().out
    assert "square torus: within 1e-09: in balls" in said
    assert "proved to be another one" in said


def test_tolerances_below_double_precision_point_here(capsys):
    assert main(["compute", str(DATA / "omega_1.json"), "--tolerance", "1e-20"]) == 0
    assert "igl-periods enclose" in capsys.readouterr().err


def test_the_limit_of_memory_is_in_gigabytes(torus_file, capsys):
    arguments = ["enclose", str(torus_file), "--digits", "6", "--max-memory"]
    assert main([*arguments, "2"]) == 0
    assert "digits are proved" in capsys.readouterr().out
    assert main([*arguments, "1e-6"]) == 1
    assert "stars and faces take about" in capsys.readouterr().err
