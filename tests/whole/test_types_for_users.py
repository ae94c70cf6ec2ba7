"""A user's script passes a strict type checker, and runs."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

import igl_periods
from igl_periods.surfaces import torus_of_revolution

SCRIPT = Path(__file__).with_name("users_script.py")
PACKAGE = Path(igl_periods.__file__).parent


def off_text(V, F):
    rows = [["OFF"], [len(V), len(F), 0], *V.tolist(), *([3, *face] for face in F.tolist())]
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


def run(arguments, folder):
    """Run Python away from the project, on the package that is tested here."""
    environment = {**os.environ, "PYTHONPATH": str(PACKAGE.parent)}
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        cwd=folder, env=environment, capture_output=True, text=True, timeout=600,
    )  # fmt: skip


def test_the_package_says_that_it_has_types():
    assert (PACKAGE / "py.typed").is_file()


@pytest.mark.slow
def test_a_type_checker_accepts_a_users_script(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed (extra test)")
    copy = tmp_path / SCRIPT.name
    copy.write_text(SCRIPT.read_text())
    checked = run(["-m", "mypy", "--strict", "--config-file=", copy], tmp_path)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_the_script_runs(tmp_path):
    V, F = torus_of_revolution(2.0, 1.0, 12, 7)
    mesh = tmp_path / "torus.off"
    mesh.write_text(off_text(V, F))
    done = run([SCRIPT, mesh], tmp_path)
    assert done.returncode == 0, done.stderr
    first, refusal = done.stdout.splitlines()
    assert first.startswith("[1, 1, 1, 1, 1, 1, 1, 0] (1, 2, 252) True True")
    assert refusal.startswith("the surface is not closed: it has 3 boundary edges.")
