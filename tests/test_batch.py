"""Many meshes: rows, files, the journal, clusters whose workers die, the command ``batch``."""

import fcntl
import json
import operator
import os
import pty
import signal
import struct
import subprocess
import sys
import termios
import threading
import time
from functools import partial
from pathlib import Path

import dask
import distributed
import igl
import numpy as np
import pyarrow.parquet as pq
import pytest
from flat_surfaces import flat_strip
from random_surfaces import noisy_torus, torus_of_revolution
from threadpoolctl import threadpool_limits

import igl_periods as ip
from igl_periods.batch import (
    BatchError,
    BatchOptions,
    find_files,
    local_cluster,
    remote_cluster,
    rows_of,
    run_batch,
)
from igl_periods.batch import cluster as batch_cluster
from igl_periods.batch.journal import Journal
from igl_periods.batch.rows import COLUMNS, file_hash
from igl_periods.cli.program import main
from igl_periods.moduli.genus_two import igusa_clebsch_invariants
from igl_periods.surfaces import cyclic_cover

DATA = Path(__file__).parents[1] / "data"
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"

# What the workers of these tests load: files whose name says so kill them, or take their time.
HABITS = """
import os, time
from igl_periods.meshes import surface_files
from igl_periods.batch import rows as batch_rows

def read_surface(path, repair=False):
    if "poison" in str(path):
        os.kill(os.getpid(), 9)
    if "slow" in str(path):
        time.sleep(0.1)
    return surface_files.read_surface(path, repair)

batch_rows.read_surface = read_surface
"""


def write_tori(folder: Path, n: int, prefix: str = "") -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for k in range(n):
        path = folder / f"{prefix}torus_{k:02d}.off"
        igl.write_triangle_mesh(str(path), *noisy_torus(7 + k % 3, 6, 0.1, k))


def write_gluing(path: Path, K: ip.DeltaComplex) -> Path:
    path.write_text(json.dumps({"lengths": K.lengths.tolist(), "twin": K.twin.tolist()}))
    return path


def two_tori(folder: Path) -> Path:
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    W, G = noisy_torus(7, 6, 0.1, 2)
    path = folder / "two.off"
    igl.write_triangle_mesh(
        str(path), np.concatenate([W + 9.0, V]), np.concatenate([G, F + len(W)])
    )
    return path


def matrix(row) -> np.ndarray:
    g = row["genus"]
    return np.reshape(row["matrix_real"], (g, g)) + 1j * np.reshape(row["matrix_imag"], (g, g))


def timeless(rows):
    return [{key: value for key, value in row.items() if key != "seconds"} for row in rows]


def computed_here(files, options=None):
    return [row for name, path in files.items() for row in rows_of(path, options, name)]


def read_rows(output):
    return pq.read_table(output).to_pylist()


@pytest.fixture(scope="module")
def habits(tmp_path_factory):
    path = tmp_path_factory.mktemp("habits") / "habits.py"
    path.write_text(HABITS)
    return path


@pytest.fixture(scope="module")
def cluster(habits):
    """Two workers, started once."""
    with dask.config.set({"distributed.worker.preload": [str(habits)]}), local_cluster(2) as client:
        yield client


@pytest.fixture
def address(cluster):
    return cluster.scheduler.address


# ---- Rows ----


def test_matrices_of_very_high_genus_stay_in_the_marking_of_the_mesh(monkeypatch):
    monkeypatch.setattr("igl_periods.periods.matrix.SIEGEL_GENUS_LIMIT", 1)
    (row,) = rows_of(DATA / "lawson_2_1.off")
    pm = ip.period_matrix(*ip.load_mesh(DATA / "lawson_2_1.off")[:2])
    assert row["reduced"] is False
    assert row["matrix_imag"] == pm.matrix.imag.ravel().tolist()
    assert row["bound"] == pm.bound


