"""The command ``identify``: named surfaces are named, others are not."""

import json
from pathlib import Path

import igl
import pytest
from support.random_surfaces import noisy_torus

from igl_periods.cli.program import main

DATA = Path(__file__).parents[2] / "data"


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


def test_invariants_are_named_where_nothing_in_the_catalogue_fits(tmp_path, capsys):
    """A 1 × 3 rectangle: τ = 3i, j is not rational, and no named torus is near."""
    lengths = [[1.0, 10.0**0.5, 3.0], [1.0, 10.0**0.5, 3.0]]
    path = tmp_path / "rectangle.json"
    path.write_text(json.dumps({"lengths": lengths, "twin": [[3, 4, 5], [0, 1, 2]]}))
    assert main(["identify", str(path), "--digits", "12"]) == 0
    printed = capsys.readouterr().out
    assert "none of 3 named surfaces" in printed or "another one" in printed
    assert "j = 153553679" in printed


def test_a_recognised_curve_comes_with_enough_digits(capsys):
    path = str(DATA / "omega_2.json")
    assert main(["identify", path, "--digits", "12", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["curve"]["equation"] == "y^2 = x^5 - x"
    assert document["identification"]["matches"][0]["name"] == "Bolza curve"
