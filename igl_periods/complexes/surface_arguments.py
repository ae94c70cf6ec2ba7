"""Surfaces as callers hand them over, as complexes.

Every public function of a surface takes the same: V and F, a Δ-complex, a pair (V, F), the path
of a file, a mesh object of another library.  :func:`as_complex` is the one way from there to a
complex; :func:`of_a_surface` puts it before a function of a complex.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from os import PathLike
from typing import Any, Concatenate, ParamSpec, Protocol, TypeAlias, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.errors import MeshError
from igl_periods.machine import require_memory
from igl_periods.run_log import stage

from .checked_arrays import checked_corners
from .delta_complex import DeltaComplex
from .mesh_readers import has_rows, is_array_like, vertices_and_faces

# Of the arrays of a complex, while its edges are flipped.
BYTES_A_FACE_FLIPPING = 400.0


class HasVertices(Protocol):
    """A mesh object as trimesh and others have it, with ``faces`` beside the vertices."""

    @property
    def vertices(self) -> Any:
        """Vertex positions."""


class HasPoints(Protocol):
    """A mesh object as PyVista and meshio have it, with ``faces`` or ``cells``."""

    @property
    def points(self) -> Any:
        """Vertex positions."""


SurfaceLike: TypeAlias = (
    "DeltaComplex | str | PathLike[str] | tuple[ArrayLike, ArrayLike] "
    "| tuple[ArrayLike, ArrayLike, object] | HasVertices | HasPoints"
)

P = ParamSpec("P")
T = TypeVar("T")
T_contra = TypeVar("T_contra", contravariant=True)
R_co = TypeVar("R_co", covariant=True)


def as_complex(surface: SurfaceLike | ArrayLike, F: ArrayLike | None = None) -> DeltaComplex:
    """The Δ-complex of whatever is called a surface.

    Parameters
    ----------
    surface : surface
        Vertex positions V (n, d), with F; or one object: a :class:`DeltaComplex`, which is
        returned; a pair ``(V, F)``, or what :func:`~igl_periods.load_mesh` returns; a path, read
        without repair; a mesh of trimesh, Open3D, PyVista or meshio, or any object with
        ``vertices`` and ``faces``.
    F : (m, 3) array-like of int, optional
        Corners of the triangles, with V.

    Raises
    ------
    MeshError
        If it is none of these, or no triangulated surface (:meth:`DeltaComplex.from_mesh`).
    ComplexError
        If a triangle is degenerate beyond what mollification mends.
    MemoryLimitError
        If there is no memory for so many faces.
    FileNotFoundError
        If it is the path of no file.
    """
    if isinstance(surface, DeltaComplex):
        if F is not None:
            raise MeshError("a DeltaComplex has its own faces: leave F out.")
        return surface
    mesh = vertices_and_faces(surface, F)
    if isinstance(mesh, DeltaComplex):
        return mesh
    with stage("surface"):
        V, F = mesh
        faces = checked_corners(F, None)
        require_memory(
            BYTES_A_FACE_FLIPPING * len(faces), f"a complex of {len(faces):,} faces takes", None
        )
        return DeltaComplex.from_mesh(V, faces)


class OfASurface(Protocol[T_contra, P, R_co]):
    """A function of a surface, which may be handed over as one argument or as V and F."""

    @overload
    def __call__(
        self, surface: SurfaceLike | T_contra, /, *args: P.args, **kwargs: P.kwargs
    ) -> R_co: ...
    @overload
    def __call__(
        self, V: ArrayLike, F: ArrayLike, /, *args: P.args, **kwargs: P.kwargs
    ) -> R_co: ...


def of_a_surface(
    function: Callable[Concatenate[DeltaComplex, P], R_co],
) -> OfASurface[DeltaComplex, P, R_co]:
    """Let a function of a complex take whatever :func:`as_complex` takes; a decorator.

    Where the first argument is an array, it is V, and the second one is F.
    """
    return of_a_surface_or(DeltaComplex)(function)


def of_a_surface_or(
    kind: type[T],
) -> Callable[[Callable[Concatenate[DeltaComplex | T, P], R_co]], OfASurface[T, P, R_co]]:
    """As :func:`of_a_surface`, for functions that also take objects of another kind."""

    def accepting_surfaces(
        function: Callable[Concatenate[DeltaComplex | T, P], R_co],
    ) -> OfASurface[T, P, R_co]:
        @wraps(function)
        def accepting(*args: Any, **kwargs: Any) -> R_co:
            if not args and "K" in kwargs:
                args = (kwargs.pop("K"),)
            if not args or (isinstance(args[0], kind) and kind is not DeltaComplex):
                return function(*args, **kwargs)
            surface, *others = args
            F = kwargs.pop("F", None)
            if F is None and others and (is_array_like(surface) or _are_rows(others[0])):
                F, *others = others
            return function(as_complex(surface, F), *others, **kwargs)

        return accepting

    return accepting_surfaces


def _are_rows(value: Any) -> bool:
    """Whether it can only be faces: dense and two-dimensional."""
    return isinstance(value, (np.ndarray, list, tuple)) and has_rows(value)
