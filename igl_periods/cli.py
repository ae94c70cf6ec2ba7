"""The command ``igl-periods``: parse, call, print.

Exit codes: 0 the matrix was computed, 1 the mesh was refused, 2 wrong usage, 130 interrupted.
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
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .cli_batch import add_batch_command
from .cli_demo import add_demo_command
from .cli_pictures import add_commands
from .cli_surface import (
    ALL,
    add_memory_argument,
    add_period_arguments,
    add_surface_arguments,
    chosen_options,
    memory_limit,
    read_surfaces,
)
from .double import real_structure
from .errors import ComplexError, MissingExtraError, NotASiegelPointError
from .identification import identify
from .mesh import MeshReport
from .periods import PeriodMatrix, siegel_reduced
from .pipeline import period_matrix
from .serialization import SCHEMA, result_to_json
from .siegel import SIEGEL_GENUS_LIMIT
from .stages import logger, stage
from .summary import LARGEST_PRINTED, summary

Result = tuple[PeriodMatrix, PeriodMatrix | None, NDArray[np.int64] | None]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit code."""
    options = _parser().parse_args(arguments)
    if sys.stderr.isatty() and not options.quiet:
        show_stages()
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
    except (OSError, MissingExtraError) as error:
        return _refused(str(error))
    except ValueError as error:
        message, mesh = str(error), getattr(options, "mesh", "")
        return _refused(message if mesh in message else f"{mesh}: {message}")


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
    add_surface_arguments(compute, several=True)
    add_period_arguments(compute)
    add_memory_argument(compute)
    compute.add_argument("--json", action="store_true", help="print one JSON document")
    reduction = compute.add_mutually_exclusive_group()
    reduction.add_argument(
        "--reduce",
        action="store_true",
        default=None,
        help="Siegel reduce the matrix, whatever its genus (default: up to genus "
        f"{SIEGEL_GENUS_LIMIT}, above which it takes a minute and more)",
    )
    reduction.add_argument(
        "--no-reduce",
        dest="reduce",
        action="store_false",
        help="leave the matrix in the marking of the mesh",
    )
    compute.set_defaults(run=_compute)
    add_demo_command(commands, compute)
    recognise = commands.add_parser(
        "identify",
        help="which named surfaces a mesh can be",
        description="Compare the period matrix of a mesh with those of named surfaces.",
    )
    add_surface_arguments(recognise, several=True)
    add_period_arguments(recognise)
    recognise.add_argument(
        "--mesh-error",
        type=float,
        metavar="D",
        help="how far the mesh may be from the surface that it samples (a Siegel distance)",
    )
    recognise.set_defaults(run=_identify)
    add_commands(commands)
    add_batch_command(commands)
    return parser


def _identify(options: argparse.Namespace) -> int:
    surfaces, report = read_surfaces(options)
    print(_in_words(options, report))
    for k, K in enumerate(surfaces):
        pm = period_matrix(K, **chosen_options(options))
        with stage("comparing"):
            found = identify(pm, tolerance=options.mesh_error)
        print(f"{_heading(k, len(surfaces))}\n{found}")
    return 0


def _compute(options: argparse.Namespace) -> int:
    surfaces, report = read_surfaces(options)
    chosen = chosen_options(options) | memory_limit(options)
    results = [reduced_as_wanted(period_matrix(K, **chosen), options.reduce) for K in surfaces]
    if options.json:
        # Large matrices are for programs: hundreds of megabytes if each entry has its own line.
        readable = all(pm.genus <= LARGEST_PRINTED for pm, *_ in results)
        print(json.dumps(_document(options, results, report), indent=1 if readable else None))
        return 0
    print(_in_words(options, report))
    for k, result in enumerate(results):
        print(f"{_heading(k, len(results))}\n{summary(*result)}")
    return 0


def reduced_as_wanted(pm: PeriodMatrix, wanted: bool | None) -> Result:
    """The matrix and its reduction, if that is wanted, or does not take too long.

    A matrix that cannot be reduced in double precision is not lost: a warning says so.
    """
    if wanted is None:
        wanted = pm.genus <= SIEGEL_GENUS_LIMIT
    if not wanted:
        return pm, None, None
    try:
        with stage("Siegel reduction"):
            return pm, *siegel_reduced(pm, max_genus=pm.genus)
    except (ComplexError, NotASiegelPointError) as error:
        warnings.warn(f"the matrix was not reduced: {error}", stacklevel=2)
        return pm, None, None


def _document(
    options: argparse.Namespace, results: list[Result], report: MeshReport | None
) -> dict[str, Any]:
    """One JSON document: the only surface itself, or with all components a list of them."""
    documents = [result_to_json(*result) for result in results]
    surfaces: dict[str, Any] = documents[0]
    if options.component == ALL:
        surfaces = {"components": documents}
    if options.double and options.component is None:
        surfaces["mesh_marking"]["real_structure"] = real_structure(results[0][0]).tolist()
    names = ("repair", "double", "component", "reduce")
    given = {name: getattr(options, name) for name in names}
    return {
        "schema": SCHEMA,
        "version": importlib.metadata.version("igl_periods"),
        **surfaces,
        "options": {**chosen_options(options), **given},
        "mesh": report.as_dict() if report else None,
    }


def _in_words(options: argparse.Namespace, report: MeshReport | None) -> str:
    words = str(report) if report else f"{options.mesh}: triangles, glued as told"
    return f"{words}\nits double" if options.double else words


def _heading(k: int, n: int) -> str:
    return f"\nComponent {k + 1} of {n}" if n > 1 else ""


def _refused(message: str) -> int:
    print(f"igl-periods: {message}", file=sys.stderr)
    return 1


def show_stages() -> None:
    """Show each stage on the terminal while it runs, and its time when it is done."""
    handler = logging.StreamHandler(sys.stderr)
    handler.terminator = ""
    handler.setFormatter(_StageFormatter())
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)


class _StageFormatter(logging.Formatter):
    """One line for each stage, written over while it runs."""

    def __init__(self) -> None:
        super().__init__()
        self._stage = ""

    def format(self, record: logging.LogRecord) -> str:
        # Back to the start of the line, and clear what is left of a longer one.
        line = "\r\x1b[K  "
        if hasattr(record, "progress"):
            return f"{line}{self._stage} … {record.getMessage()}"
        if not hasattr(record, "stage"):
            return f"{line}{record.getMessage()}\n"
        self._stage, seconds = record.stage, getattr(record, "seconds", None)
        if seconds is None:
            return f"{line}{self._stage} …"
        return f"{line}{self._stage:<20} {seconds:8.2f} s\n"


if __name__ == "__main__":
    sys.exit(main())