@pytest.mark.parametrize("name", ["lawson_2_1.off", "klein.json"])
def test_a_row_holds_the_reduced_matrix_bit_for_bit(name):
    (row,) = rows_of(DATA / name)
    assert list(row) == list(COLUMNS)
    with threadpool_limits(1):
        surface = DATA / name
        if name.endswith("off"):
            pm = ip.period_matrix(*ip.load_mesh(surface)[:2]).reduced()
        else:
            gluing = json.loads(surface.read_text())
            pm = ip.period_matrix(ip.DeltaComplex.from_gluing(**gluing)).reduced()
    assert np.array_equal(matrix(row), pm.matrix)
    assert row["bound"] == pm.bound
    assert row["entry_bound"] == pm.entry_bounds.max()
    assert row["symplectic_eigenvalues"] == pm.symplectic_eigenvalues.tolist()
    assert (row["vertices"], row["faces"]) == (pm.complex.n_vertices, pm.complex.n_faces)
    assert row["hash"] == file_hash(surface)
    assert row["version"] == ip.__version__
    assert (row["error"], row["error_kind"], row["warning"]) == (None, None, None)
    if name.endswith("off"):
        assert json.loads(row["mesh_report"])["result"]["triangles"] == 1536
        assert json.loads(row["mesh_report"])["file"] == row["file"]
    else:
        assert row["mesh_report"] is None


def test_options_reach_the_computation():
    path = DATA / "omega_1.json"
    fine, plain = (rows_of(path, BatchOptions(degree=p))[0] for p in (3, 1))
    assert fine["bound"] < 0.1 * plain["bound"]
    assert json.loads(fine["options"]) == {
        "repair": False, "double": False, "weights": "intrinsic", "delaunay": True, "degree": 3,
        "tolerance": None, "rigorous": False,
    }  # fmt: skip
    (met,) = rows_of(path, BatchOptions(tolerance=1e-6))
    assert met["bound"] < 1e-6
    (unmet,) = rows_of(path, BatchOptions(tolerance=1e-17))
    assert "the bound is" in unmet["warning"]
    assert unmet["error"] is None


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"degree": 0}, "degree 1 at least"),
        ({"weights": "other"}, "weights must be"),
        ({"tolerance": -1.0}, "always positive"),
        ({"degree": 3, "tolerance": 1e-3}, "a tolerance chooses the degree"),
    ],
)
def test_contradictory_options(options, message):
    with pytest.raises(ValueError, match=message):
        BatchOptions(**options)


def test_a_sphere_has_an_empty_matrix(tmp_path):
    (tmp_path / "sphere.off").write_text(TETRAHEDRON)
    (row,) = rows_of(tmp_path / "sphere.off")
    assert (row["genus"], row["matrix_real"], row["matrix_imag"]) == (0, [], [])
    assert matrix(row).shape == (0, 0)
    assert (row["bound"], row["entry_bound"], row["symplectic_eigenvalues"]) == (0.0, 0.0, [])
    assert (row["j_real"], row["hyperelliptic"]) == (None, None)


def test_components_are_rows_those_of_large_genus_first(tmp_path):
    rows = rows_of(two_tori(tmp_path))
    assert [(row["component"], row["genus"], row["vertices"]) for row in rows] == [
        (1, 1, 96),
        (2, 1, 42),
    ]
    assert rows[0]["mesh_report"] is not None
    assert rows[1]["mesh_report"] is None


def test_a_refused_component_is_a_row_beside_the_others(tmp_path):
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    path = tmp_path / "one_open.off"
    both = np.concatenate([F[1:], F + len(V)])
    igl.write_triangle_mesh(str(path), np.concatenate([V, V + 9.0]), both)
    closed, opened = rows_of(path)
    assert (closed["genus"], closed["error"]) == (1, None)
    assert (opened["component"], opened["genus"], opened["vertices"]) == (2, None, 96)
    assert (opened["matrix_real"], opened["bound"]) == (None, None)
    assert opened["error_kind"] == "ComplexError"
    assert "it has 3 boundary edges" in opened["error"]
    doubles = rows_of(path, BatchOptions(double=True))
    assert [row["genus"] for row in doubles] == [2, 1, 1]


def test_repair_makes_a_surface(tmp_path):
    V, F = noisy_torus(7, 6, 0.1, 1)
    path = tmp_path / "soup.off"
    igl.write_triangle_mesh(str(path), V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3))
    assert len(rows_of(path)) == len(F)
    (row,) = rows_of(path, BatchOptions(repair=True))
    assert (row["genus"], row["vertices"]) == (1, 42)


