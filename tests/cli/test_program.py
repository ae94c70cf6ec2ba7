"""The program: its version, its exit codes, a reader who leaves early."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import igl_periods as ip
from igl_periods.cli.program import main


def test_a_reader_who_has_had_enough_is_no_error(torus):
    python, mesh = shlex.quote(sys.executable), shlex.quote(str(torus))
    command = f"{python} -m igl_periods compute {mesh} --json | head -c 10"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=True)
    assert done.stderr == ""


LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"

INTERRUPTED_WITHIN = """
import os, signal, sys
from igl_periods.cli import compute, main
def interrupted(*arguments, **options):
    os.kill(os.getpid(), signal.SIGINT)
signal.signal(signal.SIGINT, signal.default_int_handler)
compute.{function} = interrupted
sys.exit(main(["compute", sys.argv[1]]))
"""


@pytest.mark.parametrize("function", ["read_surfaces", "reduced_if_feasible"])
def test_an_interrupt_is_one_line_and_130(function):
    program = INTERRUPTED_WITHIN.format(function=function)
    command = [sys.executable, "-c", program, str(LAWSON), str(LAWSON)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 130
    assert (done.stdout, done.stderr) == ("", "igl-periods: interrupted.\n")


def test_an_interrupt_is_no_refusal_of_one_mesh(monkeypatch, capsys, torus):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("igl_periods.cli.compute.read_surfaces", interrupted)
    assert main(["compute", str(torus), str(torus)]) == 130
    assert capsys.readouterr() == ("", "igl-periods: interrupted.\n")


@pytest.mark.parametrize(
    "environment",
    [
        {"PYTHONIOENCODING": "ascii"},
        {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    ],
    ids=["ascii", "C"],
)
def test_terminals_without_unicode(environment):
    def run(*arguments):
        command = [sys.executable, "-m", "igl_periods", *map(str, arguments)]
        done = subprocess.run(
            command, capture_output=True, check=False, env={**os.environ, **environment}
        )
        return done.returncode, done.stdout.decode("ascii"), done.stderr.decode("ascii")

    code, out, err = run("compute", LAWSON)
    assert (code, err) == (0, "")
    assert "Period matrix Pi of genus 2" in out
    assert "Pi = (a Pi_0 + b)(c Pi_0 + d)^-1" in out
    code, out, _ = run("render", "--help")
    assert code == 0
    assert "|zeta|" in out
    code, _, err = run("compute", "Möbius.off")
    assert code == 1
    assert "no mesh file" in err


def completions(line, tmp_path):
    """What a shell is told, by the protocol of argcomplete: words on a file of their own."""
    answer = tmp_path / "answer"
    environment = {
        "_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": "\n", "_ARGCOMPLETE_SUPPRESS_SPACE": "1",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(answer), "COMP_LINE": line,
        "COMP_POINT": str(len(line)), "COMP_TYPE": "9",
    }  # fmt: skip
    command = [sys.executable, "-m", "igl_periods"]
    subprocess.run(command, check=True, env={**os.environ, **environment})
    return answer.read_text().split("\n")


def test_a_shell_completes_commands_options_and_choices(tmp_path):
    pytest.importorskip("argcomplete")
    assert {"compute", "identify", "batch"} <= set(completions("igl-periods ", tmp_path))
    assert completions("igl-periods id", tmp_path) == ["identify"]
    assert set(completions("igl-periods compute x.off --to", tmp_path)) == {"--tolerance"}
    shown = completions("igl-periods render x.off --show c", tmp_path)
    assert set(shown) == {"cycles", "checkerboard", "cut"}


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
