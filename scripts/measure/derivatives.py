"""What a gradient of the period matrix costs, beside the matrix itself; accuracy by degree.

    python scripts/measure/derivatives.py                       surfaces of 600,000 vertices
    python scripts/measure/derivatives.py --vertices 50000
    python scripts/measure/derivatives.py eight.off             Rauch's formula by degree

Processor time, in this process; best of a few runs.
"""

from __future__ import annotations

import argparse
import time

import igl
import numpy as np
from benchmark_surfaces import delaunay_surface, marching_cubes_surface

import igl_periods as ip
from igl_periods.complexes import with_positions

DEGREES = (1, 2, 3, 4, 5, 6)


def seconds(call, repeats):
    best, result = np.inf, None
    for _ in range(repeats):
        start = time.process_time()
        result = call()
        best = min(best, time.process_time() - start)
    return best, result


def cost(name, V, F, repeats):
    plain, pm = seconds(lambda: ip.period_matrix(V, F), repeats)
    keeping, kept = seconds(lambda: ip.period_matrix(V, F, keep_forms=True), repeats)
    W = np.ones((pm.genus, pm.genus)) + 1j
    back, _ = seconds(lambda: kept.gradient(W), repeats)
    forward, _ = seconds(lambda: kept.derivative(vertices=V), repeats)
    print(
        f"{name}: {len(V):,} vertices, genus {pm.genus}, {len(kept.forms.moves)} rounds of flips\n"
        f"  matrix {plain:.2f} s, with forms kept {keeping:.2f} s\n"
        f"  gradient {back:.2f} s ({back / plain:.2f} of the matrix), "
        f"one direction {forward:.2f} s ({forward / plain:.2f})"
    )


def accuracy(path):
    V, F = igl.read_triangle_mesh(path)
    K = ip.DeltaComplex.from_mesh(V, F)
    rng = np.random.default_rng(0)
    spacing = K.lengths.mean()
    directions = {
        "linear in space": V @ rng.normal(size=(3, 3)),
        "every vertex at random": 0.3 * spacing * rng.normal(size=V.shape),
    }
    for name, dV in directions.items():
        exact = difference(lambda t, dV=dV: with_positions(K, V + t * dV), 1e-3)
        print(f"{path}, {name}: degree, bound, relative error of the derivative")
        for degree in DEGREES:
            pm = ip.period_matrix(K, degree=degree, keep_forms=True)
            error = np.abs(pm.derivative(vertices=dV) - exact).max() / np.abs(exact).max()
            print(f"  {degree}  {pm.bound:.2e}  {error:.2e}")


def difference(surface, h):
    """The derivative of the matrix of degree 8, by differences of fourth order."""
    near, far = (
        ip.period_matrix(surface(t), degree=8).matrix
        - ip.period_matrix(surface(-t), degree=8).matrix
        for t in (h, 2 * h)
    )
    return (8 * near - far) / (12 * h)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="*")
    parser.add_argument("--vertices", type=int, default=600_000)
    parser.add_argument("--repeats", type=int, default=2)
    options = parser.parse_args()
    for path in options.meshes:
        accuracy(path)
    if not options.meshes:
        for name, make in (
            ("Delaunay as given", delaunay_surface),
            ("marching cubes", marching_cubes_surface),
        ):
            cost(name, *make(options.vertices), options.repeats)


if __name__ == "__main__":
    main()
