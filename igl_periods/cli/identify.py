"""The command ``identify``: which named surfaces a mesh can be."""

from __future__ import annotations

import argparse
import logging
from typing import Any

from igl_periods.complexes import DeltaComplex
from igl_periods.curves import AlgebraicCurve, curve
from igl_periods.enclosures import PeriodEnclosure, enclose, with_exact_distances
from igl_periods.errors import CurveError
from igl_periods.periods import PeriodMatrix
from igl_periods.reports import curve_to_json, identification_to_json, invariant_lines
from igl_periods.run_log import stage
from igl_periods.surfaces import Identification, identify

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


def add_identify(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    recognise = commands.add_parser(
        "identify",
        help="which named surfaces a mesh can be",
        description="Compare the period matrix of a mesh with those of named surfaces.",
    )
    add_surface_arguments(recognise, several=True)
    add_period_arguments(recognise)
    add_memory_argument(recognise)
    add_json_argument(recognise)
    recognise.add_argument(
        "--mesh-error",
        type=float,
        metavar="D",
        help="how far the mesh may be from the surface that it samples (a Siegel distance)",
    )
    recognise.add_argument(
        "--digits",
        type=int,
        metavar="N",
        help="enclose the matrix in balls with so many proved digits, compare in balls, and name "
        "what the invariants are recognised as; "
        "--degree, --tolerance and their like play no part",
    )
    recognise.set_defaults(run=_identify)


def _identify(options: argparse.Namespace) -> int:
    return answer_each(options, _answer)


def _answer(options: argparse.Namespace) -> Answer:
    surfaces, report = read_surfaces(options)
    found = [_identified(K, options) for K in surfaces]
    curves = [_curve(pm, options) for pm, _ in found]
    if not options.json:
        sections = [
            f"{heading(k, len(found))}\n{names}{_in_words(c)}"
            for k, ((_, names), c) in enumerate(zip(found, curves, strict=True))
        ]
        return "\n".join([mesh_in_words(options, report), *sections])
    documents = [
        identification_to_json(*pair) | ({} if c is None else {"curve": curve_to_json(c)})
        for pair, c in zip(found, curves, strict=True)
    ]
    body: dict[str, Any] = documents[0]
    if options.component == ALL:
        body = {"components": documents}
    given = reading_options(options) | {"mesh_error": options.mesh_error}
    mesh = report.as_dict() if report else None
    return {**body, "options": chosen_options(options) | given, "mesh": mesh}


def _identified(
    K: DeltaComplex, options: argparse.Namespace
) -> tuple[PeriodMatrix | PeriodEnclosure, Identification]:
    pm = _known(K, options)
    with stage("comparing"):
        return pm, identify(pm, tolerance=options.mesh_error)


def _curve(
    pm: PeriodMatrix | PeriodEnclosure, options: argparse.Namespace
) -> AlgebraicCurve | None:
    """What the invariants say, where enough digits are known to recognise them."""
    if options.digits is None or pm.genus == 0:
        return None
    try:
        return curve(pm)
    except CurveError as error:
        logging.getLogger(__name__).info("no curve: %s", error)
        return None


def _in_words(found: AlgebraicCurve | None) -> str:
    if found is None:
        return ""
    lines = [f"as a curve: {found.equation}"]
    if found.coefficients and not found.is_recognised:
        lines = ["as a curve: its coefficients are not recognised"]
    lines += invariant_lines(found) if found.invariants else list(found.remarks)
    return "\n" + "\n".join(lines)


def _known(K: DeltaComplex, options: argparse.Namespace) -> PeriodMatrix | PeriodEnclosure:
    """The period matrix as it is to be known: with a certificate, or in balls."""
    if options.digits is None:
        return computed(K, options)
    return enclose(with_exact_distances(K), digits=options.digits)
