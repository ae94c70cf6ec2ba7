"""What callers hand over as a mesh, as V and F: readers that know their objects.

A surface may be handed over as V and F, as a pair of them, or as anything that a *reader* knows:
the path of a file, a mesh object of another library.  Readers stand above this package, where
files are read and polygons divided; they register here, and are asked in turn.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from igl_periods.errors import MeshError

if TYPE_CHECKING:
    from .delta_complex import DeltaComplex

# V and F, or a complex where there are no positions; None for what the reader does not know.
Reader = Callable[[Any], "tuple[Any, Any] | DeltaComplex | None"]
_readers: list[Reader] = []


def mesh_reader(reader: Reader) -> Reader:
    """Register a reader, which is asked about whatever is not an array; a decorator."""
    _readers.append(reader)
    return reader


def is_array_like(value: Any) -> bool:
    """Whether it is rows of numbers and no surface by itself, as a pair (V, F) is."""
    if isinstance(value, (str, bytes, Mapping)) or _is_pair(value):
        return False
    return hasattr(value, "__array__") or (
        hasattr(value, "__len__") and hasattr(value, "__getitem__")
    )


def vertices_and_faces(surface: Any, F: Any = None) -> tuple[Any, Any] | DeltaComplex:
    """V and F of a mesh, neither of them checked, or the complex that a file holds.

    Parameters
    ----------
    surface : array-like, pair, or what a reader knows
        V with F beside it; (V, F), also with a third entry as :func:`~igl_periods.load_mesh`
        returns it; a path; a mesh object.
    F : array-like, optional

    Raises
    ------
    MeshError
        If faces are missing or there twice, or the object is not known to hold a mesh.
    """
    if is_array_like(surface):
        if F is None:
            raise MeshError(_without_faces(surface))
        return surface, F
    if F is not None:
        raise MeshError(
            f"{described(surface)} has faces of its own, or is not a surface: leave F out."
        )
    if _is_pair(surface):
        return surface[0], surface[1]
    for reader in _readers:
        mesh = reader(surface)
        if mesh is not None:
            return mesh
    raise MeshError(
        f"{described(surface)} is not a surface. Hand over V and F, a DeltaComplex, the path of a "
        "mesh file, or a mesh of trimesh, Open3D, PyVista or meshio."
    )


def described(value: Any) -> str:
    """An object in words: its type, or itself if it is short."""
    shown = repr(value) if value is None or isinstance(value, (str, int, float)) else ""
    return shown if 0 < len(shown) < 60 else f"an object of type {type(value).__qualname__}"


def _is_pair(value: Any) -> bool:
    """Whether it is (V, F) or (V, F, report): two arrays of rows, where V alone has numbers."""
    return (
        isinstance(value, (tuple, list)) and len(value) in (2, 3) and all(map(has_rows, value[:2]))
    )


def has_rows(value: Any) -> bool:
    """Whether it is an array of two dimensions, or would be but for rows of different lengths."""
    try:
        return np.ndim(value) == 2
    except ValueError:
        return True


def _without_faces(surface: Any) -> str:
    if hasattr(surface, "complex"):
        return f"{described(surface)} is not a surface but belongs to one: hand over its .complex."
    return (
        f"faces are missing beside {described(surface)}: hand over V and F, (m, 3) integers, or "
        "one object that has both, such as a DeltaComplex."
    )
