"""The command ``capacity``: capacities of the boundary loops of a mesh or of a plane domain."""

from __future__ import annotations

import argparse
import importlib.metadata
import json
from typing import Any

from igl_periods.complexes import DeltaComplex
from igl_periods.domains import CapacityMatrix, capacity_matrix, is_domain_file, read_domain
from igl_periods.surfaces import planar_domain

from .arguments import (
    REPAIR_OPTIONS,
    Commands,
    add_lattice_argument,
    add_reading_arguments,
    read_complex,
)
from .domain_pictures import add_domain_picture_arguments, claim_picture, draw_domain
from .parser import Parser, refuse_without_effect
from .terminal import say

_TOLERANCE = 1e-6


def add_capacity(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    command = commands.add_parser(
        "capacity",
        help="capacities of the boundary loops of a mesh, or of a polygon with holes",
        description="Compute the capacity matrix of the boundary loops of a surface, between two "
        "proved bounds.",
    )
    command.add_argument(
        "mesh",
        metavar="MESH",
        help="a mesh with a boundary, or a polygon with holes (.geojson, .svg)",
    )
    add_reading_arguments(command)
    add_lattice_argument(command)
    command.add_argument(
        "--tolerance",
        type=float,
        default=_TOLERANCE,
        metavar="R",
        help=f"raise the degree until the relative bound is at most R ({_TOLERANCE:g})",
    )
    command.add_argument("--json", action="store_true", help="print one JSON document")
    add_domain_picture_arguments(command)
    command.checks.append(_check_domain)
    command.set_defaults(run=_capacity)


def _capacity(options: argparse.Namespace) -> int:
    claim_picture(options)
    K = _surface(options)
    C = capacity_matrix(K, tolerance=options.tolerance)
    if options.json:
        say(json.dumps(_document(C), indent=1))
    else:
        say(repr(C))
        for k, loop in enumerate(C.loops):
            say(f"loop {k + 1}: {loop!r}, length {loop.length:.6g}")
    if options.picture is not None:
        drawn = draw_domain(K, options)
        if not options.json:
            say(drawn)
    return 0


def _check_domain(command: Parser, options: argparse.Namespace) -> None:
    if is_domain_file(options.mesh):
        why = "on polygons (.geojson, .svg), which are taken as they are"
        refuse_without_effect(command, options, (*REPAIR_OPTIONS, "lattice"), why)


def _surface(options: argparse.Namespace) -> DeltaComplex:
    if is_domain_file(options.mesh):
        return DeltaComplex.from_mesh(*planar_domain(*read_domain(options.mesh)))
    return read_complex(options)[0]


def _document(C: CapacityMatrix) -> dict[str, Any]:
    low, high = C.entry_bounds
    return {
        "schema": 1,
        "kind": "capacity matrix",
        "version": importlib.metadata.version("igl_periods"),
        "matrix": C.matrix.tolist(),
        "lower": low.tolist(),
        "upper": high.tolist(),
        "loewner": {"lower": C.bounds.lower.tolist(), "upper": C.bounds.upper.tolist()},
        "resistances": C.resistances.tolist(),
        "bound": C.period_matrix.bound,
        "loops": [
            {
                "vertices": C.complex.labels[loop.vertices].tolist(),
                "length": loop.length,
                "point": None if loop.point is None else loop.point.tolist(),
            }
            for loop in C.loops
        ],
    }
