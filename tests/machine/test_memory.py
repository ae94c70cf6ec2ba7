"""Runs that would exceed the memory are refused beforehand, with an estimate."""

import json
import subprocess
import sys

import igl
import pytest

import igl_periods as ip
from igl_periods.cli.program import main
from igl_periods.machine import memory
from igl_periods.surfaces import thickened_lattice

LATTICE = thickened_lattice((4, 3, 3), 2, jitter=0.1)


N, M = len(LATTICE[0]), len(LATTICE[1])


def test_too_little_memory_is_refused_with_an_estimate():
    message = rf"harmonic forms on {N:,} vertices with 80 cohomology classes take about 0.00\d+ GB"
    with pytest.raises(ip.MemoryLimitError, match=message + ", and 0.001 GB are allowed"):
        ip.period_matrix(*LATTICE, max_memory=1e6)


def test_too_little_memory_on_the_machine(monkeypatch):
    monkeypatch.setattr(memory, "available_memory", lambda: 1e6)
    with pytest.raises(ip.MemoryLimitError, match=r"and 0\.001 GB are available"):
        ip.period_matrix(*LATTICE)
    # What there is counts, whatever is allowed.
    with pytest.raises(ip.MemoryLimitError, match=r"and 0\.001 GB are available"):
        ip.period_matrix(*LATTICE, max_memory=1e12)
    monkeypatch.setattr(memory, "available_memory", lambda: 1e3)
    with pytest.raises(ip.MemoryLimitError, match=rf"a complex of {M:,} faces takes about"):
        ip.period_matrix(*LATTICE)


@pytest.mark.skipif(sys.platform != "linux", reason="limits of address space are those of Linux")
def test_limits_of_the_process_count():
    code = """
import resource
from igl_periods.machine import available_memory
free = available_memory()
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 10_000_000, resource.RLIM_INFINITY))
assert available_memory() <= 10_000_000 < free
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_command_line_takes_a_limit(tmp_path, capsys):
    mesh = tmp_path / "lattice.off"
    igl.write_triangle_mesh(str(mesh), *LATTICE)
    assert main(["compute", str(mesh), "--max-memory", "0.001"]) == 1
    assert "and 0.001 GB are allowed. Simplify the mesh" in capsys.readouterr().err
    assert main(["compute", str(mesh), "--max-memory", "1", "--json"]) == 0
    output = capsys.readouterr().out
    # Of so high a genus on one line.
    assert output.count("\n") == 1
    assert len(json.loads(output)["reduced_marking"]["matrix"]["real"]) == 40


@pytest.mark.parametrize(
    ("membership", "folder", "names"),
    [
        ("0::/user.slice/job_7", "", ("memory.max", "memory.current")),
        ("4:memory:/job_7\n3:cpu:/x", "memory", ("memory.limit_in_bytes", "memory.usage_in_bytes")),
    ],
)
def test_limits_of_control_groups_count(monkeypatch, tmp_path, membership, folder, names):
    # The group has no limit, the one around it has: 4000 of 10000 bytes are left, 500 of files.
    job = tmp_path / folder / membership.splitlines()[0].split(":")[2].lstrip("/")
    job.mkdir(parents=True)
    around = job.parent
    (tmp_path / "cgroup").write_text(membership + "\n")
    (around / names[0]).write_text("10000\n")
    (around / names[1]).write_text("6000\n")
    (around / "memory.stat").write_text("anon 5000\ninactive_file 500\n")
    (job / names[0]).write_text("max\n")
    (job / names[1]).write_text("5500\n")
    monkeypatch.setattr(memory, "_MEMBERSHIP", tmp_path / "cgroup")
    monkeypatch.setattr(memory, "_CGROUP", tmp_path)
    assert memory.available_memory() == 4500
    monkeypatch.setattr(memory, "_MEMBERSHIP", tmp_path / "none")
    assert memory.available_memory() > 1e6
