"""Time and memory of period matrices, against bare CHOLMOD where there is something to compare.

Bare CHOLMOD is what nobody can avoid: analyse and factor the same Laplacian with the fastest of
its orderings, and solve for 2g right-hand sides.  Each measurement runs in a process of its own
(``measured_run.py``), the two in turn, and medians are compared.

    python scripts/measure/benchmark.py                              everything but digits
    python scripts/measure/benchmark.py speed --vertices 600000      two surfaces of genus 2
    python scripts/measure/benchmark.py growth                       from 10⁴ to 2·10⁶ vertices
    python scripts/measure/benchmark.py genus                        up to genus 1,521
    python scripts/measure/benchmark.py digits eight.off 3holes.obj  certified digits

Results go to ``results/benchmark.json``, one entry a section; ``guide_tables.py`` makes the tables
of the guide from it.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import igl
import numpy as np
from benchmark_surfaces import delaunay_surface, marching_cubes_surface
from scipy.sparse import csc_matrix, save_npz

import igl_periods as ip
from igl_periods.complexes.delaunay import delaunay_flips, intrinsic_delaunay
from igl_periods.complexes.weights import cotan_weights
from igl_periods.elements import least_energy as high_order
from igl_periods.elements.least_energy import high_order_forms
from igl_periods.elements.placement import choose_elements, separate_cones
from igl_periods.elements.trace_system import condensed_system, solve
from igl_periods.harmonic.laplace_matrix import grounded_laplacian
from igl_periods.surfaces import menger_sponge, thickened_lattice

ORDERINGS = ("amd", "metis", "nesdis", "default")
GROWTH = (10_000, 30_000, 100_000, 300_000, 1_000_000, 2_000_000)
# Of each surface of high genus: what makes it, and whether its matrix is Siegel reduced.
GENUS = {
    "lattice of 5 × 5 × 5 nodes": (lambda: thickened_lattice((5, 5, 5), 3, aspect=4), True),
    "lattice of 8 × 7 × 7 nodes": (lambda: thickened_lattice((8, 7, 7), 2, aspect=3), True),
    "lattice of 10 × 10 × 9 nodes": (lambda: thickened_lattice((10, 10, 9), 2, aspect=1), False),
    "Menger sponge of level 3": (lambda: menger_sponge(3), False),
}


def run(*arguments):
    """One computation in a process of its own."""
    script = Path(__file__).with_name("measured_run.py")
    done = subprocess.run(
        [sys.executable, str(script), *map(str, arguments)],
        check=True,
        capture_output=True,
        text=True,
    )
    return json.loads(done.stdout.splitlines()[-1])


def median(runs, key="seconds"):
    return statistics.median(result[key] for result in runs)


def against_cholmod(name, V, F, repeats, orderings):
    """``period_matrix(V, F).reduced()`` and bare CHOLMOD, in turn."""
    K = ip.DeltaComplex.from_mesh(V, F)
    flipped, rounds = delaunay_flips(K)
    rho = cotan_weights(flipped)
    with tempfile.TemporaryDirectory() as folder:
        mesh, matrix = Path(folder) / "mesh.npz", Path(folder) / "matrix.npz"
        np.savez(mesh, V=V, F=F)
        save_npz(matrix, csc_matrix(grounded_laplacian(flipped, rho)), compressed=False)
        del flipped
        trial = {ordering: run("cholmod", matrix, ordering, 2 * K.genus) for ordering in orderings}
        best = min(trial, key=lambda ordering: trial[ordering]["seconds"])
        pairs = [
            (run("period_matrix", mesh), run("cholmod", matrix, best, 2 * K.genus))
            for _ in range(repeats)
        ]
    ours, bare = zip(*pairs)
    result = {
        "surface": name,
        "vertices": K.n_vertices,
        "faces": K.n_faces,
        "genus": K.genus,
        "flips": sum(len(flips.edge) for flips in rounds),
        "bad_edges": float(np.mean(cotan_weights(K) < -1e-12)),
        "bound": ours[0]["bound"],
        "seconds": median(ours),
        "cholmod_seconds": median(bare),
        "ratio": statistics.median(a["seconds"] / b["seconds"] for a, b in pairs),
        "ratios": [a["seconds"] / b["seconds"] for a, b in pairs],
        "peak_bytes": median(ours, "peak_bytes"),
        "cholmod_peak_bytes": median(bare, "peak_bytes"),
        "ordering": best,
        "orderings": {ordering: trial[ordering]["seconds"] for ordering in orderings},
        "stages": {
            stage: statistics.median(one["stages"][stage] for one in ours)
            for stage in ours[0]["stages"]
        },
        "cholmod_stages": {
            stage: statistics.median(one["stages"][stage] for one in bare)
            for stage in bare[0]["stages"]
        },
    }
    result["memory_ratio"] = result["peak_bytes"] / result["cholmod_peak_bytes"]
    show(result)
    return result


def show(result):
    print(
        f"\n{result['surface']}: {result['vertices']:,} vertices, genus {result['genus']}, "
        f"{100 * result['bad_edges']:.1f} % of the edges not Delaunay ({result['flips']:,} flips), "
        f"bound {result['bound']:.2e}"
    )
    for stage, seconds in result["stages"].items():
        print(f"  {stage:<20} {seconds:8.3f} s")
    print(f"  {'all':<20} {result['seconds']:8.3f} s  {result['peak_bytes'] / 1e6:8.0f} MB")
    print(
        f"  {'bare CHOLMOD':<20} {result['cholmod_seconds']:8.3f} s  "
        f"{result['cholmod_peak_bytes'] / 1e6:8.0f} MB  ({result['ordering']})"
    )
    print(f"  {'ratio':<20} {result['ratio']:8.2f}    {result['memory_ratio']:8.2f}", flush=True)


def speed(options):
    """The two large surfaces, with all orderings of CHOLMOD."""
    return [
        against_cholmod(name, *make(options.vertices), options.repeats, ORDERINGS)
        for name, make in (
            ("Lawson's, Delaunay as it is", delaunay_surface),
            ("from marching cubes", marching_cubes_surface),
        )
    ]


def growth(options):
    """One family of surfaces, and the exponents that fit its times and memory."""
    rows = [
        against_cholmod(
            f"Lawson's, {n:,} vertices", *delaunay_surface(n), options.repeats, ("amd",)
        )
        for n in GROWTH
    ]
    logarithm = np.log([row["vertices"] for row in rows])
    idle = run("idle")["peak_bytes"]
    exponents = {
        "seconds": np.polyfit(logarithm, np.log([row["seconds"] for row in rows]), 1)[0],
        "peak_bytes": np.polyfit(logarithm, np.log([row["peak_bytes"] - idle for row in rows]), 1)[
            0
        ],
    }
    print(f"\nexponents: time {exponents['seconds']:.2f}, memory {exponents['peak_bytes']:.2f}")
    return {"rows": rows, "exponents": exponents, "idle_bytes": idle}


def genus(options):
    """Surfaces of very high genus, with the time of their integer topology."""
    rows = []
    for name, (make, reduce) in GENUS.items():
        V, F = make()
        with tempfile.TemporaryDirectory() as folder:
            mesh = Path(folder) / "mesh.npz"
            np.savez(mesh, V=V, F=F)
            settings = json.dumps({"reduce": reduce})
            runs = [run("period_matrix", mesh, settings) for _ in range(options.repeats)]
        row = {
            "surface": name,
            "vertices": len(V),
            "faces": len(F),
            "genus": runs[0]["genus"],
            "bound": runs[0]["bound"],
            "rounding": runs[0]["rounding"],
            "topology_seconds": statistics.median(one["stages"]["homology"] for one in runs),
            "seconds": statistics.median(one["seconds"] - one["reduction"] for one in runs),
            "reduction_seconds": median(runs, "reduction") if reduce else None,
            "peak_bytes": median(runs, "peak_bytes"),
        }
        rows.append(row)
        print(json.dumps(row), flush=True)
    return rows


def digits(options):
    """Seconds to certified digits, and the cost of degree 6 relative to its sparse solution."""
    return [_digits(path, options.repeats) for path in options.mesh]


def _digits(path, repeats):
    V, F = igl.read_triangle_mesh(path)
    print(f"\n{path.name}: {len(V):,} vertices")
    result = {"surface": path.name, "vertices": len(V), "tolerances": {}}
    for tolerance in (1e-6, 1e-8, 1e-10):
        times = []
        for _ in range(repeats):
            seconds, pm = seconds_of(lambda tol=tolerance: ip.period_matrix(V, F, tolerance=tol))
            times.append(seconds)
        result["tolerances"][tolerance] = {"seconds": statistics.median(times), "bound": pm.bound}
        print(f"  bound <= {tolerance:.0e}: {statistics.median(times):8.2f} s  ({pm.bound:.1e})")
    K, cochains = separate_cones(*intrinsic_delaunay(pm.complex, pm.cocycles))
    ratios = []
    for _ in range(repeats):
        system = condensed_system(K, cochains, choose_elements(K, 6))
        bare, _ = seconds_of(lambda system=system: solve(system))
        whole, _ = seconds_of(lambda: high_order.dirichlet_matrix(high_order_forms(K, cochains, 6)))
        ratios.append(whole / bare)
    result["genus"] = pm.genus
    result["degree_6_ratio"] = statistics.median(ratios)
    print(f"  degree 6, everything over the sparse solution: {result['degree_6_ratio']:.2f}")
    return result


def seconds_of(function: Callable[[], object]) -> tuple[float, object]:
    start = time.perf_counter()
    result = function()
    return time.perf_counter() - start, result


SECTIONS = {"speed": speed, "growth": growth, "genus": genus, "digits": digits}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("section", nargs="?", choices=SECTIONS, help="all but digits by default")
    parser.add_argument("mesh", type=Path, nargs="*", help="meshes for the section digits")
    parser.add_argument("--vertices", type=int, default=600_000, help="of the section speed")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--json", type=Path, default=Path("results/benchmark.json"))
    options = parser.parse_args()
    sections = [options.section] if options.section else ["speed", "growth", "genus"]
    for section in sections:
        result = SECTIONS[section](options)
        written = json.loads(options.json.read_text()) if options.json.exists() else {}
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(written | {section: result}, indent=1) + "\n")


if __name__ == "__main__":
    main()
