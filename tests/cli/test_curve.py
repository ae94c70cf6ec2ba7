"""The command ``curve``: equations, invariants, texts for other systems."""

import json
from pathlib import Path

import flint
import pytest

from igl_periods.cli.program import main

DATA = Path(__file__).parents[2] / "data"


def test_the_four_square_surface_in_words(capsys):
    assert main(["curve", str(DATA / "omega_2.json"), "--digits", "12"]) == 0
    printed = capsys.readouterr().out
    assert "y^2 = x^5 - x" in printed
    assert "recognised, not proved" in printed
    assert "recognised as -1/20" in printed
    assert "exact numbers, square roots for instance" in " ".join(printed.split())


def test_document(capsys):
    assert main(["curve", str(DATA / "omega_2.json"), "--digits", "12", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    curve = document["curve"]
    assert (curve["genus"], curve["model"], curve["field"]) == (2, "hyperelliptic", "Q")
    assert curve["equation"] == "y^2 = x^5 - x"
    by_power = {c["exponents"][0]: c["recognised"]["polynomial"] for c in curve["coefficients"]}
    assert by_power == {5: [-1, 1], 1: [1, 1]}
    assert curve["proved_balls"]
    assert document["options"]["digits"] == 12
    # I₂⁵/I₁₀ from the balls of the document is that of the equation.
    i2, i10 = (flint.acb(*map(flint.arb, curve["invariants"][n].values())) for n in ("I2", "I10"))
    exact = curve["absolute_invariants"]["I10"]
    assert (i10 / i2**5 - flint.acb(*map(flint.arb, exact["ball"].values()))).contains(0)


@pytest.mark.parametrize(
    ("system", "text"),
    [
        ("latex", "y^2 = x^{5} - x"),
        ("sage", "C = HyperellipticCurve(f)"),
        ("magma", "f := x^5 - x;"),
        ("pari", "f = x^5 - x;"),
    ],
)
def test_other_systems(capsys, system, text):
    arguments = ["curve", str(DATA / "omega_2.json"), "--digits", "12", "--format", system]
    assert main(arguments) == 0
    assert text in capsys.readouterr().out


def test_refused(capsys):
    arguments = ["curve", str(DATA / "omega_2.json"), "--digits", "3", "--degree", "0"]
    assert main(arguments) == 1
    assert "degree = 0" in capsys.readouterr().err
