"""From a file to the surface that is meant: its mesh or gluing, the double, a component."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

from igl_periods.complexes import DeltaComplex, double, mesh_reader
from igl_periods.errors import ComplexError

from .formats.read import EXTENSIONS, extension_of
from .gluing_file import read_gluing
from .load import load_mesh
from .report import MeshReport
from .seams import WELD

_GLUING = ".json"
# Extensions of the files that hold surfaces.
SURFACE_EXTENSIONS = (*EXTENSIONS, _GLUING)


def is_surface_file(name: str) -> bool:
    """Whether a file of this name holds a surface, compressed or not."""
    return Path(name).suffix.lower() == _GLUING or extension_of(name) in EXTENSIONS


def read_surface(
    path: str | PathLike[str],
    repair: bool = False,
    *,
    weld: float = WELD,
    largest_hole: int = 0,
) -> tuple[tuple[Any, ...], MeshReport | None]:
    """Read a mesh, or a gluing of triangles (.json).

    Parameters
    ----------
    path : path-like
    repair, weld, largest_hole
        As in :func:`load_mesh`; a gluing is never repaired.

    Returns
    -------
    surface : tuple
        ``(V, F)`` or ``(K,)``: the arguments of :func:`~igl_periods.complexes.as_complex`.
    report : MeshReport or None
        None for a gluing.

    Raises
    ------
    FileNotFoundError, MeshError, ComplexError
        As :func:`load_mesh` and :func:`~igl_periods.meshes.gluing_file.read_gluing`.
    """
    if Path(path).suffix.lower() == _GLUING:
        return (read_gluing(path),), None
    V, F, report = load_mesh(path, repair=repair, weld=weld, largest_hole=largest_hole)
    return (V, F), report


@mesh_reader
def surface_at_path(path: Any) -> tuple[Any, Any] | DeltaComplex | None:
    """V and F, or the complex, of the file at a path; None of what is not a path."""
    if not isinstance(path, (str, PathLike)):
        return None
    surface, _ = read_surface(path)
    return surface[0] if len(surface) == 1 else (surface[0], surface[1])


def surface_of(
    K: DeltaComplex, doubled: bool = False, component: int | None = None
) -> DeltaComplex:
    """The double or the complex itself, all of it or one component.

    Parameters
    ----------
    K : DeltaComplex
    doubled : bool
    component : int, optional
        Counted from 1, in the order of :func:`components_by_genus`.

    Raises
    ------
    ComplexError
        If there is no such component.
    """
    surface = double(K) if doubled else K
    if component is None:
        return surface
    parts = components_by_genus(surface)
    if not 1 <= component <= len(parts):
        there = "there is only one" if len(parts) == 1 else f"there are {len(parts)}"
        raise ComplexError(f"there is no component {component}: {there}.")
    return parts[component - 1]


def components_by_genus(K: DeltaComplex) -> list[DeltaComplex]:
    """The connected components: closed ones first, of these those of large genus, of many faces."""

    def rank(part: DeltaComplex) -> tuple[bool, int, int]:
        return part.n_boundary_edges > 0, part.euler_characteristic, -part.n_faces

    return sorted(K.components(), key=rank)
