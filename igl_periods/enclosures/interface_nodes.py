r"""Gauss nodes on the interfaces, seen from the cells on both sides.

Interface i carries n_i nodes s in [0, 1].  On its first side a node is the point at s, on its
second side, which runs the other way, the point at 1 − s: nodes are symmetric about ½ to the last
bit, or both sides would mean different points and no residual would fall below 1e-16.

All nodes of a cell stand in consecutive *rows*, side after side.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from igl_periods.arrays import Complexes, Floats, Ints

from .cells import Cells

_UNIT = 2.0**-52


@dataclass(frozen=True, eq=False)
class InterfaceNodes:
    """The nodes of all interfaces.

    Attributes
    ----------
    cells : Cells
    n_nodes : (n_interfaces,) int
    row : (n_interfaces, 2) int
        The first row of each side.
    start : (n_cells + 1,) int
        The first row of each cell, and the end of the last one.
    """

    cells: Cells
    n_nodes: Ints
    row: Ints
    start: Ints

    @classmethod
    def of(cls, cells: Cells, n_nodes: Ints) -> InterfaceNodes:
        """Put ``n_nodes`` nodes on the interfaces; (n_interfaces,) int."""
        cell = cells.cell.ravel()
        order = np.argsort(cell, kind="stable")
        count = np.repeat(n_nodes, 2)
        row = np.empty(cell.size, dtype=np.int64)
        row[order] = np.cumsum(count[order]) - count[order]
        per_cell = np.bincount(cell, count, cells.n_cells).astype(np.int64)
        start = np.concatenate([[0], np.cumsum(per_cell)])
        return cls(cells, n_nodes, row.reshape(-1, 2), start)

    @property
    def n_rows(self) -> int:
        """Number of rows."""
        return int(self.start[-1])

    def rows(self, i: int, side: int) -> slice:
        """The rows of a side; row q of both sides is the same point."""
        first = int(self.row[i, side])
        return slice(first, first + int(self.n_nodes[i]))

    @cached_property
    def position(self) -> Floats:
        """The s of each row, from the start of its side."""
        position = np.empty(self.n_rows)
        for n, rows in self._sides_by_count():
            s, _ = gauss_nodes(n)
            position[rows[:, 0, None] + np.arange(n)] = s
            position[rows[:, 1, None] + np.arange(n)] = 1.0 - s
        return position

    @cached_property
    def weight(self) -> Floats:
        """The Gauss weight of each row."""
        weight = np.empty(self.n_rows)
        for n, rows in self._sides_by_count():
            weight[rows.ravel()[:, None] + np.arange(n)] = gauss_nodes(n)[1]
        return weight

    @cached_property
    def side_of_row(self) -> Ints:
        """The side ``2 i + side`` that each row belongs to."""
        side = np.argsort(self.row.ravel())
        return np.repeat(side, np.repeat(self.n_nodes, 2)[side])

    @cached_property
    def opposite(self) -> Ints:
        """The row of the same point on the other side of its interface."""
        opposite = np.empty(self.n_rows, dtype=np.int64)
        for n, rows in self._sides_by_count():
            here, there = (rows[:, side, None] + np.arange(n) for side in range(2))
            opposite[here], opposite[there] = there, here
        return opposite

    @cached_property
    def coordinates(self) -> tuple[Complexes, Complexes]:
        """The w of each row and dw/ds, in floating point."""
        cells, side = self.cells, self.side_of_row
        ends = cells.ends.reshape(-1, 2)[side]
        cell = cells.cell.ravel()[side]
        edge = ends[:, 1] - ends[:, 0]
        zeta = ends[:, 0] + self.position * edge
        w = zeta / cells.scale[cell]
        dw = edge / cells.scale[cell]
        star = np.flatnonzero(cell < cells.n_stars)
        kappa = cells.exponents[cell[star]]
        w[star] = np.exp(kappa * (np.log(w[star]) + 1j * cells.turns[side[star] // 2]))
        dw[star] = kappa * w[star] * edge[star] / zeta[star]
        return w, dw

    def _sides_by_count(self) -> list[tuple[int, Ints]]:
        return [(int(n), self.row[self.n_nodes == n]) for n in np.unique(self.n_nodes)]


_known: dict[int, tuple[Floats, Floats]] = {}


def gauss_nodes(n: int) -> tuple[Floats, Floats]:
    """Gauss–Legendre nodes on [0, 1], exactly symmetric multiples of 2⁻⁵², and their weights."""
    if n not in _known:
        x, weights = np.polynomial.legendre.leggauss(n)
        s = _UNIT * np.rint((0.5 + 0.5 * x) / _UNIT)
        half = n // 2
        s[n - half :] = (1.0 - s[:half])[::-1]
        if n % 2:
            s[half] = 0.5
        _known[n] = s, 0.5 * weights
    return _known[n]
