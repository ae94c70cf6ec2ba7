"""``mpiexec -n N python -m igl_periods.distributed MESH``: parse, call, print once.

Exit codes: 0 the matrix was computed, 1 the mesh was refused or a rank failed, 2 wrong usage.
"""

from __future__ import annotations

import argparse
import json
import sys
import traceback
from collections.abc import Sequence
from typing import TYPE_CHECKING

from igl_periods.cli import Parser, add_surface_arguments, read_surfaces, refused, show_stages
from igl_periods.meshes import MeshReport
from igl_periods.periods import PeriodMatrix, reduced_if_feasible
from igl_periods.reports import document_to_json, result_to_json, summary

from .collective import on_root
from .libraries import load_petsc, world
from .pipeline import period_matrix

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command on every rank; returns the exit code."""
    try:
        comm = world()
        load_petsc()
    except ImportError as error:
        return refused(str(error))
    try:
        options = _parsed(comm, arguments)
        return options if isinstance(options, int) else _compute(comm, options)
    except Exception:
        # Of one rank alone, it may be: the others would wait for it.
        traceback.print_exc()
        sys.stderr.flush()
        comm.Abort(1)
        raise


def _parsed(comm: Intracomm, arguments: Sequence[str] | None) -> argparse.Namespace | int:
    """The options, or the exit code where there is nothing to compute; rank 0 says why."""
    options: argparse.Namespace | int = 0
    if comm.rank == 0:
        try:
            options = _parser().parse_args(arguments)
        except SystemExit as end:
            options = int(end.code or 0)
    return comm.bcast(options)


def _parser() -> Parser:
    parser = Parser(
        prog="python -m igl_periods.distributed",
        description="Compute the period matrix of one large mesh on all ranks of mpiexec.",
        epilog="Exit codes: 0 done, 1 the mesh was refused or a rank failed, 2 wrong usage.",
    )
    add_surface_arguments(parser)
    parser.add_argument(
        "--no-delaunay",
        dest="delaunay",
        action="store_false",
        help="keep the triangulation as it is (the bound is less sharp)",
    )
    parser.add_argument(
        "--rtol",
        type=float,
        default=1e-8,
        metavar="R",
        help="how far the residual of each solution falls (1e-8); the bound is true for any",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON document")
    return parser


def _compute(comm: Intracomm, options: argparse.Namespace) -> int:
    if comm.rank == 0 and sys.stderr.isatty() and not options.quiet:
        show_stages()
    try:
        surfaces, report = on_root(comm, lambda: read_surfaces(options)) or ([], None)
        surface = surfaces[0] if surfaces else None
        pm = period_matrix(surface, comm=comm, delaunay=options.delaunay, rtol=options.rtol)
    except (OSError, ValueError) as error:
        # These are everyone's.  mpiexec ends all ranks as soon as one fails: that has to wait.
        if comm.rank == 0:
            message = str(error)
            refused(message if options.mesh in message else f"{options.mesh}: {message}")
        comm.Barrier()
        return 1
    if pm is not None:
        print(_printed(options, pm, report), flush=True)
    return 0


def _printed(options: argparse.Namespace, pm: PeriodMatrix, report: MeshReport | None) -> str:
    result = (pm, *reduced_if_feasible(pm))
    if not options.json:
        return f"{report or options.mesh}\n{summary(*result)}"
    names = ("repair", "double", "component", "delaunay", "rtol")
    body = {
        **result_to_json(*result),
        "options": {name: getattr(options, name) for name in names},
        "mesh": report.as_dict() if report else None,
    }
    return json.dumps(document_to_json(options.mesh, body), indent=1)


if __name__ == "__main__":
    sys.exit(main())
