"""The command ``compute``: the period matrix of a mesh, in words or as one JSON document."""

from __future__ import annotations

import argparse
from typing import Any

from igl_periods.arrays import Ints
from igl_periods.meshes import MeshReport
from igl_periods.periods import PeriodMatrix, real_structure, reduced_if_feasible
from igl_periods.reports import result_to_json, summary
from igl_periods.run_log import stage
from igl_periods.siegel import SIEGEL_GENUS_LIMIT

from .arguments import (
    ALL,
    Commands,
    add_json_argument,
    add_memory_argument,
    add_period_arguments,
    add_surface_arguments,
    chosen_options,
    computed,
    heading,
    mesh_in_words,
    read_surfaces,
    reading_options,
)
from .each_mesh import Answer, answer_each

# In the marking of the mesh; Siegel reduced, and by which γ, or None and None.
Result = tuple[PeriodMatrix, PeriodMatrix | None, Ints | None]


def add_compute(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    compute = commands.add_parser(
        "compute",
        help="the period matrix of a mesh, or of several",
        description="Compute the period matrix of a closed, oriented, connected triangle mesh, or "
        "of several such meshes, one after the other.",
        epilog="Exit codes: 0 done, 1 one of the meshes was refused, the others computed, 2 wrong "
        "usage, 130 interrupted.",
    )
    add_surface_arguments(compute, several=True)
    add_period_arguments(compute)
    add_memory_argument(compute)
    add_json_argument(compute)
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
    return answer_each(options, _answer)


def _answer(options: argparse.Namespace) -> Answer:
    surfaces, report = read_surfaces(options)
    results = [_reduced(computed(K, options), options.reduce) for K in surfaces]
    if options.json:
        return _document(options, results, report)
    sections = [f"{heading(k, len(results))}\n{summary(*r)}" for k, r in enumerate(results)]
    return "\n".join([mesh_in_words(options, report), *sections])


def _reduced(pm: PeriodMatrix, wanted: bool | None) -> Result:
    """The matrix and its reduction, if that is wanted, or does not take too long."""
    if wanted is False:
        return pm, None, None
    with stage("Siegel reduction"):
        return pm, *reduced_if_feasible(pm, max_genus=pm.genus if wanted else None)


def _document(
    options: argparse.Namespace, results: list[Result], report: MeshReport | None
) -> dict[str, Any]:
    """The only surface itself, or with all components a list of them, and how it was made."""
    documents = [result_to_json(*result) for result in results]
    surfaces: dict[str, Any] = documents[0]
    if options.component == ALL:
        surfaces = {"components": documents}
    if options.double and options.component is None:
        surfaces["mesh_marking"]["real_structure"] = real_structure(results[0][0]).tolist()
    given = reading_options(options) | {"reduce": options.reduce}
    return {
        **surfaces,
        "options": chosen_options(options) | given,
        "mesh": report.as_dict() if report else None,
    }
