"""Seconds that proved digits take: surfaces by digits, in CPU seconds of one core.

    OPENBLAS_NUM_THREADS=1 python scripts/measure/enclosures.py [--only omega_1 …] [--json FILE]

Surfaces from files are read from the folder that IGL_PERIODS_MESHES names.  Measurements that the
JSON file has already stay there, unless they are made again.
"""

import argparse
import json
import os
import time
import warnings
from pathlib import Path

import igl_periods as ip

SQUARE_TILED = ("omega_1", "omega_2", "omega_3")
REGULAR_MAPS = ("bolza", "klein", "fermat")
FILES = ("kq_surface.obj", "eight.off", "3holes.obj")
DIGITS = {"kq_surface.obj": (30,), "eight.off": (8, 12), "3holes.obj": (8, 10)}


def surface_named(name):
    """The arguments of ``enclose``."""
    if name in SQUARE_TILED:
        return (ip.surfaces.square_tiled_surface(name),)
    if name in REGULAR_MAPS:
        return (ip.surfaces.regular_map_surface(name),)
    return ip.load_mesh(Path(os.environ["IGL_PERIODS_MESHES"]) / name)[:2]


def measured(name, digits):
    """One row: CPU seconds, and what was proved."""
    surface = surface_named(name)
    start = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ip.ToleranceWarning)
        result = ip.enclose(*surface, digits=digits)
    return {
        "surface": name,
        "faces": result.complex.n_faces,
        "genus": result.genus,
        "digits": digits,
        "proved": result.digits,
        "seconds": time.process_time() - start,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--digits", type=int, nargs="+", help="other digits than usual")
    names = [*SQUARE_TILED, *REGULAR_MAPS, *FILES]
    found = names if "IGL_PERIODS_MESHES" in os.environ else names[: -len(FILES)]
    parser.add_argument("--only", nargs="+", choices=names, default=found)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    known = arguments.json is not None and arguments.json.exists()
    rows = json.loads(arguments.json.read_text("utf-8"))["enclosures"] if known else []
    for name in arguments.only:
        for digits in arguments.digits or DIGITS.get(name, (30, 50)):
            row = measured(name, digits)
            print(
                f"{name}: {row['proved']} digits of {digits} in {row['seconds']:.1f} s", flush=True
            )
            rows = [x for x in rows if (x["surface"], x["digits"]) != (name, digits)] + [row]
            if arguments.json is not None:
                text = json.dumps({"enclosures": rows}, indent=1)
                arguments.json.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
