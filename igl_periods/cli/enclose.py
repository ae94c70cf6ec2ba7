"""The command ``enclose``: a period matrix with as many proved digits as are asked for."""

from __future__ import annotations

import argparse
from typing import Any

from igl_periods.complexes import DeltaComplex
from igl_periods.enclosures import PeriodEnclosure, enclose, with_exact_distances
from igl_periods.meshes import MeshReport
from igl_periods.reports import enclosure_summary, lengths_in_words
from igl_periods.run_log import stage
from igl_periods.siegel import siegel_reduce

from .arguments import (
    ALL,
    Commands,
    add_json_argument,
    add_memory_argument,
    add_surface_arguments,
    heading,
    memory_limit,
    mesh_in_words,
    read_surfaces,
    reading_options,
)
from .each_mesh import Answer, answer_each

_DIGITS = 30


def add_enclose(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    command = commands.add_parser(
        "enclose",
        help="the period matrix of a mesh in ball arithmetic, with any number of proved digits",
        description="Enclose the period matrix of a closed, oriented, connected surface in balls: "
        "every digit that is printed is proved.",
    )
    add_surface_arguments(command, several=True)
    command.add_argument(
        "--digits",
        type=int,
        default=_DIGITS,
        metavar="N",
        help=f"decimal digits that are wanted ({_DIGITS})",
    )
    command.add_argument(
        "--max-seconds",
        type=float,
        metavar="S",
        help="begin nothing that would probably end later than this; the best proved result is "
        "printed",
    )
    add_memory_argument(command)
    add_json_argument(command)
    command.set_defaults(run=_enclose)


def _enclose(options: argparse.Namespace) -> int:
    return answer_each(options, _answer)


def _answer(options: argparse.Namespace) -> Answer:
    surfaces, report = read_surfaces(options)
    results = [_enclosed(K, options) for K in surfaces]
    if options.json:
        return _document(options, results, report)
    texts = [enclosure_summary(reduced_enclosure(result)[0], options.digits) for result in results]
    sections = [f"{heading(k, len(texts))}\n{text}" for k, text in enumerate(texts)]
    return "\n".join([mesh_in_words(options, report), *sections])


def _enclosed(K: DeltaComplex, options: argparse.Namespace) -> PeriodEnclosure:
    return enclose(
        with_exact_distances(K),
        digits=options.digits,
        max_seconds=options.max_seconds,
        max_memory=memory_limit(options),
    )


def reduced_enclosure(enclosed: PeriodEnclosure) -> tuple[PeriodEnclosure, list[list[int]]]:
    """The same surface Siegel reduced, and the γ that leads there."""
    with stage("Siegel reduction"):
        gamma = siegel_reduce(enclosed).gamma
        return enclosed.change_basis(gamma), gamma.tolist()


def _document(
    options: argparse.Namespace, results: list[PeriodEnclosure], report: MeshReport | None
) -> dict[str, Any]:
    """One JSON document: that of the only surface itself, or with all components a list of them."""
    documents = [_result_in_json(result) for result in results]
    given = {name: getattr(options, name) for name in ("digits", "max_seconds", "max_memory")}
    return {
        **({"components": documents} if options.component == ALL else documents[0]),
        "options": given | reading_options(options),
        "mesh": report.as_dict() if report else None,
    }


def _result_in_json(result: PeriodEnclosure) -> dict[str, Any]:
    """The document of the enclosure, its reduced matrix, and the surface in words."""
    reduced, gamma = reduced_enclosure(result)
    names = ("digits", "bound", "matrix")
    document = reduced.to_json()
    return {
        **result.to_json(),
        "reduced": {**{name: document[name] for name in names}, "gamma": gamma},
        "lengths": lengths_in_words(result.complex),
    }
