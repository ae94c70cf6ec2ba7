"""The scripts that reproduce the paper's tables: they run, and write what they show."""

import csv
import importlib
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parents[2] / "scripts" / "paper"


@pytest.fixture
def run(monkeypatch, tmp_path):
    """Run a script on a few levels; returns the rows of its CSV and its words."""
    monkeypatch.syspath_prepend(SCRIPTS)

    def call(name, levels, stem):
        arguments = [f"{name}.py", "--output", str(tmp_path), "--levels", str(levels)]
        monkeypatch.setattr("sys.argv", arguments)
        importlib.import_module(name).main()
        assert (tmp_path / f"{stem}.png").stat().st_size > 10_000
        with (tmp_path / f"{stem}.csv").open(encoding="utf-8") as file:
            return list(csv.DictReader(file)), (tmp_path / f"{stem}.txt").read_text("utf-8")

    return call


def test_square_tiled(run):
    rows, words = run("reproduce_square_tiled", 3, "square_tiled")
    assert len(rows) == 9
    for row in rows:
        assert float(row["symplectic mean"]) < 1e-12
        if row["surface"] == "omega_2":
            assert f"{float(row['mean, Frobenius']):.2e}" == f"{float(row['paper']):.2e}"
    assert "Frobenius norm 3 of 3, largest entry 0 of 3" in words
    assert "5 of 5 printed values have the digits of the column of omega_2" in words


def test_wente(run):
    rows, words = run("reproduce_wente", 4, "wente")
    assert [row["grid"] for row in rows] == ["10 x 10", "20 x 20", "40 x 40", "80 x 80"]
    assert f"{float(rows[2]['in mean']):.2e}" == "3.57e-04"
    assert f"{float(rows[2]['ex mean']):.2e}" == "1.69e-03"
    assert "4.9e-05 away" in words
    assert "that row is not explained" in words


@pytest.mark.slow
def test_lawson(run):
    rows, words = run("reproduce_lawson", 1, "lawson")
    by_family = {row["family"]: row for row in rows}
    assert float(by_family["structured"]["in symplectic"]) < 1e-13
    assert float(by_family["Voronoi"]["in mean, Frobenius"]) < float(
        by_family["Voronoi"]["paper in"]
    )
    assert by_family["Voronoi"]["V"] == by_family["poor"]["V"] == "1162"
    assert "not public" in words


def test_levels_out_of_range_are_refused(run, capsys):
    with pytest.raises(SystemExit):
        run("reproduce_wente", 9, "wente")
    assert "--levels must be 1 … 5" in capsys.readouterr().err
