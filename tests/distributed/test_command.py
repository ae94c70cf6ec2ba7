"""The command on several ranks: one document, one message, exit codes."""

import json
import sys
from pathlib import Path

import igl
import numpy as np
import pytest
from support.mpi_processes import OneRank, mpiexec
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.distributed import __main__ as command
from igl_periods.distributed import pipeline

DATA = Path(__file__).parents[2] / "data"


COMMAND = ("-m", "igl_periods.distributed")


@pytest.fixture
def torus(tmp_path):
    path = tmp_path / "torus.off"
    igl.write_triangle_mesh(str(path), *torus_of_revolution(2.0, 0.8, 20, 12))
    return path


def test_command_prints_one_document(torus):
    done = mpiexec(2, *COMMAND, torus, "--json", "--rtol", "1e-10")
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    pm = ip.period_matrix(*ip.load_mesh(torus)[:2])
    found = np.array(document["mesh_marking"]["dirichlet"])
    np.testing.assert_allclose(found, pm.dirichlet, rtol=1e-12, atol=1e-12)
    assert document["mesh_marking"]["bound"] == pytest.approx(pm.bound, rel=1e-9)
    assert document["options"]["rtol"] == 1e-10
    assert document["mesh"]["loaded"]["triangles"] == 480


def test_command_says_it_in_words():
    done = mpiexec(1, *COMMAND, DATA / "omega_1.json", "--no-delaunay", "--quiet")
    assert done.returncode == 0, done.stderr
    assert "Period matrix Π of genus 2" in done.stdout
    assert "This is a theorem" in done.stdout


def test_a_refused_mesh_ends_all_ranks_and_is_told_once(tmp_path):
    path = tmp_path / "open.off"
    igl.write_triangle_mesh(str(path), np.eye(3), np.array([[0, 1, 2]]))
    done = mpiexec(2, *COMMAND, path)
    assert done.returncode == 1
    assert not done.stdout
    said = [line for line in done.stderr.splitlines() if line.startswith("igl-periods")]
    assert len(said) == 1
    assert "the surface is not closed: it has 3 boundary edges" in said[0]
    assert f"{path}: 3 vertices" in done.stderr


def test_a_failure_of_one_rank_alone_ends_all(torus):
    # Rank 1 fails where the others wait for it.
    code = (
        "import sys\n"
        "from igl_periods.distributed import __main__ as command, pipeline\n"
        "from igl_periods.distributed.libraries import world\n"
        "def fail(*_):\n"
        "    raise MemoryError('no memory on rank 1')\n"
        "if world().rank == 1:\n"
        "    pipeline.harmonic_potentials = fail\n"
        f"sys.exit(command.main([{str(torus)!r}]))\n"
    )
    done = mpiexec(2, "-c", code)
    assert done.returncode == 1
    assert done.stderr.count("MemoryError: no memory on rank 1") == 1


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["missing.off"], 1, "igl-periods: there is no"),
        (["torus.off", "--rtol", "2"], 1, "torus.off: rtol = 2.0"),
        (["torus.off", "--rtol", "much"], 2, "invalid float value: 'much'"),
        (["--help"], 0, "all ranks of mpiexec"),
    ],
)
def test_exit_codes(torus, monkeypatch, capsys, arguments, code, message):
    monkeypatch.setattr(command, "world", OneRank)
    for module in (command, pipeline):
        monkeypatch.setattr(module, "load_petsc", lambda: None)
    monkeypatch.chdir(torus.parent)
    assert command.main(arguments) == code
    printed = capsys.readouterr()
    assert message in printed.out + printed.err


@pytest.mark.parametrize("missing", ["mpi4py", "petsc4py"])
def test_command_without_its_libraries_is_refused(monkeypatch, capsys, missing):
    if missing == "petsc4py":
        monkeypatch.setattr(command, "world", OneRank)
    monkeypatch.setitem(sys.modules, missing, None)
    assert command.main(["torus.off"]) == 1
    assert f"{missing} cannot be imported" in capsys.readouterr().err
