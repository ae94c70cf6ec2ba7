"""The command ``curve``: the equation of the algebraic curve that a surface is."""

from __future__ import annotations

import argparse
import textwrap
from typing import Any

from igl_periods.complexes import DeltaComplex
from igl_periods.curves import AlgebraicCurve, curve, to_latex, to_magma, to_pari, to_sage
from igl_periods.enclosures import enclose, with_exact_distances
from igl_periods.reports import curve_summary, curve_to_json, lengths_in_words

from .arguments import (
    ALL,
    Commands,
    add_json_argument,
    add_memory_argument,
    add_surface_arguments,
    heading,
    mesh_in_words,
    read_surfaces,
    reading_options,
)
from .each_mesh import Answer, answer_each

_WIDTH = 92
_DIGITS = 50
_DEGREE = 6
_SYSTEMS = {"latex": to_latex, "sage": to_sage, "magma": to_magma, "pari": to_pari}


def add_curve(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    command = commands.add_parser(
        "curve",
        help="the equation of the algebraic curve that a surface is",
        description="Enclose the period matrix in balls, and find the algebraic curve: invariants "
        "with proved digits, and an equation whose coefficients are recognised, which is no "
        "proof. More than 15 digits make sense where lengths are exact.",
    )
    add_surface_arguments(command, several=True)
    command.add_argument(
        "--digits",
        type=int,
        default=_DIGITS,
        metavar="N",
        help=f"decimal digits of the period matrix ({_DIGITS})",
    )
    command.add_argument(
        "--degree",
        type=int,
        default=_DEGREE,
        metavar="D",
        help=f"largest degree of algebraic numbers that are tried ({_DEGREE})",
    )
    command.add_argument(
        "--format",
        choices=["text", *_SYSTEMS],
        default="text",
        help="the equation alone, for another system",
    )
    add_memory_argument(command)
    add_json_argument(command)
    command.set_defaults(run=_curve)


def _curve(options: argparse.Namespace) -> int:
    return answer_each(options, _answer)


def _answer(options: argparse.Namespace) -> Answer:
    surfaces, report = read_surfaces(options)
    found = [_of_surface(K, options) for K in surfaces]
    if options.json:
        pairs = zip(surfaces, found, strict=True)
        documents = [{"curve": curve_to_json(c), "lengths": lengths_in_words(K)} for K, c in pairs]
        body: dict[str, Any] = (
            {"components": documents} if options.component == ALL else documents[0]
        )
        given = {name: getattr(options, name) for name in ("digits", "degree", "max_memory")}
        mesh = report.as_dict() if report else None
        return {**body, "options": given | reading_options(options), "mesh": mesh}
    if options.format != "text":
        return "\n".join(_SYSTEMS[options.format](c).rstrip("\n") for c in found)
    sections = [
        f"{heading(k, len(found))}\n{curve_summary(c)}\n\n{_wrapped(lengths_in_words(K))}"
        for k, (K, c) in enumerate(zip(surfaces, found, strict=True))
    ]
    return "\n".join([mesh_in_words(options, report), *sections])


def _wrapped(text: str) -> str:
    return textwrap.fill(text, _WIDTH)


def _of_surface(K: DeltaComplex, options: argparse.Namespace) -> AlgebraicCurve:
    enclosed = enclose(
        with_exact_distances(K), digits=options.digits, max_memory=options.max_memory
    )
    return curve(enclosed, degree=options.degree)
