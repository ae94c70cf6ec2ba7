"""The program: its version, its exit codes, a reader who leaves early."""

import shlex
import subprocess
import sys

import pytest

import igl_periods as ip
from igl_periods.cli.program import main


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
