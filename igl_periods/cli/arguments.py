"""From the arguments of a command to the surface that it is about, and how to compute with it."""

from __future__ import annotations

import argparse
from typing import Any, TypeAlias

from igl_periods.complexes import DeltaComplex
from igl_periods.meshes import MeshReport, components_by_genus, read_surface, surface_of
from igl_periods.periods import as_complex
from igl_periods.run_log import stage

ALL = "all"

# What :meth:`argparse.ArgumentParser.add_subparsers` returns.
Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"


def add_surface_arguments(command: argparse.ArgumentParser, several: bool = False) -> None:
    """Add what every command needs to find its surface; ``several`` allows ``--component all``."""
    command.add_argument(
        "mesh",
        metavar="MESH",
        help="a mesh (OBJ, OFF, PLY, STL, …), or a gluing of triangles (.json)",
    )
    add_reading_arguments(command)
    command.add_argument(
        "--component",
        type=_component if several else int,
        metavar="K|all" if several else "K",
        help="of several components take the K-th, counted from 1, those of large genus first"
        + ("; or all" if several else ""),
    )


def add_reading_arguments(command: argparse.ArgumentParser) -> None:
    """Add what is done to every mesh before anything is computed."""
    command.add_argument(
        "--repair",
        action="store_true",
        help="weld, drop, orient and split what keeps the mesh from being a surface",
    )
    command.add_argument(
        "--double",
        action="store_true",
        help="take the double of a surface with boundary or without an orientation",
    )
    command.add_argument("--quiet", action="store_true", help="no progress on the terminal")


def add_period_arguments(command: argparse.ArgumentParser) -> None:
    """Add the options of :func:`~igl_periods.period_matrix`."""
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
        "--rigorous",
        action="store_true",
        help="prove the bound in ball arithmetic, roundings included",
    )


def add_memory_argument(command: argparse.ArgumentParser) -> None:
    """Add the limit of memory; :func:`memory_limit` reads it."""
    command.add_argument(
        "--max-memory",
        type=float,
        metavar="GB",
        help="refuse what would take more memory (default: what is available)",
    )


def memory_limit(options: argparse.Namespace) -> dict[str, float]:
    """The keyword of :func:`~igl_periods.period_matrix` for it, if it was given."""
    return {} if options.max_memory is None else {"max_memory": 1e9 * options.max_memory}


def chosen_options(options: argparse.Namespace) -> dict[str, Any]:
    """The keywords of :func:`~igl_periods.period_matrix` that decide about the result."""
    names = ("weights", "delaunay", "degree", "tolerance", "rigorous")
    return {name: getattr(options, name) for name in names}


def read_surfaces(options: argparse.Namespace) -> tuple[list[DeltaComplex], MeshReport | None]:
    """The surfaces that are meant, and the report of a mesh; a gluing (.json) has none."""
    with stage("reading the file"):
        surface, report = read_surface(options.mesh, options.repair)
    K = as_complex(*surface)
    if options.component == ALL:
        return components_by_genus(surface_of(K, options.double)), report
    return [surface_of(K, options.double, options.component)], report


def mesh_in_words(options: argparse.Namespace, report: MeshReport | None) -> str:
    """What was read, and what was made of it."""
    words = str(report) if report else f"{options.mesh}: triangles, glued as told"
    return f"{words}\nits double" if options.double else words


def heading(k: int, n: int) -> str:
    """What stands above the k-th of n surfaces."""
    return f"\nComponent {k + 1} of {n}" if n > 1 else ""


def _component(text: str) -> int | str:
    return ALL if text == ALL else int(text)