@pytest.mark.parametrize(
    ("name", "content", "kind", "message"),
    [
        ("missing.off", None, "FileNotFoundError", "there is no mesh file"),
        ("missing.json", None, "FileNotFoundError", "No such file"),
        ("empty.off", "", "MeshError", "the file is empty."),
        ("nonsense.obj", "nonsense", "MeshError", "the mesh is empty"),
        ("other.json", "[]", "MeshError", "the file holds no gluing"),
        ("fins.off", "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n",
         "MeshError", "border more than two faces"),
    ],
)  # fmt: skip
def test_refused_files_are_rows(tmp_path, name, content, kind, message):
    if content is not None:
        (tmp_path / name).write_text(content)
    (row,) = rows_of(tmp_path / name, name="x/y")
    assert row["error_kind"] == kind
    assert message in row["error"]
    assert (row["file"], row["component"], row["genus"]) == ("x/y", None, None)
    assert (row["hash"] is None) == (content is None)
    # The beginning of the message is not the path, which the column "file" has already.
    assert not row["error"].startswith(str(tmp_path))


def test_a_file_that_is_no_surface_has_its_report(tmp_path):
    V, F = torus_of_revolution(2.0, 0.8, 6, 5)
    path = tmp_path / "fin.off"
    igl.write_triangle_mesh(str(path), V, np.vstack([F, [[0, 5, 17]]]))
    (row,) = rows_of(path)
    assert row["error_kind"] == "MeshError"
    assert json.loads(row["mesh_report"])["result"]["nonmanifold_edges"] == 1


# ---- Invariants ----


def test_j_lies_within_its_certified_error(tmp_path):
    K = flat_strip(1.0, 2.0, 4, 5, "straight", "straight", seed=3)
    path = write_gluing(tmp_path / "torus.json", K)
    for tolerance in (None, 1e-6):
        (row,) = rows_of(path, BatchOptions(tolerance=tolerance))
        assert abs(row["j_real"] + 1j * row["j_imag"] - 66**3) <= row["j_error"]
    assert row["j_error"] < 10.0
    assert row["hyperelliptic"] is None


def test_without_a_certificate_nothing_is_certified(tmp_path):
    path = tmp_path / "torus.off"
    igl.write_triangle_mesh(str(path), *torus_of_revolution(2.0, 0.8, 20, 12))
    for surface in (path, DATA / "lawson_2_1.off"):
        (row,) = rows_of(surface, BatchOptions(weights="extrinsic"))
        assert row["matrix_real"] is not None
        assert [row[name] for name in ("bound", "entry_bound", "j_error")] == 3 * [None]
        assert [row[name] for name in ("hyperelliptic", "vanishing_thetas")] == 2 * [None]
        assert row["igusa_real"] is None


@pytest.mark.parametrize(
    ("name", "roots"),
    [("omega_2.json", [0, 1, -1, 1j, -1j]), ("omega_3.json", [1.5, 2.0, 3.0])],
)
def test_absolute_invariants_of_curves_of_genus_two(name, roots):
    (row,) = rows_of(DATA / name, BatchOptions(tolerance=1e-10))
    assert (row["hyperelliptic"], row["vanishing_thetas"]) == (True, 0)
    i2, i4, i6, i10 = igusa_clebsch_invariants(roots)
    found = np.array(row["igusa_real"]) + 1j * np.array(row["igusa_imag"])
    np.testing.assert_allclose(found, np.array([i2**5, i2**3 * i4, i2**2 * i6]) / i10, rtol=1e-7)


def test_hyperelliptic_in_genus_three(tmp_path):
    # "no" is proved; "yes" is not, and is not told.
    (klein,) = rows_of(DATA / "klein.json", BatchOptions(tolerance=1e-3))
    assert (klein["hyperelliptic"], klein["vanishing_thetas"]) == (False, 0)
    roots = [1, 2, -1, -2, 1j, -1j, 2j, 1 + 2j]
    path = write_gluing(tmp_path / "curve.json", cyclic_cover(2, roots, size=0.4))
    (curve,) = rows_of(path, BatchOptions(tolerance=1e-6))
    assert (curve["genus"], curve["hyperelliptic"], curve["vanishing_thetas"]) == (3, None, 1)


# ---- Files ----


