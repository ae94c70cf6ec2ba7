"""What one mesh on many ranks costs: constants measured here, and what follows for 10⁹ triangles.

Surfaces of genus 2 and of growing size are computed on the ranks of mpiexec, and of each are
measured: iterations, seconds per iteration, and the memory that its largest part takes.  The model
then takes from the largest of them the bytes and the seconds per owned vertex, and from all of
them how the number of iterations grows.

    mpiexec -n 1 python scripts/measure/weak_scaling.py delaunay
    mpiexec -n 2 python scripts/measure/weak_scaling.py marching-cubes --vertices 600000

Seconds are those of the processor, which others on the machine disturb less than the clock; waiting
for another rank counts, so those of one rank are the cleanest.  Memory is what a process takes on
top of what it had before: exact for the first surface only, and close where each is several
times as large as the one before.
"""

import argparse
import json
import logging
import statistics
import time
from pathlib import Path

import numpy as np
from benchmark import delaunay_surface, marching_cubes_surface
from mpi4py import MPI

from igl_periods.distributed import period_matrix
from igl_periods.machine import release_freed_memory
from igl_periods.run_log import logger

SURFACES = {"delaunay": delaunay_surface, "marching-cubes": marching_cubes_surface}
TRIANGLES = 1e9
GENUS = 2
# What rank 0 does alone.
INTEGERS = ("surface", "homology", "partition", "scattering")
# What is assumed: neighbours of a part, its ghosts over the root of its vertices, exchanges with
# every neighbour on each level of an iteration, coarsening, and seconds for one message.
NEIGHBOURS, GHOSTS, EXCHANGES, COARSENING, LATENCY = 6, 3.0, 6, 20.0, 2e-6


class Stages(logging.Handler):
    """Collects iterations, processor seconds and the most memory of this rank in each stage."""

    def __init__(self):
        super().__init__()
        self.seconds, self.iterations, self.peak, self.seam_rounds = {}, [], {}, 0

    def emit(self, record):
        stage = getattr(record, "stage", None)
        if getattr(record, "iterations", None) is not None:
            self.iterations.append(record.iterations)
        elif getattr(record, "seam_round", None) is not None:
            self.seam_rounds = record.seam_round
        elif stage and record.seconds is None:
            self.seconds[stage] = -time.process_time()
        elif stage:
            self.seconds[stage] += time.process_time()
            self.peak[stage] = memory("VmHWM")
            forget_peak()


