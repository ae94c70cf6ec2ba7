"""The command ``identify``: which named surfaces a mesh can be."""

from __future__ import annotations

import argparse

from igl_periods.complexes import DeltaComplex
from igl_periods.enclosures import PeriodEnclosure, enclose, with_exact_distances
from igl_periods.periods import PeriodMatrix, period_matrix
from igl_periods.run_log import stage
from igl_periods.surfaces import identify

from .arguments import (
    Commands,
    add_period_arguments,
    add_surface_arguments,
    chosen_options,
    heading,
    mesh_in_words,
    read_surfaces,
)
from .terminal import say


def add_identify(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
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
    recognise.add_argument(
        "--digits",
        type=int,
        metavar="N",
        help="enclose the matrix in balls with so many proved digits, and compare in balls; "
        "--degree, --tolerance and their like play no part",
    )
    recognise.set_defaults(run=_identify)


def _identify(options: argparse.Namespace) -> int:
    surfaces, report = read_surfaces(options)
    say(mesh_in_words(options, report))
    for k, K in enumerate(surfaces):
        pm = _known(K, options)
        with stage("comparing"):
            found = identify(pm, tolerance=options.mesh_error)
        say(f"{heading(k, len(surfaces))}\n{found}")
    return 0


def _known(K: DeltaComplex, options: argparse.Namespace) -> PeriodMatrix | PeriodEnclosure:
    """The period matrix as it is to be known: with a certificate, or in balls."""
    if options.digits is None:
        return period_matrix(K, **chosen_options(options))
    return enclose(with_exact_distances(K), digits=options.digits)
