"""Which surface is meant, and what its exact lengths are."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from igl_periods.complexes import DeltaComplex, ExactLengths, as_complex

from .exact_lengths import distances, lengths_of


def surface_and_lengths(
    surface: DeltaComplex | ArrayLike, F: ArrayLike | None
) -> tuple[DeltaComplex, ExactLengths]:
    """The complex of a surface, and the function that gives the lengths of its edges.

    Positions V are taken as they are: integers, fractions or doubles.  A mesh whose lengths had to
    be changed to make triangles of them is the surface with the changed lengths.
    """
    positions = _exact_positions(surface) if F is not None else None
    if positions is None:
        K = as_complex(surface, F)
        positions = K.positions if not isinstance(surface, DeltaComplex) else None
        if positions is None or K.mollification > 0.0:
            return K, lengths_of(K)
        return K, distances(_all_rows(positions, K), K)
    K = as_complex(positions.astype(np.float64), F)
    return K, lengths_of(K) if K.mollification > 0.0 else distances(positions, K)


def _exact_positions(V: Any) -> NDArray[Any] | None:
    """Positions that floating point would round: integers and fractions; otherwise None."""
    array = np.asarray(V)
    if array.dtype.kind in "iu":
        return array.astype(object)
    exact = array.dtype.kind == "O" and array.ndim == 2
    if exact and all(isinstance(x, int | float | Fraction) for x in array.ravel()):
        return array
    return None


def _all_rows(positions: NDArray[np.float64], K: DeltaComplex) -> NDArray[np.float64]:
    """Positions of the vertices, as rows that ``K.labels`` index."""
    rows = np.zeros((int(K.labels.max()) + 1, positions.shape[1]))
    rows[K.labels] = positions
    return rows
