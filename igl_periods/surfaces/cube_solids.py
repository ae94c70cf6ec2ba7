r"""Surfaces of very high genus: thickened lattices and Menger's sponge.

Both bound unions of cubes (:mod:`igl_periods.surfaces.voxels`).  The boundary of a solid S in space
has Euler characteristic 2 χ(S), hence genus 1 − χ(S) if it is connected.

*Lattices.*  The cubic lattice graph of a × b × c nodes has V = a b c nodes and
E = (a − 1) b c + a (b − 1) c + a b (c − 1) struts.  Thickened, it is a solid that contracts to the
graph: χ = V − E, and its boundary has genus E − V + 1.

*Menger's sponge.*  Of the 27 subcubes of a cube the 20 that meet an edge of it are kept, and so on
in each of those.  Let M_n be the solid of level n, and S_n the carpet (of Sierpiński) in which
neighbouring sponges meet.  Among the 20 subcubes there are 24 pairs with a common face, among the 8
squares of a carpet 8 pairs with a common side; what else they have in common cancels.  So

.. math:: \chi(S_n) = 8 \chi(S_{n-1}) - 8, \qquad
          \chi(M_n) = 20 \chi(M_{n-1}) - 24 \chi(S_{n-1}), \qquad \chi(S_0) = \chi(M_0) = 1,

and the boundary has genus

.. math:: g_n = 1 - \chi(M_n) = (21 \cdot 20^n + 38 \cdot 8^n - 59) / 133
              = 0, 5, 81, 1409, 26433, …

The surfaces have the symmetries of the solids, and symmetries hide errors: with ``jitter`` the
vertices are moved at random, and nothing is left of them.
"""

from __future__ import annotations

import operator
from collections.abc import Sequence

import numpy as np

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.errors import MeshError

from .voxels import voxel_surface

# More cells than this would need gigabytes.
_MOST_CELLS = 1 << 28


def thickened_lattice(
    shape: Sequence[int],
    subdivision: int = 1,
    *,
    aspect: int = 1,
    jitter: float = 0.0,
    seed: int = 0,
) -> tuple[Floats, Ints]:
    """Triangulate the boundary of a thickened cubic lattice, normals outward.

    Parameters
    ----------
    shape : (a, b, c) int
        Numbers of nodes, all ≥ 1.  With V nodes and E struts the genus is E − V + 1.
    subdivision : int
        Struts are n squares wide.
    aspect : int
        Struts are n · aspect squares long: there are 2 n² (6 V − 2 E + 4 E · aspect) triangles.
    jitter : float
        Vertices are moved at random by at most that fraction, < 1/6, of the side of a square.
    seed : int
        Of the random amounts.

    Returns
    -------
    V : (n, 3) float
        The squares have side 1.
    F : (m, 3) int

    Raises
    ------
    MeshError
        If a number is less than 1, or ``jitter`` is out of range.

    Examples
    --------
    >>> V, F = thickened_lattice((8, 7, 7), 2, aspect=3)  # of genus 624
    >>> len(F)
    100016
    """
    counts = [_counted(n, "shape") for n in shape]
    if len(counts) != 3:
        raise MeshError(f"shape = {tuple(counts)}: a lattice has three numbers of nodes.")
    n, gap = _counted(subdivision, "subdivision"), _counted(aspect, "aspect")
    _check_size([n * (count + gap * (count - 1)) for count in counts])
    node = [np.arange(count + gap * (count - 1)) % (1 + gap) == 0 for count in counts]
    x, y, z = np.meshgrid(*node, indexing="ij")
    # Nodes have three such coordinates, the cells of a strut two.
    return voxel_surface(_refined((x & y) | (y & z) | (z & x), n), jitter=jitter, seed=seed)


def menger_sponge(
    level: int, subdivision: int = 1, *, jitter: float = 0.0, seed: int = 0
) -> tuple[Floats, Ints]:
    """Triangulate the boundary of Menger's sponge, normals outward.

    Parameters
    ----------
    level : int
        0 is the cube.  The genus is (21 · 20ⁿ + 38 · 8ⁿ − 59) / 133: 5, 81, 1409 at levels 1, 2, 3.
    subdivision : int
        The squares of the surface, 2 · 20ⁿ + 4 · 8ⁿ, are divided into this number of squares in
        each direction, of two triangles each.
    jitter : float
        Vertices are moved at random by at most that fraction, < 1/6, of the side of a square.
    seed : int
        Of the random amounts.

    Returns
    -------
    V : (n, 3) float
        The squares have side 1.
    F : (m, 3) int

    Raises
    ------
    MeshError
        If ``level`` < 0, ``subdivision`` < 1, or ``jitter`` is out of range.

    Examples
    --------
    >>> V, F = menger_sponge(1)
    >>> len(V), len(F), (2 - (len(V) - len(F) // 2)) // 2
    (64, 144, 5)
    """
    depth, n = _counted(level, "level", least=0), _counted(subdivision, "subdivision")
    _check_size([n * 3**depth] * 3)
    x, y, z = np.indices((3**depth,) * 3, sparse=True)
    filled = np.ones((3**depth,) * 3, dtype=bool)
    for _ in range(depth):
        # A subcube is dropped if two of its coordinates or more are in the middle.
        i, j, k = (coordinate % 3 == 1 for coordinate in (x, y, z))
        filled &= ~((i & j) | (j & k) | (k & i))
        x, y, z = x // 3, y // 3, z // 3
    return voxel_surface(_refined(filled, n), jitter=jitter, seed=seed)


def _refined(cells: Bools, n: int) -> Bools:
    """Every cell divided into n × n × n."""
    for axis in range(3):
        cells = np.repeat(cells, n, axis)
    return cells


def _counted(number: int, name: str, least: int = 1) -> int:
    try:
        count = operator.index(number)
    except TypeError:
        count = least - 1
    if count < least:
        raise MeshError(f"{name} = {number!r}: a whole number >= {least} is needed.")
    return count


def _check_size(sides: Sequence[int]) -> None:
    cells = int(np.prod([float(side) for side in sides]))
    if cells > _MOST_CELLS:
        raise MeshError(f"the solid has {cells:.3g} cells, and up to {_MOST_CELLS:.3g} are made.")
