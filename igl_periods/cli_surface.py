"""From the arguments of a command to the surface that it is about."""

from __future__ import annotations

import argparse
from pathlib import Path

from .delta_complex import DeltaComplex
from .mesh import MeshReport, load_mesh
from .pipeline import as_complex
from .serialization import read_gluing
from .stages import stage
from .surface_choice import components_by_genus, surface_of

ALL = "all"


def add_surface_arguments(command: argparse.ArgumentParser, several: bool = False) -> None:
    """Add what every command needs to find its surface; ``several`` allows ``--component all``."""
    command.add_argument(
        "mesh",
        metavar="MESH",
        help="a mesh (OBJ, OFF, PLY, STL, …), or a gluing of triangles (.json)",
    )
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
    command.add_argument(
        "--component",
        type=_component if several else int,
        metavar="K|all" if several else "K",
        help="of several components take the K-th, counted from 1, those of large genus first"
        + ("; or all" if several else ""),
    )
    command.add_argument("--quiet", action="store_true", help="no stage names on the terminal")


def read_surfaces(options: argparse.Namespace) -> tuple[list[DeltaComplex], MeshReport | None]:
    """The surfaces that are meant, and the report of a mesh; a gluing (.json) has none."""
    report = None
    with stage("reading the file"):
        if Path(options.mesh).suffix.lower() == ".json":
            K = read_gluing(options.mesh)
        else:
            V, F, report = load_mesh(options.mesh, repair=options.repair)
    if report is not None:
        K = as_complex(V, F)
    if options.component == ALL:
        return components_by_genus(surface_of(K, options.double)), report
    return [surface_of(K, options.double, options.component)], report


def _component(text: str) -> int | str:
    return ALL if text == ALL else int(text)
