"""From the arguments of a command to the surface that it is about, and how to compute with it."""

from __future__ import annotations

import argparse
import warnings
from typing import Any, TypeAlias

from igl_periods.complexes import DeltaComplex, as_complex, check_surface
from igl_periods.errors import ComplexError, MeshError
from igl_periods.meshes import (
    WELD,
    MeshReport,
    components_by_genus,
    read_surface,
    surface_of,
    way_out,
)
from igl_periods.run_log import stage

ALL = "all"

# What :meth:`argparse.ArgumentParser.add_subparsers` returns.
Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"


def add_surface_arguments(command: argparse.ArgumentParser, several: bool = False) -> None:
    """Add what every command needs to find its surface; ``several`` allows ``--component all``."""
    command.add_argument(
        "mesh",
        metavar="MESH",
        help="a mesh (OBJ, OFF, PLY, STL, 3MF, glTF, …), or a gluing of triangles (.json)",
    )
    add_reading_arguments(command)
    add_repair_arguments(command)
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


def add_repair_arguments(command: argparse.ArgumentParser) -> None:
    """Add how far a repair goes; each of them implies it."""
    command.add_argument(
        "--weld",
        type=_part,
        metavar="R",
        help="repair, and weld boundary edges at most R apart, in parts of the diagonal "
        f"({WELD:g}); 0: only at exactly the same place",
    )
    command.add_argument(
        "--fill-holes",
        type=_size,
        metavar="SIZE",
        help="repair, and fill holes of at most SIZE edges",
    )


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
    """The surfaces that are meant, and the report of a mesh; a gluing (.json) has none.

    Raises
    ------
    ValueError
        If one of them is not closed, oriented and connected, with the way out and the report.
    """
    how = {"weld": options.weld, "largest_hole": options.fill_holes}
    chosen = {name: value for name, value in how.items() if value is not None}
    with stage("reading the file"):
        surface, report = read_surface(options.mesh, options.repair or bool(chosen), **chosen)
    try:
        K = as_complex(*surface)
        surfaces = _chosen_surfaces(K, options)
        for part in surfaces:
            check_surface(part)
    except (MeshError, ComplexError) as error:
        if report is None:
            raise
        raise type(error)(_explained(error, report)) from error
    if options.double and report and report.result.seam_edges:
        warnings.warn(f"the double of a torn surface: {way_out(report)}", stacklevel=2)
    return surfaces, report


def _explained(error: Exception, report: MeshReport) -> str:
    """What is wrong, the way out for this mesh, and what was found and done."""
    why, way = str(error), way_out(report)
    if way:
        # The first sentence says what is wrong, the others what it may be in any mesh.
        why = f"{why.partition('. ')[0].rstrip('.')}. {way}"
    return f"{why}\n{report}"


def _chosen_surfaces(K: DeltaComplex, options: argparse.Namespace) -> list[DeltaComplex]:
    if options.component == ALL:
        return components_by_genus(surface_of(K, options.double))
    return [surface_of(K, options.double, options.component)]


def mesh_in_words(options: argparse.Namespace, report: MeshReport | None) -> str:
    """What was read, and what was made of it."""
    words = str(report) if report else f"{options.mesh}: triangles, glued as told"
    return f"{words}\nits double" if options.double else words


def heading(k: int, n: int) -> str:
    """What stands above the k-th of n surfaces."""
    return f"\nComponent {k + 1} of {n}" if n > 1 else ""


def repair_options(options: argparse.Namespace) -> dict[str, float]:
    """How far the repair goes, as far as it was said."""
    given = {"weld": options.weld, "fill_holes": options.fill_holes}
    return {name: value for name, value in given.items() if value is not None}


def _part(text: str) -> float:
    value = float(text)
    if not 0.0 <= value < 0.01:
        raise argparse.ArgumentTypeError(f"a part of the diagonal from 0 to 0.01, not {text}")
    return value


def _size(text: str) -> int:
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"a number of edges, not {text}")
    return value


def _component(text: str) -> int | str:
    return ALL if text == ALL else int(text)
