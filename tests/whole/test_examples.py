"""The tutorials run.  What they draw is drawn when the site is built; here pictures are blank."""

import os
import runpy
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "scripts" / "examples"
# What is tested elsewhere, and what needs another launcher.
OTHERS = {
    "jax_period_matrix": "test_autograd_examples.py",
    "torch_period_matrix": "test_autograd_examples.py",
    "one_mesh_under_mpi": "below",
}
SLOW = {"deforming_to_a_matrix", "textures", "many_meshes", "translation_surface"}
SCRIPTS = sorted(path.stem for path in EXAMPLES.glob("*.py") if path.stem not in OTHERS)


@pytest.fixture
def blank_pictures(monkeypatch):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import igl_periods.pictures as pictures

    monkeypatch.setattr(
        pictures, "render", lambda scene, size, *_: np.full((*size[::-1], 3), 255, dtype=np.uint8)
    )
    yield
    import matplotlib.pyplot as plt

    plt.close("all")


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=pytest.mark.slow if n in SLOW else ()) for n in SCRIPTS]
)
def test_tutorials_run(name, blank_pictures, monkeypatch, tmp_path, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("IGL_PERIODS_EXAMPLE_MESHES", "3")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
    assert capsys.readouterr().out
    assert not list(tmp_path.iterdir()), "a tutorial leaves nothing behind"


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.stem)
def test_tutorials_begin_with_a_title(path):
    _, title, line, blank, *_ = path.read_text(encoding="utf-8").splitlines()
    assert len(line) == len(title)
    assert set(line) == {"="}
    assert not blank


@pytest.mark.slow
def test_one_mesh_under_mpi():
    pytest.importorskip("mpi4py", reason="scripts/setup --distributed installs MPI and PETSc")
    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("there is no mpiexec")
    script = str(EXAMPLES / "one_mesh_under_mpi.py")
    command = [mpiexec, "-n", "2", sys.executable, "-m", "mpi4py", script]
    environment = os.environ | {
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    }
    ended = subprocess.run(
        command, env=environment, capture_output=True, text=True, timeout=300, check=False
    )
    assert ended.returncode == 0, ended.stderr
    assert "2 ranks" in ended.stdout
