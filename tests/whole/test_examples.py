"""The tutorials run.  What they draw is drawn when the site is built; here pictures are blank."""

import runpy
import warnings
from pathlib import Path

import numpy as np
import pytest
from support.mpi_processes import mpiexec

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


def test_one_mesh_under_mpi():
    done = mpiexec(2, "-m", "mpi4py", EXAMPLES / "one_mesh_under_mpi.py")
    assert done.returncode == 0, done.stderr
    assert "2 ranks" in done.stdout