def memory(name):
    """Bytes of this process: VmRSS now, VmHWM at the most."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return 1024 * int(next(line for line in lines if line.startswith(name)).split()[1])


def forget_peak():
    Path("/proc/self/clear_refs").write_text("5")


def measure(comm, name, n_vertices, rtol):
    V, F = SURFACES[name](n_vertices) if comm.rank == 0 else (None, None)
    stages = Stages()
    logger.addHandler(stages)
    logger.setLevel(logging.INFO)
    release_freed_memory()
    forget_peak()
    before = memory("VmRSS")
    pm = period_matrix(V, F, comm=comm, rtol=rtol)
    logger.removeHandler(stages)
    peaks = comm.gather({stage: peak - before for stage, peak in stages.peak.items()})
    if comm.rank > 0:
        return None
    owned = pm.complex.n_vertices / comm.size
    solving = stages.seconds["harmonic forms"] / sum(stages.iterations)
    root = max(peaks[0][stage] for stage in INTEGERS)
    result = {
        "surface": name,
        "ranks": comm.size,
        "vertices": pm.complex.n_vertices,
        "faces": pm.complex.n_faces,
        "bound": pm.bound,
        "iterations": stages.iterations,
        "seconds": stages.seconds,
        "iteration": solving / owned,
        "multigrid": stages.seconds["multigrid"] / owned,
        "seam_rounds": stages.seam_rounds,
        "flips": stages.seconds["Delaunay flips"] * comm.size / pm.complex.n_faces,
        "integers": sum(stages.seconds[stage] for stage in INTEGERS) / pm.complex.n_faces,
        "root": root / pm.complex.n_faces,
        "root_flips": peaks[0]["Delaunay flips"] / pm.complex.n_faces,
        "other": max(peaks[-1].values()) / owned if comm.size > 1 else float("nan"),
    }
    report(result)
    return result


def report(result):
    print(
        f"{result['surface']} on {result['ranks']}: {result['vertices']:,} vertices, "
        f"{result['faces']:,} faces, bound {result['bound']:.2e}\n"
        f"  iterations                             {result['iterations']}\n"
        f"  each, per owned vertex                 {1e6 * result['iteration']:8.3f} µs\n"
        f"  multigrid, per owned vertex            {1e6 * result['multigrid']:8.3f} µs\n"
        f"  rank 0 up to the partition, per face   {1e6 * result['integers']:8.3f} µs, "
        f"{result['root']:.0f} bytes\n"
        f"  flips, per face of a rank              {1e6 * result['flips']:8.3f} µs, "
        f"{result['seam_rounds']} rounds along seams, rank 0 holds "
        f"{result['root_flips']:.0f} bytes a face of all\n"
        f"  another rank, per owned vertex         {result['other']:8.0f} bytes\n"
        + "".join(f"  {stage:<38} {s:8.3f} s\n" for stage, s in result["seconds"].items()),
        flush=True,
    )


def model(results):
    """Time and memory of a surface of 10⁹ triangles on N ranks."""
    last, n = results[-1], TRIANGLES / 2
    iterations = [statistics.mean(result["iterations"]) for result in results]
    growth = 0.0
    if len(results) > 1:
        sizes = np.log10([result["vertices"] for result in results])
        growth = np.polyfit(sizes, iterations, 1)[0]
    expected = iterations[-1] + growth * np.log10(n / last["vertices"])
    print(
        f"10⁹ triangles like {last['surface']}, genus {GENUS}: {growth:+.1f} iterations for each "
        f"factor 10, {expected:.0f} expected; rank 0 works {TRIANGLES * last['integers']:.0f} s "
        f"before the others, with {1e-9 * TRIANGLES * last['root']:.0f} GB"
    )
    for N in (64, 256, 1024, 4096):
        owned = n / N
        ghosts = GHOSTS * np.sqrt(owned)
        levels = np.log(n) / np.log(COARSENING)
        latency = LATENCY * levels * (EXCHANGES * NEIGHBOURS + 3 * np.log2(N))
        work, setup = owned * last["iteration"], owned * last["multigrid"]
        flips = last["flips"] * TRIANGLES / N
        print(
            f"  {N:>5} ranks: {owned / 1e6:5.2f} M vertices, {ghosts:5.0f} ghosts "
            f"({8e-3 * ghosts:3.0f} kB an exchange), {1e-9 * owned * last['other']:6.2f} GB; "
            f"flips {flips:6.1f} s, multigrid {setup:6.1f} s, "
            f"an iteration {1e3 * work:7.1f} + {1e3 * latency:3.1f} ms, "
            f"all {flips + setup + 2 * GENUS * expected * (work + latency):7.1f} s"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("surface", choices=SURFACES)
    parser.add_argument(
        "--vertices", type=int, nargs="+", default=[10_000, 40_000, 160_000, 600_000]
    )
    parser.add_argument("--rtol", type=float, default=1e-8)
    parser.add_argument("--json", type=Path, help="write the measurements to this file")
    options = parser.parse_args()
    comm = MPI.COMM_WORLD
    # Libraries are loaded when they are first used: their memory is not that of a surface.
    period_matrix(*(SURFACES["delaunay"](2_000) if comm.rank == 0 else ()), comm=comm)
    results = [measure(comm, options.surface, n, options.rtol) for n in options.vertices]
    if comm.rank > 0:
        return
    model(results)
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
