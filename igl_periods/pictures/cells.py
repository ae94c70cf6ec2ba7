r"""Cells of periodic surfaces: cycles that leave a cell and come back, and several copies.

A closed walk on the quotient M/Λ is a path on M that ends at a translate of its beginning.  It is
smoothed there: a point of it is moved by Λ into the parallelepiped of the translations, around
which there are copies of the cell, goes to the nearest place of these, and back.  Each of the
copies that the path then runs through shows a piece of the curve in the cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product
from typing import TypeAlias

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import Cell

from .scene import Scene, Tube
from .sheets import Sheet
from .tubes import Periodicity, SmoothCurve, smooth_closed_curves

# Points, normals, and whether the curve is closed.
Piece: TypeAlias = tuple[Floats, Floats, bool]

# How far around the parallelepiped there are copies of the cell, in parts of the translations.
_MARGIN = 0.15


def smooth_cycles(sheet: Sheet, walks: Sequence[Ints]) -> list[list[Piece]]:
    """Closed walks along half-edges as smooth curves; in a cell or the plane each in pieces.

    Parameters
    ----------
    sheet : Sheet
    walks : sequence of (k,) int
        Half-edges of the complex.
    """
    if not walks:
        return []
    if sheet.unfolded:
        up = np.array([0.0, 0.0, 1.0])
        return [
            [(sheet.V[rows], np.tile(up, (len(rows), 1)), False) for rows in sheet.pieces(walk)]
            for walk in walks
        ]
    if sheet.complex.cell is None:
        curves = [sheet.V[sheet.ends(walk)[0]] for walk in walks]
        smooth = smooth_closed_curves(sheet.V, sheet.F, curves)
        return [[(curve.points, curve.normals, True)] for curve in smooth]
    block = _Block.around(sheet, sheet.complex.cell)
    paths = [_path(sheet, walk) for walk in walks]
    holonomies = [path[-1] - path[0] for path in paths]
    periodicity = Periodicity(holonomies, block.home, sheet.V)
    curves = [path[:-1] for path in paths]
    smooth = smooth_closed_curves(block.V, block.F, curves, periodicity)
    return [_pieces(block, curve, step) for curve, step in zip(smooth, holonomies)]


def _path(sheet: Sheet, walk: Ints) -> Floats:
    """The corners of the path over a walk, its end included; (k + 1, 3)."""
    tail, head = (sheet.V[end] for end in sheet.ends(walk))
    steps = np.cumsum(head - tail, axis=0)
    return np.concatenate([tail[:1], tail[0] + steps])


@dataclass(frozen=True, eq=False)
class _Block:
    """Copies of a cell, as far as they are near the parallelepiped of the translations.

    Attributes
    ----------
    V, F : (n, 3) float, (m, 3) int
    shift : (m, 3) float
        The translation that takes the face of the cell to the one of the block.
    lattice : (k, 3) float
    """

    V: Floats
    F: Ints
    shift: Floats
    lattice: Floats

    @classmethod
    def around(cls, sheet: Sheet, cell: Cell) -> _Block:
        lattice = _in_space(cell.lattice)
        place = sheet.V @ np.linalg.pinv(lattice)
        corners = place[sheet.F]
        ranges = [
            range(int(np.ceil(-_MARGIN - high)), int(np.floor(1 + _MARGIN - low)) + 1)
            for low, high in zip(corners.min(axis=(0, 1)), corners.max(axis=(0, 1)))
        ]
        V, F, shift = [], [], []
        for k, step in enumerate(product(*ranges)):
            moved = corners + np.array(step)
            near = ((moved.max(axis=1) > -_MARGIN) & (moved.min(axis=1) < 1 + _MARGIN)).all(axis=1)
            V.append(sheet.V + np.array(step) @ lattice)
            F.append(sheet.F[near] + k * len(sheet.V))
            shift.append(np.tile(np.array(step) @ lattice, (int(near.sum()), 1)))
        return cls(np.concatenate(V), np.concatenate(F), np.concatenate(shift), lattice)

    def home(self, points: Floats) -> Floats:
        """The translations that take points out of the parallelepiped to where they are."""
        return np.floor(points @ np.linalg.pinv(self.lattice)) @ self.lattice


def _pieces(block: _Block, curve: SmoothCurve, holonomy: Floats) -> list[Piece]:
    """The pieces of a curve in the cell, each up to the first point of the next one."""
    offset = curve.away + block.shift[curve.face]
    inverse = np.linalg.pinv(block.lattice)
    steps, turn = np.rint(offset @ inverse), np.rint(holonomy @ inverse)
    after = np.concatenate([steps[1:], steps[:1] + turn])
    breaks = np.flatnonzero((steps != after).any(axis=1))
    if breaks.size == 0:
        return [(curve.points - offset, curve.normals, True)]
    # From a break to the same one in the next round, and one point more.
    n = len(steps)
    rounds = np.arange(2 * n + 1) // n
    points = np.resize(curve.points, (2 * n + 1, 3)) + rounds[:, None] * holonomy
    normals = np.resize(curve.normals, (2 * n + 1, 3))
    pieces = []
    for first, last in pairwise([*breaks.tolist(), int(breaks[0]) + n]):
        rows = np.arange(first + 1, last + 2)
        begin = (first + 1) % n
        lifted = offset[begin] + (holonomy if first + 1 >= n else 0.0)
        pieces.append((points[rows] - lifted, normals[rows], False))
    return pieces


def copy_shifts(cell: Cell | None, copies: Sequence[int]) -> Floats:
    """The translations that take a cell to its copies; (k, 3).

    Raises
    ------
    ValueError
        As :func:`periodic_copies`.
    """
    lattice = np.zeros((0, 3)) if cell is None else _in_space(cell.lattice)
    if cell is None and set(copies) != {1}:
        raise ValueError(
            "there are copies of the cells of periodic surfaces alone: give a lattice."
        )
    numbers = list(copies) * (len(lattice) if len(copies) == 1 else 1)
    if len(numbers) != len(lattice) or min(numbers, default=1) < 1:
        raise ValueError(
            f"copies = {list(copies)}: one number of copies for each of {len(lattice)} "
            "translations, or one for all of them, at least 1."
        )
    return np.array(list(product(*map(range, numbers))), dtype=np.float64) @ lattice


def periodic_copies(scene: Scene, cell: Cell | None, copies: Sequence[int]) -> Scene:
    """Several copies of a cell, one beside the other along each translation.

    Parameters
    ----------
    scene : Scene
        Of one cell.
    cell : Cell or None
        ``K.cell`` of the surface.
    copies : sequence of int
        How many along each of its translations; one number counts for all.

    Raises
    ------
    ValueError
        If there is not one number, or one for each translation, all of them at least 1; or several
        copies are wanted of a surface that is not periodic.
    """
    shifts = copy_shifts(cell, copies)
    n = len(scene.V)
    return replace(
        scene,
        V=np.concatenate([scene.V + t for t in shifts]),
        F=np.concatenate([scene.F + k * n for k in range(len(shifts))]),
        colours=np.tile(scene.colours, (len(shifts), 1)),
        corner_uv=None
        if scene.corner_uv is None
        else np.tile(scene.corner_uv, (len(shifts), 1, 1)),
        tubes=tuple(
            Tube(curve.points + t, curve.normals, curve.colour, curve.closed)
            for t in shifts
            for curve in scene.tubes
        ),
        balls=tuple(
            (np.concatenate([points + t for t in shifts]), radius, colour)
            for points, radius, colour in scene.balls
        ),
    )


def _in_space(lattice: Floats) -> Floats:
    space = np.zeros((len(lattice), 3))
    space[:, : lattice.shape[1]] = lattice
    return space
