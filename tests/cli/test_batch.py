"""The command ``batch``: refusals, wrong usage, and what it does not import."""

import subprocess
import sys

import pytest

from igl_periods.cli.program import main


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["{}"], 1, "there is no mesh in the folder"),
        (["{}/nowhere"], 1, "there is no folder and no list"),
        (["{}", "--degree", "0"], 2, "degree 1 at least"),
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
        (["meshes", "-o", "x.csv"], "is a .parquet file"),
        (["meshes", "-o", "x.parquet", "--workers", "0"], "at least 1"),
        (["meshes", "-o", "x.parquet", "--workers", "2", "--scheduler", "x"], "not allowed with"),
    ],
)
def test_wrong_usage(arguments, message, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(["batch", *arguments])
    assert exit_.value.code == 2
    assert message in capsys.readouterr().err


def test_dask_and_arrow_are_imported_by_nothing_else():
    late = {"dask", "distributed", "pyarrow", "open3d", "tqdm"}
    code = f"import sys, igl_periods.cli.program; print({late} & {{*sys.modules}})"
    command = [sys.executable, "-c", code]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "set()\n"