def test_a_folder_is_searched_with_all_folders_in_it(tmp_path):
    for name in ("b.off", "a/z.OBJ", "a/y/x.json", "c.txt", ".hidden.off", ".git/d.off"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    (tmp_path / "lost.ply").symlink_to("nowhere.ply")
    os.mkfifo(tmp_path / "pipe.off")
    found = find_files(tmp_path)
    assert list(found) == ["a/y/x.json", "a/z.OBJ", "b.off", "lost.ply"]
    assert found["a/z.OBJ"] == tmp_path / "a/z.OBJ"


def test_a_list_is_relative_to_its_folder(tmp_path, monkeypatch):
    folder = tmp_path / "lists"
    folder.mkdir()
    text = "\ufeff# meshes\n\nb.off\n  sub/a b.off  \r\n../c.off\nb.off\n/d.off\n"
    (folder / "list.txt").write_text(text)
    monkeypatch.chdir(tmp_path)
    found = find_files("lists/list.txt")
    assert list(found) == ["b.off", "sub/a b.off", "../c.off", "/d.off"]
    assert found["sub/a b.off"] == folder / "sub/a b.off"


def test_several_sources_are_named_as_given(tmp_path, monkeypatch):
    write_tori(tmp_path / "one", 1)
    write_tori(tmp_path / "two", 1)
    monkeypatch.chdir(tmp_path)
    assert list(find_files("two", "one/torus_00.off")) == ["two/torus_00.off", "one/torus_00.off"]
    assert list(find_files("one/torus_00.off")) == ["torus_00.off"]


def test_names_that_are_no_text(tmp_path):
    path = os.path.join(os.fsencode(tmp_path), b"caf\xe9.off")
    with open(path, "w") as file:
        file.write(TETRAHEDRON)
    ((name, found),) = find_files(tmp_path).items()
    assert name == "caf\\xe9.off"
    assert rows_of(found, name=name)[0]["genus"] == 0


@pytest.mark.parametrize(
    ("content", "error", "message"),
    [
        (None, FileNotFoundError, "there is no folder and no list"),
        (b"# nothing\n\n", ip.MeshError, "there is no path in this list"),
        (b"PAR1\0\0", ip.MeshError, "no folder, no mesh, and no text file"),
    ],
)
def test_lists_that_are_none(tmp_path, content, error, message):
    if content is not None:
        (tmp_path / "list").write_bytes(content)
    with pytest.raises(error, match=message):
        find_files(tmp_path / "list")


def test_an_empty_folder(tmp_path):
    with pytest.raises(ip.MeshError, match=r"there is no mesh in the folder .* \(\.obj \.off"):
        find_files(tmp_path)


# ---- The journal ----


@pytest.fixture
def journal(tmp_path):
    """A journal of three files."""
    path = tmp_path / "x.parquet.journal"
    with Journal(path) as kept:
        for k in range(3):
            kept.append([(f"{k}.off", [{"hash": str(k), "bound": 0.1 + k / 3}])])
    return path


def test_a_journal_cut_anywhere_keeps_all_whole_lines(journal):
    whole = journal.read_bytes()
    with Journal(journal) as kept:
        everything = kept.rows
    assert len(everything) == 3
    for length in range(0, len(whole), 7):
        journal.write_bytes(whole[:length])
        lines = whole[:length].count(b"\n")
        with Journal(journal) as kept:
            assert list(kept.rows) == [f"{k}.off" for k in range(lines - 1)]
            kept.append([("new.off", [{"hash": None}])])
        with Journal(journal) as kept:
            assert kept.rows.pop("new.off") == [{"hash": None}]
            assert kept.rows.items() <= everything.items()


def test_damage_at_the_end_is_cut_off(journal):
    whole = journal.read_bytes()
    for damage in (b"\0" * 40, b"[]\n", b'["a", []]\n', b"{}\n{}\n", b"\xff\xfe\n", b"3\n"):
        journal.write_bytes(whole + damage)
        with Journal(journal) as kept:
            assert len(kept.rows) == 3
        assert journal.read_bytes() == whole


def test_the_last_line_about_a_file_counts(journal):
    with Journal(journal) as kept:
        kept.append([("1.off", [{"hash": "new"}])])
    with Journal(journal) as kept:
        assert kept.rows["1.off"] == [{"hash": "new"}]
    with Journal(journal, restart=True) as kept:
        assert kept.rows == {}


def test_a_journal_is_written_by_one_run_and_is_no_other_file(journal):
    with Journal(journal), pytest.raises(BlockingIOError, match="another run is writing"):
        Journal(journal)
    journal.write_text("my diary\n")
    with pytest.raises(FileExistsError, match="is no journal of a batch"):
        Journal(journal, restart=True)
    assert journal.read_text() == "my diary\n"


# ---- Runs ----


def test_one_and_many_workers_give_the_same_rows(tmp_path, cluster):
    write_tori(tmp_path / "m", 6)
    write_tori(tmp_path / "m/sub", 2)
    two_tori(tmp_path / "m")
    (tmp_path / "m/broken.off").write_text("OFF")
    (tmp_path / "m/sphere.off").write_text(TETRAHEDRON)
    files, options = find_files(tmp_path / "m"), BatchOptions(degree=2)
    many = run_batch(files, tmp_path / "many.parquet", options, client=cluster)
    one = run_batch(files, tmp_path / "one.parquet", options, workers=1)
    here = computed_here(files, options)
    assert (len(many.rows), many.computed, many.kept, len(many.refused)) == (12, 11, 0, 1)
    assert timeless(many.rows) == timeless(one.rows) == timeless(here)
    # Nothing is lost on the way to Parquet, not even the last bit.
    assert read_rows(tmp_path / "many.parquet") == many.rows
    assert pq.read_schema(tmp_path / "many.parquet").names == list(COLUMNS)
    assert {path.name for path in tmp_path.iterdir() if path.is_file()} == {
        "many.parquet", "many.parquet.journal", "one.parquet", "one.parquet.journal"
    }  # fmt: skip


def wait_for(condition) -> None:
    deadline = time.monotonic() + 120.0
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def wait_for_lines(path: Path, n: int) -> None:
    wait_for(lambda: path.exists() and path.read_bytes().count(b"\n") >= n)


def is_running(group: int) -> bool:
    """Whether there is a process left of the group."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def test_a_worker_killed_in_the_middle_loses_nothing(tmp_path, cluster):
    write_tori(tmp_path / "m", 24, "slow_")
    files, output = find_files(tmp_path / "m"), tmp_path / "x.parquet"
    killed = []

    def kill_one():
        wait_for_lines(tmp_path / "x.parquet.journal", 5)
        killed.append(next(iter(cluster.run(os.getpid).values())))
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill_one)
    killer.start()
    result = run_batch(files, output, client=cluster)
    killer.join()
    assert killed
    assert not Path(f"/proc/{killed[0]}").exists()
    assert timeless(result.rows) == timeless(computed_here(files))


def test_a_file_that_kills_every_worker_is_a_row(tmp_path, cluster, address, capsys):
    write_tori(tmp_path / "m", 8)
    (tmp_path / "m/poison.off").write_text(TETRAHEDRON)
    files, output = find_files(tmp_path / "m"), tmp_path / "x.parquet"
    seen = []
    result = run_batch(files, output, client=cluster, progress=lambda *counts: seen.append(counts))
    (dead,) = result.refused
    assert (dead["file"], dead["error_kind"]) == ("poison.off", "WorkerDied")
    assert dead["error"].startswith("the worker died 4 times")
    assert dead["hash"] == file_hash(tmp_path / "m/poison.off")
    assert (seen[0], seen[-1]) == ((0, 0, 9), (9, 1, 9))
    healthy = {name: path for name, path in files.items() if name != "poison.off"}
    rest = [row for row in result.rows if row is not dead]
    assert timeless(rest) == timeless(computed_here(healthy))
    # It is not tried again, unless asked for.
    arguments = [str(tmp_path / "m"), "-o", str(output), "--scheduler", address]
    assert main(["batch", *arguments]) == 0
    printed = capsys.readouterr().out
    assert "nothing to do" in printed
    assert "workers died on poison.off" in printed


@pytest.mark.slow
def test_files_that_kill_workers_of_our_own(tmp_path, habits):
    write_tori(tmp_path / "m", 8)
    for name in ("poison_1.off", "poison_2.off"):
        (tmp_path / "m" / name).write_text(TETRAHEDRON)
    with dask.config.set({"distributed.worker.preload": [str(habits)]}):
        result = run_batch(find_files(tmp_path / "m"), tmp_path / "x.parquet", workers=2)
    kinds = {row["file"]: row["error_kind"] for row in result.refused}
    assert kinds == dict.fromkeys(["poison_1.off", "poison_2.off"], "WorkerDied")
    assert len(result.rows) == 10


def test_what_has_changed_is_computed_anew(tmp_path, cluster, monkeypatch):
    write_tori(tmp_path / "m", 3)
    (tmp_path / "m/broken.off").write_text("OFF")
    output = tmp_path / "x.parquet"
    run = partial(run_batch, output=output, client=cluster)
    first = run(find_files(tmp_path / "m"))
    assert run(find_files(tmp_path / "m")).computed == 0
    assert read_rows(output) == first.rows
    igl.write_triangle_mesh(str(tmp_path / "m/torus_01.off"), *noisy_torus(9, 7, 0.1, 5))
    (tmp_path / "m/torus_02.off").unlink()
    write_tori(tmp_path / "m/new", 1)
    second = run(find_files(tmp_path / "m"))
    assert (second.computed, second.kept) == (2, 2)
    names = [row["file"] for row in second.rows]
    assert names == ["broken.off", "new/torus_00.off", "torus_00.off", "torus_01.off"]
    assert second.rows[2] == first.rows[1]
    assert second.rows[3]["vertices"] == 63
    files = find_files(tmp_path / "m")
    assert run(files, retry=True).computed == 1
    assert run(files, restart=True).computed == 4
    assert run(files, options=BatchOptions(degree=2)).computed == 4
    monkeypatch.setattr("igl_periods.batch.run.version", lambda name: "0.0.0")
    assert run(files, options=BatchOptions(degree=2)).computed == 4


def test_a_missing_file_is_a_row_until_it_is_there(tmp_path, cluster):
    (tmp_path / "list").write_text("sphere.off\nlater.off\n")
    (tmp_path / "sphere.off").write_text(TETRAHEDRON)
    run = partial(run_batch, output=tmp_path / "x.parquet", client=cluster)
    rows = run(find_files(tmp_path / "list")).rows
    assert [row["error_kind"] for row in rows] == [None, "FileNotFoundError"]
    assert run(find_files(tmp_path / "list")).computed == 0
    (tmp_path / "later.off").write_text(TETRAHEDRON)
    assert [row["error"] for row in run(find_files(tmp_path / "list")).rows] == [None, None]


def test_an_output_that_cannot_be_written_is_refused_at_once(tmp_path):
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        run_batch({}, tmp_path / "no/x.parquet")
    (tmp_path / "x.parquet").mkdir()
    with pytest.raises(IsADirectoryError, match="is a folder"):
        run_batch({}, tmp_path / "x.parquet")


# ---- Clusters ----


def test_a_worker_that_cannot_do_its_work_makes_rows_with_errors(tmp_path, cluster, monkeypatch):
    monkeypatch.setattr(batch_cluster, "compute_file", operator.neg)
    (row,) = run_batch({"a": "a.off"}, tmp_path / "x.parquet", client=cluster).rows
    assert (row["file"], row["error_kind"]) == ("a", "TypeError")


def test_clusters_that_cannot_be_used(address, monkeypatch):
    monkeypatch.setattr(batch_cluster, "_CONNECTING", 0.5)
    for other in ("tcp://127.0.0.1:1", "nonsense://x"):
        with (
            pytest.raises(BatchError, match=r"there is no scheduler at .* that can be reached"),
            remote_cluster(other),
        ):
            pass
    found_versions = distributed.Client.get_versions

    def get_versions(client, **options):
        found = found_versions(client, **options)
        found["client"]["packages"]["igl_periods"] = "9.9"
        return found

    monkeypatch.setattr(distributed.Client, "get_versions", get_versions)
    with (
        pytest.raises(BatchError, match=r"has igl_periods \S+, and here it is 9.9"),
        remote_cluster(address),
    ):
        pass


def test_a_cluster_without_workers(tmp_path, monkeypatch):
    monkeypatch.setattr(batch_cluster, "_PATIENCE", 0.5)
    monkeypatch.setattr(batch_cluster, "_POLL", 0.1)
    monkeypatch.setattr(batch_cluster, "_CONNECTING", 0.5)
    with local_cluster(0) as client:
        with (
            pytest.raises(BatchError, match=r"has no workers\. Start some: 'dask worker tcp"),
            remote_cluster(client.scheduler.address),
        ):
            pass
        with pytest.raises(BatchError, match="has had no worker"):
            run_batch({"a": "a.off"}, tmp_path / "x.parquet", client=client)


def test_a_cluster_that_is_lost(tmp_path, monkeypatch):
    write_tori(tmp_path / "m", 1)
    with local_cluster(0) as client:
        threading.Timer(0.3, client.shutdown).start()
        with pytest.raises(BatchError, match="has been lost"):
            run_batch(find_files(tmp_path / "m"), tmp_path / "x.parquet", client=client)


# ---- The command ----


def test_the_command_on_a_cluster(tmp_path, address, capsys):
    write_tori(tmp_path / "m", 3)
    (tmp_path / "m/broken.off").write_text("OFF")
    output = tmp_path / "x.parquet"
    command = ["batch", str(tmp_path / "m"), "-o", str(output), "--scheduler", address]
    assert main([*command, "--degree", "2"]) == 0
    printed = capsys.readouterr()
    assert f"{output}: 4 rows of 4 files (4 computed now, 0 kept from before)" in printed.out
    assert "1 without a period matrix" in printed.out
    assert "1 MeshError" in printed.out
    assert printed.err == ""
    rows = read_rows(output)
    assert [row["file"] for row in rows] == [
        "broken.off", "torus_00.off", "torus_01.off", "torus_02.off"
    ]  # fmt: skip
    pm = ip.period_matrix(*ip.load_mesh(tmp_path / "m/torus_01.off")[:2], degree=2).reduced()
    assert np.array_equal(matrix(rows[2]), pm.matrix)
    assert main([*command, "--degree", "2"]) == 0
    assert "nothing to do: no file has changed" in capsys.readouterr().out
    assert main([*command, "--degree", "2", "--retry"]) == 0
    assert "1 computed now, 3 kept from before" in capsys.readouterr().out


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


def started(*arguments, **options):
    command = [sys.executable, "-m", "igl_periods", "batch", *map(str, arguments)]
    return subprocess.Popen(command, **options)


def test_a_run_that_is_killed_goes_on_where_it_stopped(tmp_path, address):
    write_tori(tmp_path / "m", 30, "slow_")
    output, journal = tmp_path / "x.parquet", tmp_path / "x.parquet.journal"
    reader, terminal = pty.openpty()
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("4H", 24, 80, 0, 0))
    first = started(tmp_path / "m", "-o", output, "--scheduler", address, stderr=terminal)
    wait_for_lines(journal, 6)
    first.kill()
    first.wait()
    os.close(terminal)
    # On a terminal there is a bar that counts.
    assert "/30 [" in os.read(reader, 10_000).decode()
    os.close(reader)
    assert not output.exists()
    kept = journal.read_bytes().count(b"\n") - 1
    assert 0 < kept < 30
    with journal.open("ab") as file:
        file.write(b'["slow_torus_29.off", [{"fi')
    with remote_cluster(address) as client:
        result = run_batch(find_files(tmp_path / "m"), output, client=client)
    assert (result.computed, result.kept) == (30 - kept, kept)
    expected = [
        row for n, path in find_files(tmp_path / "m").items() for row in rows_of(path, name=n)
    ]
    assert timeless(read_rows(output)) == timeless(expected)


def test_interrupted_from_the_keyboard(tmp_path, habits):
    write_tori(tmp_path / "m", 60, "slow_")
    output, journal = tmp_path / "x.parquet", tmp_path / "x.parquet.journal"
    run = started(
        tmp_path / "m", "-o", output, "--workers", 2,
        env={**os.environ, "DASK_DISTRIBUTED__WORKER__PRELOAD": str(habits)},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        # Whoever runs the tests in the background may have it ignored, and that is inherited.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip
    wait_for_lines(journal, 4)
    # As a terminal does: to every process of the group.
    os.killpg(run.pid, signal.SIGINT)
    out, err = run.communicate(timeout=60)
    assert run.returncode == 130
    assert out == ""
    assert err == (
        f"igl-periods: interrupted. What was finished is kept in {journal}: the same command goes "
        "on from there.\n"
    )
    wait_for(lambda: not is_running(run.pid))
    with Journal(journal) as kept:
        assert 3 <= len(kept.rows) < 60


def test_dask_and_arrow_are_imported_by_nothing_else():
    late = {"dask", "distributed", "pyarrow", "open3d", "tqdm"}
    code = f"import sys, igl_periods.cli.program; print({late} & {{*sys.modules}})"
    command = [sys.executable, "-c", code]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "set()\n"
