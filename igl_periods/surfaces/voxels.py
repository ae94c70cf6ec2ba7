r"""The boundary of a union of cubes of the cubic grid.

A square of the grid belongs to the boundary iff one of the two cells at it is filled and the other
is empty.  The boundary is a surface iff it is one at every corner of the grid: the filled cells
among the eight at the corner are connected through squares, and so are the empty ones.  Then they
are two discs on a small sphere round the corner, and the surface meets the sphere in the circle
between them.  (Two filled cells that share an edge and no neighbour at it separate the empty cells
on that sphere, so pinched edges are found at their ends.)

Every square is divided along the diagonal from its lowest to its highest corner.  Those are the
diagonals of Kuhn's division of the grid into tetrahedra, so vertices may be moved: a displacement
u that is linear on the tetrahedra and less than 1/6 in every coordinate changes by less than 1/3
along every side of a cell, is a contraction in the maximum norm, and id + u is injective.

The weights are those of the square lattice (1 on sides, 0 on diagonals) until vertices are moved.

References
----------
Kuhn, "Some combinatorial lemmas in topology" (1960), for the division into tetrahedra.
"""

from __future__ import annotations

import itertools
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.errors import MeshError

_LARGEST_JITTER = 1 / 6


def voxel_surface(filled: ArrayLike, *, jitter: float = 0.0, seed: int = 0) -> tuple[Floats, Ints]:
    """Triangulate the boundary of a union of unit cubes, normals outward.

    Parameters
    ----------
    filled : (a, b, c) array-like of bool
        Cell ``(i, j, k)`` is the cube [i, i + 1] × [j, j + 1] × [k, k + 1].
    jitter : float
        Every coordinate of every vertex is moved by a random amount of at most this.  Below 1/6,
        as is required, the surface stays embedded.
    seed : int
        Of the random amounts.

    Returns
    -------
    V : (n, 3) float
        Integers if ``jitter`` is 0.
    F : (m, 3) int
        Two triangles for each square of the boundary.

    Raises
    ------
    MeshError
        If no cell is filled, the boundary is pinched at an edge or a vertex, or ``jitter`` is out
        of range.

    Examples
    --------
    >>> V, F = voxel_surface([[[True]]])
    >>> V.shape, F.shape
    ((8, 3), (12, 3))
    """
    cells = np.asarray(filled, dtype=bool)
    if cells.ndim != 3 or not cells.any():
        raise MeshError(f"filled has shape {cells.shape}: some cells of (a, b, c) must be True.")
    if not 0 <= jitter < _LARGEST_JITTER:
        raise MeshError(f"jitter = {jitter}: the surface stays embedded for 0 <= jitter < 1/6.")
    padded = np.pad(cells, 1)
    _check_corners(padded)
    lattice = tuple(n + 1 for n in cells.shape)
    used, F = np.unique(_triangles(padded, lattice), return_inverse=True)
    V = np.column_stack(np.unravel_index(used, lattice)).astype(np.float64)
    moved = V + jitter * np.random.default_rng(seed).uniform(-1, 1, V.shape)
    return moved, F.reshape(-1, 3)


def _triangles(padded: Bools, lattice: tuple[int, ...]) -> Ints:
    """Both triangles of every square between a filled and an empty cell; (m, 3) grid corners."""
    stride = np.array([lattice[1] * lattice[2], lattice[2], 1])
    triangles = []
    for axis in range(3):
        # The square below cell (i, j, k) along the axis has the lowest corner (i, j, k).
        inside = np.diff(padded.astype(np.int8), axis=axis)
        inside = inside[tuple(slice(0 if d == axis else 1, None) for d in range(3))]
        one, two = stride[axis - 2], stride[axis - 1]
        for step, (first, second) in ((-1, (one, two)), (1, (two, one))):
            corner = np.argwhere(inside == step) @ stride
            across = corner + first + second
            triangles += [
                np.column_stack([corner, corner + first, across]),
                np.column_stack([corner, across, corner + second]),
            ]
    return np.concatenate(triangles)


def _check_corners(padded: Bools) -> None:
    """Raise unless the boundary is a surface at every corner of the grid."""
    code = np.zeros(tuple(n - 1 for n in padded.shape), dtype=np.uint8)
    for bit, place in enumerate(itertools.product((0, 1), repeat=3)):
        window = tuple(slice(p, p + n) for p, n in zip(place, code.shape, strict=True))
        code |= padded[window].astype(np.uint8) << np.uint8(bit)
    pinched = np.argwhere(~_is_regular()[code])
    if len(pinched):
        raise MeshError(
            f"the boundary of the cells is pinched at {len(pinched)} corners of the grid, the "
            f"first at {tuple(pinched[0].tolist())}: cells meet there in an edge or a corner only."
        )


@cache
def _is_regular() -> Bools:
    """For each of the 256 ways to fill the cells at a corner, whether the boundary is a surface."""
    from scipy.ndimage import label  # slow to import

    ways = (np.arange(256)[:, None] >> np.arange(8) & 1).astype(bool).reshape(-1, 2, 2, 2)
    return np.array([label(way)[1] <= 1 and label(~way)[1] <= 1 for way in ways])
