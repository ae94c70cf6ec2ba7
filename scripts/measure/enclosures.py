"""Seconds that proved digits take: a table of surfaces by digits, in CPU seconds of one core.

    OPENBLAS_NUM_THREADS=1 python scripts/measure/enclosures.py [--digits 30 50] [--only omega_1 …]

Surfaces from files are read from the folder that IGL_PERIODS_MESHES names.
"""

import argparse
import os
import time
import warnings
from pathlib import Path

import igl_periods as ip

NAMED = {
    **dict.fromkeys(("omega_1", "omega_2", "omega_3"), ip.surfaces.square_tiled_surface),
    **dict.fromkeys(("bolza", "klein", "fermat"), ip.surfaces.regular_map_surface),
}
FILES = ("Csaszar.ply", "kq_surface.obj", "bob_small.ply", "eight.off", "3holes.obj")


def measured(name, digits):
    """CPU seconds and the enclosure."""
    if name in NAMED:
        surface = (NAMED[name](name),)
    else:
        surface = ip.load_mesh(Path(os.environ["IGL_PERIODS_MESHES"]) / name)[:2]
    start = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ip.ToleranceWarning)
        result = ip.enclose(*surface, digits=digits)
    return time.process_time() - start, result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--digits", type=int, nargs="+", default=[30, 50, 100])
    names = [*NAMED, *(FILES if "IGL_PERIODS_MESHES" in os.environ else ())]
    parser.add_argument("--only", nargs="+", choices=names, default=names)
    arguments = parser.parse_args()
    print(
        "| surface (faces, genus) | " + " | ".join(f"{d} digits" for d in arguments.digits) + " |"
    )
    print("|---" * (1 + len(arguments.digits)) + "|")
    for name in arguments.only:
        cells = []
        for digits in arguments.digits:
            seconds, result = measured(name, digits)
            cells.append(f"{seconds:.1f} s, {result.digits} digits")
        size = f"({result.complex.n_faces}, {result.genus})"
        print(f"| {name} {size} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
