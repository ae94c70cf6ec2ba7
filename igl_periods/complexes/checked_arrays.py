"""Checks of the arrays that users hand over.

Each returns its argument as a contiguous array of float64 or int64, or raises an error that says
what is wrong with it, where first, and what to do.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from igl_periods.arrays import Floats, Ints
from igl_periods.display import counted
from igl_periods.errors import ComplexError, MeshError

_GLUED_TOLERANCE = 1e-9
_LARGEST_LENGTH = 1e60


def checked_positions(V: ArrayLike) -> Floats:
    """Vertex positions (n, d), finite, d ≥ 2, or MeshError."""
    array = checked_array(V, "V", MeshError)
    if array.ndim != 2 or array.shape[1] < 2:
        raise MeshError(f"V must have shape (n, d) with d >= 2, not {array.shape}.")
    if array.dtype.kind not in "iuf":
        raise MeshError(f"V must hold real numbers, not {array.dtype}.")
    return np.ascontiguousarray(array, dtype=np.float64)


def check_finite(positions: Floats, faces: Ints) -> None:
    """Raise MeshError unless the positions of all vertices of faces are finite."""
    if np.isfinite(positions).all():
        return
    wrong = np.intersect1d(np.flatnonzero(~np.isfinite(positions).all(axis=1)), faces)
    if wrong.size:
        raise MeshError(
            f"{counted(wrong.size, 'vertex has', 'vertices have')} coordinates that are NaN or "
            f"infinite; the first is vertex {wrong[0]}."
        )


def check_scale(lengths: Floats) -> None:
    """Raise ComplexError unless areas can be computed from the lengths without overflow."""
    l0, l1, l2 = lengths.T
    longest = np.maximum(np.maximum(l0, l1), l2)
    # Faces that are single points are degenerate, which is another error.
    longest = longest[longest > 0.0]
    if (
        longest.size
        and not 1.0 / _LARGEST_LENGTH < longest.min() <= longest.max() < _LARGEST_LENGTH
    ):
        raise ComplexError(
            f"the longest sides of triangles range from {longest.min():.3g} to "
            f"{longest.max():.3g}, outside of {1 / _LARGEST_LENGTH:g} to {_LARGEST_LENGTH:g}. "
            "Rescale the surface; the period matrix does not depend on scale."
        )


def checked_faces(F: ArrayLike, n_vertices: int | None) -> Ints:
    """Faces (m, 3), m ≥ 1, of three different vertices each, in range, or MeshError."""
    faces = checked_corners(F, n_vertices)
    a, b, c = faces.T
    repeated = (a == b) | (b == c) | (c == a)
    if repeated.any():
        f = int(np.argmax(repeated))
        raise MeshError(
            f"{np.count_nonzero(repeated)} faces repeat a vertex; the first is face {f}, "
            f"{faces[f].tolist()}. Remove such collapsed faces."
        )
    return faces


def checked_corners(F: ArrayLike, n_vertices: int | None) -> Ints:
    """Faces (m, 3), m ≥ 1, in range, vertices maybe repeated, or MeshError.  A copy of F."""
    array = checked_array(F, "F", MeshError)
    if array.size == 0:
        raise MeshError("the mesh is empty: it has no faces.")
    if array.ndim != 2 or array.shape[1] != 3:
        raise MeshError(
            f"F must have shape (m, 3), not {array.shape}. Polygons must be triangulated first."
        )
    if array.dtype.kind not in "iu":
        raise MeshError(f"F must be integer (rows of V), not {array.dtype}.")
    low, high = int(array.min()), int(array.max())
    if low < 0:
        raise MeshError(
            f"F has negative indices (the least is {low}); vertices are counted from 0."
        )
    if n_vertices is not None and high >= n_vertices:
        # Faces that are counted from 1 have no 0, and are out of range by one.
        question = " Are the faces counted from 1?" if low > 0 and high == n_vertices else ""
        raise MeshError(
            f"F refers to vertex {high}, out of range: V has {n_vertices} rows, counted from 0."
            f"{question}"
        )
    if high > np.iinfo(np.int64).max // 2:
        raise MeshError(f"F refers to vertex {high}, which is not a sensible index.")
    return np.array(array, dtype=np.int64, order="C")


def checked_lengths(lengths: ArrayLike, n_faces: int) -> Floats:
    """Side lengths (n_faces, 3), positive and finite, or ComplexError."""
    array = checked_array(lengths, "lengths", ComplexError)
    if array.shape != (n_faces, 3):
        raise ComplexError(
            f"lengths must have shape ({n_faces}, 3), one row a face, not {array.shape}."
        )
    if array.dtype.kind not in "iuf":
        raise ComplexError(f"lengths must hold real numbers, not {array.dtype}.")
    checked = array.astype(np.float64)
    wrong = ~(np.isfinite(checked) & (checked > 0.0)).all(axis=1)
    if wrong.any():
        f = int(np.argmax(wrong))
        raise ComplexError(
            f"{np.count_nonzero(wrong)} faces have a side length that is not positive and finite; "
            f"the first is face {f}, {checked[f].tolist()}."
        )
    return checked


def checked_array(values: ArrayLike, name: str, error: type[ValueError]) -> NDArray[Any]:
    """``numpy.asarray(values)``, or the error where that is impossible."""
    try:
        return np.asarray(values)
    except ValueError as ragged:
        raise error(
            f"{name} is not a rectangular array: its rows have different lengths."
        ) from ragged
    except (TypeError, RuntimeError) as refused:
        raise error(f"{name} cannot be made an array: {refused}") from refused


def check_equal_when_glued(values: Floats, twin: Ints, name: str) -> None:
    """Raise ComplexError unless values agree on glued sides, to 1e-9 relative; both (m, 3)."""
    other = np.where(twin >= 0, values.ravel()[twin], values)
    scale = np.maximum(np.abs(values), np.abs(other))
    excess = np.abs(values - other) - _GLUED_TOLERANCE * scale
    if excess.max() > 0.0:
        f, s = np.unravel_index(np.argmax(excess), excess.shape)
        raise ComplexError(
            f"glued sides have different {name}: {values[f, s]:.12g} at side {s} of face {f}, "
            f"{other[f, s]:.12g} at the side glued to it; they may differ by "
            f"{_GLUED_TOLERANCE:g} (relative). Is the order of sides right (side s lies opposite "
            "corner s)?"
        )
