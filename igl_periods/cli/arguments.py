"""From the arguments of a command to the surface that it is about, and how to compute with it."""

from __future__ import annotations

import argparse
import math
import warnings
from pathlib import Path
from typing import Any, TypeAlias

from igl_periods.complexes import DeltaComplex, as_complex, check_surface
from igl_periods.errors import ComplexError, MeshError
from igl_periods.machine import check_output
from igl_periods.meshes import (
    WELD,
    MeshReport,
    components_by_genus,
    read_surface,
    surface_of,
    way_out,
)
from igl_periods.periods import PeriodMatrix, checked_options, period_matrix
from igl_periods.run_log import stage

from .parser import Parser, refuse_without_effect

ALL = "all"
# The options of :func:`~igl_periods.load_mesh`, and those of :func:`~igl_periods.period_matrix`.
REPAIR_OPTIONS = ("repair", "weld", "fill_holes")
PERIOD_OPTIONS = ("weights", "delaunay", "degree", "tolerance", "rigorous")

# What :meth:`argparse.ArgumentParser.add_subparsers` returns.
Commands: TypeAlias = "argparse._SubParsersAction[Parser]"


def add_surface_arguments(command: Parser, several: bool = False) -> None:
    """Add what every command needs to find its surface; ``several`` allows more of everything.

    With ``several`` there are ``meshes``, at least one, and ``--component all``; otherwise one
    ``mesh``.
    """
    command.add_argument(
        "meshes" if several else "mesh",
        nargs="+" if several else None,
        metavar="MESH",
        help="a mesh (OBJ, OFF, PLY, STL, 3MF, glTF, …), or a gluing of triangles (.json)",
    )
    add_reading_arguments(command)
    add_double_argument(command)
    add_lattice_argument(command)
    command.add_argument(
        "--component",
        type=_component if several else int,
        metavar="K|all" if several else "K",
        help="of several components take the K-th, counted from 1, those of large genus first"
        + ("; or all" if several else ""),
    )


def add_reading_arguments(command: Parser) -> None:
    """Add how a mesh is read and repaired; how far a repair goes implies it."""
    command.checks.append(_check_repair)
    command.add_argument(
        "--repair",
        action="store_true",
        help="weld, drop, orient and split what keeps the mesh from being a surface",
    )
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
    command.add_argument("--quiet", action="store_true", help="no progress on the terminal")


def add_double_argument(command: Parser) -> None:
    """Add the double of what was read."""
    command.add_argument(
        "--double",
        action="store_true",
        help="take the double of a surface with boundary or without an orientation",
    )


def add_lattice_argument(command: Parser) -> None:
    """Add the translations by which a cell is glued; :func:`read_complex` does that."""
    command.add_argument(
        "--lattice",
        type=_translations,
        metavar="X,Y,Z;…",
        help="the mesh is a cell of a periodic surface: glue its boundary by one to three "
        "translations, as in '1,0,0;0,1,0'",
    )


def add_period_arguments(command: Parser) -> None:
    """Add the options of :func:`~igl_periods.period_matrix`; :func:`computed` reads them."""
    command.checks.append(_check_period_options)
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


def add_memory_argument(command: Parser) -> None:
    """Add the limit of memory, which :func:`computed` observes."""
    command.add_argument(
        "--max-memory",
        type=_gigabytes,
        metavar="GB",
        help="refuse what would take more memory (default: what is available)",
    )


def add_json_argument(command: Parser) -> None:
    """Add the choice between words and documents."""
    command.add_argument(
        "--json",
        action="store_true",
        help="print a JSON document for each mesh, on one line if there are several",
    )


def add_output_argument(command: Parser, what: str, *suffixes: str, required: bool = True) -> None:
    """Add the file that a command writes: its name is checked here, its place in :func:`claim`."""
    known = " or ".join(suffixes)

    def output(text: str) -> str:
        if Path(text).suffix.lower() not in suffixes:
            raise argparse.ArgumentTypeError(f"{what} has a name in {known}, not {text!r}")
        return text

    command.add_argument(
        "-o",
        "--output",
        required=required,
        type=output,
        metavar="FILE",
        help=f"{what} ({known})",
    )


