"""End-to-end time of ``period_matrix(V, F)`` against bare CHOLMOD on the same matrix.

Bare CHOLMOD is what nobody can avoid: analyse and factor the same Laplacian with the fastest of
its orderings, and solve for 2g right-hand sides.  Both run in the same process, several times, and
the medians are compared.  Two surfaces of genus 2: one that is Delaunay as it comes (Lawson's
minimal surface, subdivided), and one of marching cubes, with many edges to flip.

With meshes as arguments: how long certified digits take there, and for elements of degree 6 the
time of everything over that of one factorisation and solution of their condensed system.

    python scripts/benchmark.py --vertices 600000 --repeats 5 --json results/benchmark.json
    python scripts/benchmark.py --repeats 3 eight.off 3holes.obj fertility.off
"""

from __future__ import annotations

import argparse
import itertools
import json
import logging
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import igl
import numpy as np
from sksparse.cholmod import analyze

import igl_periods as ip
from igl_periods import high_order
from igl_periods.assembly import condensed_system, solve
from igl_periods.delaunay import delaunay_flips, intrinsic_delaunay
from igl_periods.delta_complex import cotan_weights
from igl_periods.harmonic import laplacian
from igl_periods.high_order import choose_elements, high_order_forms, separate_cones
from igl_periods.stages import logger
from igl_periods.surfaces import lawson_surface

ORDERINGS = ("amd", "metis", "nesdis", "default")


def delaunay_surface(n_vertices):
    """Lawson's surface, cut into four as often as it takes: about ``n_vertices`` vertices."""
    coarse = next(
        mesh
        for n in itertools.count(4, 2)
        if 256 * len((mesh := lawson_surface(2, 1, n))[0]) > 0.95 * n_vertices
    )
    V, F = (np.ascontiguousarray(array) for array in coarse)
    for _ in range(4):
        V, F = split(V, F)
    return V, F


def split(V, F):
    """Every triangle into four; the surface stays the same."""
    sides = np.sort(np.stack([np.roll(F, -1, 1), np.roll(F, 1, 1)], -1).reshape(-1, 2), axis=1)
    key = sides[:, 0] * len(V) + sides[:, 1]
    _, first, index = np.unique(key, return_index=True, return_inverse=True)
    mid = len(V) + index.reshape(-1, 3)
    faces = [np.stack([F[:, s], mid[:, s - 1], mid[:, s - 2]], axis=1) for s in range(3)]
    return np.concatenate([V, V[sides[first]].mean(axis=1)]), np.concatenate([*faces, mid])


def marching_cubes_surface(n_vertices):
    """A smooth surface of genus 2 by marching cubes: about ``n_vertices`` vertices."""
    n = int(np.sqrt(n_vertices / 2.6))
    x, y, z = (np.linspace(-a, a, int(a * n)) for a in (1.6, 1.1, 0.45))
    grid = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3, order="F")
    X, Y, Z = grid.T
    lemniscate = (X**2 + Y**2) ** 2 - 2.0 * (X**2 - 0.75 * Y**2)
    field = lemniscate**2 + 1.6 * Z**2 - 0.045 * (1.0 + X**2 + Y**2)
    V, F, _ = igl.marching_cubes(
        np.ascontiguousarray(field), np.ascontiguousarray(grid), len(x), len(y), len(z), 0.0
    )
    return V, F


class Stages(logging.Handler):
    """Collects the times of the stages of the computation."""

    def __init__(self):
        super().__init__()
        self.seconds = {}

    def emit(self, record):
        if getattr(record, "seconds", None) is not None:
            self.seconds.setdefault(record.stage, []).append(record.seconds)


def seconds_of(function: Callable[[], object]) -> tuple[float, object]:
    start = time.perf_counter()
    result = function()
    return time.perf_counter() - start, result


def bare_cholmod(matrix, right_sides, ordering):
    """Analyse, factor and solve; the time of each."""
    start = time.perf_counter()
    factor = analyze(matrix, mode="supernodal", ordering_method=ordering)
    analysed = time.perf_counter()
    factor.cholesky_inplace(matrix)
    factored = time.perf_counter()
    factor(right_sides)
    return analysed - start, factored - analysed, time.perf_counter() - factored


def measure(name, V, F, repeats):
    stages = Stages()
    logger.addHandler(stages)
    logger.setLevel(logging.INFO)
    K = ip.DeltaComplex.from_mesh(V, F)
    flipped, rounds = delaunay_flips(K)
    grounded = laplacian(flipped, cotan_weights(flipped))[1:, 1:].tocsc()
    right_sides = np.random.default_rng(0).normal(size=(grounded.shape[0], 2 * K.genus))
    trial = {ordering: sum(bare_cholmod(grounded, right_sides, ordering)) for ordering in ORDERINGS}
    best = min(trial, key=trial.get)
    stages.seconds.clear()
    ours, bare = [], []
    for _ in range(repeats):
        seconds, pm = seconds_of(lambda: ip.period_matrix(V, F).reduced())
        ours.append(seconds)
        bare.append(sum(bare_cholmod(grounded, right_sides, best)))
    logger.removeHandler(stages)
    flips = sum(len(flips.edge) for flips in rounds)
    result = {
        "surface": name,
        "vertices": K.n_vertices,
        "faces": K.n_faces,
        "flips": flips,
        "bad_edges": float(np.mean(cotan_weights(K) < -1e-12)),
        "genus": pm.genus,
        "bound": pm.bound,
        "seconds": statistics.median(ours),
        "bare_cholmod_seconds": statistics.median(bare),
        "ratio": statistics.median(a / b for a, b in zip(ours, bare)),
        "ordering": best,
        "orderings": trial,
        "stages": {stage: statistics.median(times) for stage, times in stages.seconds.items()},
    }
    report(result)
    return result


def digits(path, repeats):
    """Seconds to certified digits, and the cost of degree 6 relative to its sparse solution."""
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
    result["degree_6_ratio"] = statistics.median(ratios)
    print(f"  degree 6, everything over the sparse solution: {result['degree_6_ratio']:.2f}")
    return result


def report(result):
    print(
        f"\n{result['surface']}: {result['vertices']:,} vertices, genus {result['genus']}, "
        f"{100 * result['bad_edges']:.1f} % of the edges not Delaunay ({result['flips']:,} flips), "
        f"bound {result['bound']:.2e}"
    )
    for stage, seconds in result["stages"].items():
        print(f"  {stage:<20} {seconds:8.3f} s")
    print(f"  {'all':<20} {result['seconds']:8.3f} s")
    print(f"  {'bare CHOLMOD':<20} {result['bare_cholmod_seconds']:8.3f} s  ({result['ordering']})")
    print(f"  ratio                {result['ratio']:8.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vertices", type=int, default=600_000)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--json", type=Path, help="write the measurements to this file")
    parser.add_argument("mesh", type=Path, nargs="*", help="measure the time to digits on these")
    options = parser.parse_args()
    if options.mesh:
        results = [digits(path, options.repeats) for path in options.mesh]
    else:
        results = [
            measure("Delaunay", *delaunay_surface(options.vertices), options.repeats),
            measure("marching cubes", *marching_cubes_surface(options.vertices), options.repeats),
        ]
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
