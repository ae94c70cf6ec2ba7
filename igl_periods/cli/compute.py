"""The command ``compute``: the period matrix of a mesh, in words or as one JSON document."""

from __future__ import annotations

import argparse
import importlib.metadata
import json
from typing import Any

from igl_periods.arrays import Ints
from igl_periods.meshes import MeshReport
from igl_periods.periods import (
    PeriodMatrix,
    period_matrix,
    real_structure,
    reduced_if_feasible,
)
from igl_periods.reports import LARGEST_PRINTED, SCHEMA, result_to_json, summary
from igl_periods.run_log import stage
from igl_periods.siegel import SIEGEL_GENUS_LIMIT

from .arguments import (
    ALL,
    Commands,
    add_memory_argument,
    add_period_arguments,
    add_surface_arguments,
    chosen_options,
    heading,
    memory_limit,
    mesh_in_words,
    read_surfaces,
    repair_options,
)
from .terminal import say

# In the marking of the mesh; Siegel reduced, and by which γ, or None and None.
Result = tuple[PeriodMatrix, PeriodMatrix | None, Ints | None]


def add_compute(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
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


def _compute(options: argparse.Namespace) -> int:
    surfaces, report = read_surfaces(options)
    chosen = chosen_options(options) | memory_limit(options)
    results = [_reduced(period_matrix(K, **chosen), options.reduce) for K in surfaces]
    if options.json:
        # Large matrices are for programs: hundreds of megabytes if each entry has its own line.
        readable = all(pm.genus <= LARGEST_PRINTED for pm, *_ in results)
        say(json.dumps(_document(options, results, report), indent=1 if readable else None))
        return 0
    say(mesh_in_words(options, report))
    for k, result in enumerate(results):
        say(f"{heading(k, len(results))}\n{summary(*result)}")
    return 0


def _reduced(pm: PeriodMatrix, wanted: bool | None) -> Result:
    """The matrix and its reduction, if that is wanted, or does not take too long."""
    if wanted is False:
        return pm, None, None
    with stage("Siegel reduction"):
        return pm, *reduced_if_feasible(pm, max_genus=pm.genus if wanted else None)


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
    given = {name: getattr(options, name) for name in names} | repair_options(options)
    return {
        "schema": SCHEMA,
        "version": importlib.metadata.version("igl_periods"),
        **surfaces,
        "options": {**chosen_options(options), **given},
        "mesh": report.as_dict() if report else None,
    }
