"""The command ``igl-periods``: parse, call, print.

Exit codes: 0 the matrix was computed, 1 the mesh was refused, 2 wrong usage.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import json
import logging
import os
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .delta_complex import DeltaComplex
from .identification import identify
from .mesh import MeshReport, load_mesh
from .periods import PeriodMatrix, siegel_reduced
from .pipeline import as_complex, period_matrix
from .serialization import read_gluing, result_to_json
from .stages import logger, stage
from .summary import summary


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit code."""
    options = _parser().parse_args(arguments)
    if sys.stderr.isatty() and not options.quiet:
        _show_stages()
    try:
        with warnings.catch_warnings(record=True) as caught:
            code = int(options.run(options))
        for warning in caught:
            print(f"igl-periods: warning: {warning.message}", file=sys.stderr)
        return code
    except BrokenPipeError:
        # Whoever reads the output has had enough, as ``head`` does.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        return _refused(str(error))
    except ValueError as error:
        message = str(error)
        return _refused(message if options.mesh in message else f"{options.mesh}: {message}")


def _parser() -> argparse.ArgumentParser:
    version = importlib.metadata.version("igl_periods")
    parser = argparse.ArgumentParser(
        prog="igl-periods",
        description="Period matrices of triangle meshes, with certified error bounds.",
        epilog="Exit codes: 0 done, 1 the mesh was refused, 2 wrong usage.",
    )
    parser.add_argument("--version", action="version", version=f"igl-periods {version}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    compute = commands.add_parser(
        "compute",
        help="the period matrix of a mesh",
        description="Compute the period matrix of a closed, oriented, connected triangle mesh.",
    )
    _add_mesh_arguments(compute)
    compute.add_argument("--json", action="store_true", help="print one JSON document")
    compute.set_defaults(run=_compute)
    recognise = commands.add_parser(
        "identify",
        help="which named surfaces a mesh can be",
        description="Compare the period matrix of a mesh with those of named surfaces.",
    )
    _add_mesh_arguments(recognise)
    recognise.add_argument(
        "--mesh-error",
        type=float,
        metavar="D",
        help="how far the mesh may be from the surface that it samples (a Siegel distance)",
    )
    recognise.set_defaults(run=_identify)
    return parser


def _add_mesh_arguments(command: argparse.ArgumentParser) -> None:
    """What every command needs to get from a mesh file to a period matrix."""
    command.add_argument(
        "mesh",
        metavar="MESH",
        help="a mesh (OBJ, OFF, PLY, STL, …), or a gluing of triangles (.json)",
    )
    command.add_argument(
        "--weights",
        choices=("intrinsic", "extrinsic"),
        default="intrinsic",
        help="measure edge weights on the surface (default), or in space (no bound)",
    )
    command.add_argument(
        "--no-delaunay",
        dest="delaunay",
        action="store_false",
        help="keep the triangulation as it is (the bound is less sharp)",
    )
    command.add_argument(
        "--degree", type=int, default=1, metavar="P", help="degree of the trial functions (1)"
    )
    command.add_argument(
        "--tolerance",
        type=float,
        metavar="R",
        help="raise the degree until the certified bound is at most R",
    )
    command.add_argument(
        "--repair",
        action="store_true",
        help="weld, drop, orient and split what keeps the mesh from being a surface",
    )
    command.add_argument("--quiet", action="store_true", help="no stage names on the terminal")


def _read(options: argparse.Namespace) -> tuple[DeltaComplex, MeshReport | None]:
    """The surface in a file, and the report of a mesh; a gluing (.json) has none."""
    with stage("reading the file"):
        if Path(options.mesh).suffix.lower() == ".json":
            return read_gluing(options.mesh), None
        V, F, report = load_mesh(options.mesh, repair=options.repair)
    return as_complex(V, F), report


def _period_matrix(options: argparse.Namespace) -> tuple[PeriodMatrix, str, MeshReport | None]:
    """The period matrix, with the surface in words and the report of a mesh."""
    K, report = _read(options)
    words = str(report) if report else f"{options.mesh}: {K.n_faces} triangles, glued as told"
    pm = period_matrix(K, **_chosen(options))
    return pm, words, report


def _chosen(options: argparse.Namespace) -> dict[str, Any]:
    """The options of :func:`period_matrix`."""
    return {name: getattr(options, name) for name in ("weights", "delaunay", "degree", "tolerance")}


def _identify(options: argparse.Namespace) -> int:
    pm, words, _ = _period_matrix(options)
    with stage("comparing"):
        found = identify(pm, tolerance=options.mesh_error)
    print(f"{words}\n\n{found}")
    return 0


def _compute(options: argparse.Namespace) -> int:
    pm, words, report = _period_matrix(options)
    with stage("Siegel reduction"):
        reduced, gamma = siegel_reduced(pm)
    if options.json:
        document = {
            **result_to_json(pm, reduced, gamma),
            "options": {**_chosen(options), "repair": options.repair},
            "mesh": report.as_dict() if report else None,
        }
        print(json.dumps(document, indent=1))
    else:
        print(f"{words}\n\n{summary(pm, reduced, gamma)}")
    return 0


def _refused(message: str) -> int:
    print(f"igl-periods: {message}", file=sys.stderr)
    return 1


def _show_stages() -> None:
    """Show each stage on the terminal while it runs, and its time when it is done."""
    handler = logging.StreamHandler(sys.stderr)
    handler.terminator = ""
    handler.setFormatter(_StageFormatter())
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)


class _StageFormatter(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        name, seconds = getattr(record, "stage", None), getattr(record, "seconds", None)
        if name is None:
            return f"\r  {record.getMessage()}\n"
        return f"\r  {name} …" if seconds is None else f"\r  {name:<20} {seconds:8.2f} s\n"


if __name__ == "__main__":
    sys.exit(main())
