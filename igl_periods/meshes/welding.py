"""Vertices that are one: equal rows, and vertices that nothing uses."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats, Ints


def first_equal_row(rows: NDArray[Any]) -> Ints:
    """For each row of a matrix the index of the first one equal to it; shape (n,)."""
    order = np.lexsort(rows.T)
    starts = np.ones(len(rows), dtype=bool)
    starts[1:] = (rows[order[1:]] != rows[order[:-1]]).any(axis=1)
    result = np.empty_like(order)
    # lexsort is stable, so that each group begins with the first of its rows.
    result[order] = order[starts][np.cumsum(starts) - 1]
    return result


def compressed(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """Drop the vertices that no face uses."""
    used, faces = np.unique(F, return_inverse=True)
    return V[used], faces.reshape(F.shape)
