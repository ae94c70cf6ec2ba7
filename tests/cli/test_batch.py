"""The command ``batch``: refusals, wrong usage, and what it does not import."""

import subprocess
import sys

import pytest

from igl_periods.batch import BatchOptions, BatchResult
from igl_periods.cli.batch import _refusals_in_words
from igl_periods.cli.program import main


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["{}"], 1, "there is no mesh in the folder"),
        (["{}/nowhere"], 1, "there is no folder and no list"),
        (["a.off", "--scheduler", "nonsense://x"], 1, "there is no scheduler"),
    ],
)
def test_refusals(tmp_path, capsys, arguments, code, message):
    arguments = [text.format(tmp_path) for text in arguments]
    assert main(["batch", *arguments, "-o", str(tmp_path / "x.parquet")]) == code
    error = capsys.readouterr().err
    assert message in error
    assert error.startswith("igl-periods: ")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["meshes"], "-o"),
        (["-o", "x.parquet"], "DIR"),
        (["meshes", "-o", "x.xlsx"], "a table has a name in .parquet or .csv, not 'x.xlsx'"),
        (["meshes", "-o", "x.csv", "--degree", "0"], "degree 1 at least"),
        (["meshes", "-o", "x.parquet", "--workers", "0"], "at least 1"),
        (["meshes", "-o", "x.csv", "--weld", "0.5"], "a part of the diagonal"),
        (["meshes", "-o", "x.csv", "--fill-holes", "-1"], "a number of edges"),
        (["meshes", "-o", "x.csv", "--max-memory", "0"], "a number of gigabytes above 0"),
        (["a.json", "b.json", "-o", "x.csv", "--repair"], "--repair has no effect on gluings"),
        (["meshes", "-o", "x.parquet", "--workers", "2", "--scheduler", "x"], "not allowed with"),
    ],
)
def test_wrong_usage(arguments, message, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(["batch", *arguments])
    assert exit_.value.code == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "chosen"),
    [
        ("", {}),
        ("--repair", {"repair": True}),
        ("--weld 1e-6", {"repair": True, "weld": 1e-6}),
        ("--fill-holes 4 --double", {"repair": True, "largest_hole": 4, "double": True}),
        ("--max-memory 2 --tolerance 1e-3", {"max_memory": 2e9, "tolerance": 1e-3}),
        ("--no-delaunay --rigorous", {"delaunay": False, "rigorous": True}),
    ],
)
def test_options_reach_every_file(tmp_path, monkeypatch, arguments, chosen):
    (tmp_path / "a.off").touch()
    asked = []

    def run(files, output, options, **how):
        asked.append(options)
        return BatchResult([], 0, len(files))

    monkeypatch.setattr("igl_periods.batch.run_batch", run)
    output = str(tmp_path / "x.csv")
    assert main(["batch", str(tmp_path), "-o", output, *arguments.split()]) == 0
    assert asked == [BatchOptions(**chosen)]


def test_dask_and_arrow_are_imported_by_nothing_else():
    late = {"dask", "distributed", "pyarrow", "open3d", "tqdm"}
    code = f"import sys, igl_periods.cli.program; print({late} & {{*sys.modules}})"
    command = [sys.executable, "-c", code]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "set()\n"


def row(file, error, kind="ComplexError", component=None):
    return {"file": file, "error": error, "error_kind": kind, "component": component}


def test_refused_files_are_named_and_counted_once():
    refused = [row(f"open_{k:02d}.off", "not closed: it has 3 edges. Fill.") for k in range(12)]
    refused += [row("two.off", "not closed.", component=k) for k in (2, 3)]
    refused += [row("empty.off", "no faces\nat all", "MeshError")]
    lines = _refusals_in_words(refused)
    assert lines[:2] == [
        "  14 files with 15 rows without a period matrix (the column 'error' says why):",
        "  13 ComplexError",
    ]
    assert lines[2] == "    open_00.off: not closed: it has 3 edges"
    assert lines[12:] == ["    … and 3 more", "  1 MeshError", "    empty.off: no faces"]
    assert _refusals_in_words(refused[12:14])[2] == "    two.off: component 2: not closed"
    assert _refusals_in_words([]) == []
