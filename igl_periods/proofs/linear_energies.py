r"""Energies of forms that are linear on triangles, in balls.

The form c + df has on each triangle a constant gradient, and with twice the area A₂, the length l
of side 2 and the foot s l of the height on it, from corner 0, its energy there is

.. math:: x_1^2 + x_2^2, \qquad x_1 = u_{01} \sqrt{\frac{A_2}{2 l^2}}, \quad
          x_2 = \frac{u_{02} - s\, u_{01}}{2} \Big/ \sqrt{\frac{A_2}{2 l^2}},

u_ij the integral from corner i to corner j.  Here every number is a ball, and so is the matrix of
energies, the Gram matrix of all rows x_1, x_2.

Which numbers are exact: the integers c; and the values f at the vertices, *as they are stored*.
Any values make a closed form, so a solver has nothing to prove, and by Dirichlet's principle the
energies of the balls are never below those of the harmonic forms.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats
from igl_periods.harmonic import blocks
from igl_periods.run_log import progress

from .midpoint_radius import UNIT, Balls, inner_products, total
from .shapes import check_known, double_areas, foot


class SideValues(Protocol):
    """The values of closed cochains along sides of faces, exact floating-point numbers."""

    def add_to(self, differences: Floats, start: int, side: int, sign: int) -> None:
        """Add ``sign`` times the values along a side of the faces from ``start`` on, (faces, k)."""


@dataclass(frozen=True, eq=False)
class EnclosedForms:
    """Forms c + df on triangles whose sides are balls.

    Attributes
    ----------
    lengths : (m, 3) balls
    corner_vertex : (m, 3) int
    jumps : SideValues
        Values of the cochains along the sides, as :class:`igl_periods.harmonic.linear_forms.Jumps`.
    potentials : (n_vertices, k) float
        The functions f, exact as they are.
    """

    lengths: Balls
    corner_vertex: NDArray[Any]
    jumps: SideValues
    potentials: Floats

    @property
    def n_forms(self) -> int:
        """Number of forms."""
        return int(self.potentials.shape[1])

    def gradients(self, block: slice) -> Balls:
        """Gradients on the faces f of a block, times the root of the area; (2 f, k).

        First the components along side 2 of each face, then those across it.

        Raises
        ------
        ComplexError
            If a triangle may be degenerate.
        """
        lengths = self.lengths[block]
        l0, l1, l2 = (lengths[:, s] for s in range(3))
        double_area = double_areas(lengths)
        check_known(double_area)
        along = (double_area / (l2 * l2)).scaled(0.5).sqrt()
        shear = foot(l2, l1, l0) / l2
        at_0, at_1, at_2 = (self.potentials[corner] for corner in self.corner_vertex[block].T)
        # Side 2 runs from corner 0 to corner 1, side 1 from corner 2 to corner 0.
        u01 = self._integrals(at_1, at_0, block, 2, 1)
        u02 = self._integrals(at_2, at_0, block, 1, -1)
        x1 = u01 * along[:, None]
        x2 = (u02 - shear[:, None] * u01).scaled(0.5) / along[:, None]
        return Balls(np.concatenate([x1.mid, x2.mid]), np.concatenate([x1.rad, x2.rad]))

    def _integrals(self, end: Floats, start: Floats, block: slice, side: int, sign: int) -> Balls:
        """Integrals from one corner to another, whose difference and jump are rounded each."""
        mid = end - start
        rad = np.abs(mid)
        self.jumps.add_to(mid, block.start, side, sign)
        rad += np.abs(mid)
        rad *= 1.01 * UNIT
        return Balls(mid, rad)


def enclosed_energies(one: EnclosedForms, two: EnclosedForms | None = None) -> Balls:
    """Energies ∫ ω_i ∧ *η_j of forms with others on the same faces, or among each other; (k, l).

    Raises
    ------
    ComplexError
        If a triangle may be degenerate.
    """
    return total(_on_blocks(one, two))


def _on_blocks(one: EnclosedForms, two: EnclosedForms | None) -> Iterator[Balls]:
    n_faces = len(one.corner_vertex)
    widest = one.n_forms if two is None else max(one.n_forms, two.n_forms)
    for block in blocks(n_faces, widest):
        progress("energies in balls", block.start, n_faces)
        X = one.gradients(block)
        yield inner_products(X, X if two is None else two.gradients(block))