def chosen_options(options: argparse.Namespace) -> dict[str, Any]:
    """The keywords of :func:`~igl_periods.period_matrix` that decide about the result."""
    return {name: getattr(options, name) for name in PERIOD_OPTIONS}


def reading_options(options: argparse.Namespace) -> dict[str, Any]:
    """What decides about the surface that is meant, as far as it was said."""
    given = {name: getattr(options, name) for name in ("repair", "double", "component")}
    how_far = {name: getattr(options, name) for name in ("weld", "fill_holes", "lattice")}
    return given | {name: value for name, value in how_far.items() if value is not None}


def computed(K: DeltaComplex, options: argparse.Namespace) -> PeriodMatrix:
    """The period matrix of a surface as it was asked for."""
    return period_matrix(K, **chosen_options(options), max_memory=memory_limit(options))


def memory_limit(options: argparse.Namespace) -> float | None:
    """The limit of memory in bytes; None if nothing was said."""
    return None if options.max_memory is None else 1e9 * options.max_memory


def repair_options(options: argparse.Namespace) -> dict[str, Any]:
    """The keywords of :func:`~igl_periods.load_mesh`: how far a repair goes implies it."""
    how = {"weld": options.weld, "largest_hole": options.fill_holes}
    chosen = {name: value for name, value in how.items() if value is not None}
    return {"repair": options.repair or bool(chosen), **chosen}


def _check_period_options(command: Parser, options: argparse.Namespace) -> None:
    checked_options(options.weights, options.degree, options.tolerance, options.rigorous)
    if options.weights == "extrinsic":
        why = "with extrinsic weights, which are those of the triangulation as it is"
        refuse_without_effect(command, options, ("delaunay",), why)


def _check_repair(command: Parser, options: argparse.Namespace) -> None:
    meshes = options.meshes if "meshes" in options else [options.mesh]
    if all(Path(mesh).suffix.lower() == ".json" for mesh in meshes):
        why = "on gluings of triangles (.json), which are taken as they are"
        refuse_without_effect(command, options, REPAIR_OPTIONS, why)


def read_surfaces(options: argparse.Namespace) -> tuple[list[DeltaComplex], MeshReport | None]:
    """The surfaces that are meant, and the report of a mesh; a gluing (.json) has none.

    Raises
    ------
    ValueError
        If one of them is not closed, oriented and connected, with the way out and the report.
    """
    K, report = read_complex(options)
    try:
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


def read_complex(options: argparse.Namespace) -> tuple[DeltaComplex, MeshReport | None]:
    """What a file holds, with its cells glued, and the report of a mesh; it may have a boundary.

    Raises
    ------
    ValueError
        If it is no surface, with the way out and the report.
    """
    with stage("reading the file"):
        surface, report = read_surface(options.mesh, **repair_options(options))
    try:
        if options.lattice is not None:
            return DeltaComplex.from_mesh(*surface, lattice=options.lattice), report
        return as_complex(*surface), report
    except (MeshError, ComplexError) as error:
        if report is None:
            raise
        raise type(error)(_explained(error, report)) from error


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


def claim(options: argparse.Namespace, *beside: str) -> None:
    """Refuse an output that cannot be written, before anything is read or computed.

    ``beside`` are suffixes of files that will be written beside it.
    """
    for path in (Path(options.output), *map(Path(options.output).with_suffix, beside)):
        check_output(path, options.mesh)


def _part(text: str) -> float:
    value = float(text)
    if not 0.0 <= value < 0.01:
        raise argparse.ArgumentTypeError(f"a part of the diagonal from 0 to 0.01, not {text}")
    return value


def _translations(text: str) -> list[list[float]]:
    try:
        return [[float(x) for x in row.split(",")] for row in text.split(";")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(
            f"translations as in '1,0,0;0,1,0', not {text!r}"
        ) from error


def _size(text: str) -> int:
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"a number of edges, not {text}")
    return value


def _gigabytes(text: str) -> float:
    value = float(text)
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"a number of gigabytes above 0, not {text}")
    return value


def _component(text: str) -> int | str:
    return ALL if text == ALL else int(text)
