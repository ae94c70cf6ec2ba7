"""Runs: the same rows on any number of workers, whoever is killed; only what has changed."""

import fcntl
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
import igl
import numpy as np
import pyarrow.parquet as pq
import pytest
from support.mesh_folders import TETRAHEDRON, matrix, two_tori, write_tori
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.batch import (
    BatchOptions,
    find_files,
    remote_cluster,
    rows_of,
    run_batch,
)
from igl_periods.batch import cluster as batch_cluster
from igl_periods.batch.journal import Journal
from igl_periods.batch.rows import COLUMNS, file_hash
from igl_periods.cli.program import main


def timeless(rows):
    return [{key: value for key, value in row.items() if key != "seconds"} for row in rows]


def computed_here(files, options=None):
    return [row for name, path in files.items() for row in rows_of(path, options, name)]


def read_rows(output):
    return pq.read_table(output).to_pylist()


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
