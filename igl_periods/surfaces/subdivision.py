"""Division of every triangle of a gluing into n² triangles similar to it.

The corners of a triangle are the points (0, 0), (n, 0), (0, n) of the triangular lattice.  It is
filled by the upright triangles (i, j), (i + 1, j), (i, j + 1) and the inverted triangles
(i + 1, j + 1), (i, j + 1), (i + 1, j).  An inverted triangle is an upright one after half a turn,
so side s of the one is always glued to side s of the other.

The metric of the surface does not change, hence neither does its conformal structure: only the
functions that are linear on triangles grow finer.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import ComplexError


def subdivide(lengths: Floats, twin: Ints, n: int) -> tuple[Floats, Ints]:
    """Divide every triangle into n² triangles similar to it.

    Parameters
    ----------
    lengths : (m, 3) float
        Side lengths, side ``s`` opposite corner ``s``.
    twin : (m, 3) int
        ``twin[f, s] = 3 f' + s'`` glues side ``s`` of ``f`` to side ``s'`` of ``f'``, running in
        opposite directions.  No side is free.
    n : int

    Returns
    -------
    lengths : (n² m, 3) float
    twin : (n² m, 3) int
        The parts of triangle ``f`` are the triangles n² f, …, n² f + n² − 1.

    Raises
    ------
    ComplexError
        If ``n < 1``.
    """
    if n != int(n) or n < 1:
        raise ComplexError(f"n = {n}: each triangle is divided into n x n triangles, n >= 1.")
    inner, sides = _template(int(n))
    first = 3 * n * n * np.arange(len(twin))
    fine = (inner.ravel() + first[:, None]).ravel()
    parts = (sides + first[:, None, None]).reshape(-1, n)
    fine[parts] = parts[twin.ravel(), ::-1]
    return np.repeat(lengths / n, n * n, axis=0), fine.reshape(-1, 3)


def _template(n: int) -> tuple[Ints, Ints]:
    """The gluing inside one divided triangle, (n², 3), and the half-edges on its sides, (3, n)."""
    i, j = np.divmod(np.arange(n * n), n)
    is_upright, is_inverted = i + j < n, i + j < n - 1
    upright = np.full((n, n), -1, dtype=np.int64)
    upright[i[is_upright], j[is_upright]] = np.arange(np.count_nonzero(is_upright))
    i, j = i[is_inverted], j[is_inverted]
    inverted = upright.max() + 1 + np.arange(i.size)
    twin = np.zeros(3 * n * n, dtype=np.int64)
    for s, neighbour in enumerate((upright[i, j], upright[i + 1, j], upright[i, j + 1])):
        twin[3 * inverted + s], twin[3 * neighbour + s] = 3 * neighbour + s, 3 * inverted + s
    q = np.arange(n)
    along = np.stack([upright[n - 1 - q, q], upright[0, n - 1 - q], upright[q, 0]])
    return twin.reshape(-1, 3), 3 * along + np.arange(3)[:, None]
