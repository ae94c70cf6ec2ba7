"""What a proof costs at degree 1: CPU microseconds a face beyond the solve; and both bounds.

    OPENBLAS_NUM_THREADS=1 python scripts/measure/rigorous.py [--large] [--json FILE]

All meshes of the folder that IGL_PERIODS_MESHES names, each component for itself; those with a
boundary, or not orientable, are doubled.  ``--large`` measures a surface of genus 2 with 1.5
million faces instead.
"""

import argparse
import json
import os
import time
from pathlib import Path

import numpy as np

import igl_periods as ip
from igl_periods.surfaces import voxel_surface

SUFFIXES = {".obj", ".off", ".ply", ".stl"}


def surfaces(path):
    """Closed, connected surfaces of positive genus in a file."""
    V, F, _ = ip.load_mesh(path, repair=True)
    try:
        whole = ip.DeltaComplex.from_mesh(V, F)
    except ip.ComplexError as error:
        print(f"{path.name}: {error}")
        return
    for part in whole.components():
        is_closed = part.n_boundary_edges == part.n_reversing_edges == 0
        K = part if is_closed else ip.double(part)
        if K.genus > 0:
            yield K


def large():
    """A box with two square holes, in unit cubes: 1.5 million faces, genus 2."""
    n = 122
    solid = np.ones((5 * n, 3 * n, n), dtype=bool)
    for first in (n, 3 * n):
        solid[first : first + n, n : 2 * n] = False
    return ip.DeltaComplex.from_mesh(*voxel_surface(solid))


def measured(name, K):
    """One row: CPU microseconds a face, and both bounds."""
    seconds, bounds = [], []
    for rigorous in (False, True):
        start = time.process_time()
        bounds.append(ip.period_matrix(K, rigorous=rigorous).bound)
        seconds.append(time.process_time() - start)
    return {
        "surface": name,
        "genus": K.genus,
        "faces": K.n_faces,
        "seconds": seconds[0],
        "microseconds_a_face": 1e6 * (seconds[1] - seconds[0]) / K.n_faces,
        "bound": bounds[0],
        "proved": bounds[1],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    rows = []
    folder = Path(os.environ.get("IGL_PERIODS_MESHES", "."))
    paths = sorted(x for x in folder.iterdir() if x.suffix in SUFFIXES)
    named = ((path.name, K) for path in paths for K in surfaces(path))
    for name, K in [("large", large())] if arguments.large else named:
        rows.append(measured(name, K))
        row = rows[-1]
        print(
            f"{name}: genus {row['genus']}, {row['faces']:,} faces, {row['seconds']:.2f} s, "
            f"{row['microseconds_a_face']:.2f} us a face more, bound {row['bound']:.3g}, "
            f"proved {row['proved']:.6g} ({row['proved'] / row['bound'] - 1.0:+.2e})",
            flush=True,
        )
    if arguments.json is not None:
        arguments.json.write_text(json.dumps({"rigorous": rows}, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
