"""Points of the Siegel upper half-space in balls, and as objects that are known in balls."""

from dataclasses import dataclass

import flint
import numpy as np

from igl_periods.siegel import moved_balls


def with_radius(Pi, digits):
    """A complex matrix, exact as it is stored, with balls of radius 10^−digits around it."""
    radius = flint.arb(10) ** -digits
    rows = [
        [flint.acb(flint.arb(z.real, radius), flint.arb(z.imag, radius)) for z in row]
        for row in np.asarray(Pi).tolist()
    ]
    return flint.acb_mat(rows)


@dataclass(frozen=True)
class Enclosed:
    """The least that a point is asked for that is known in balls."""

    matrix: flint.acb_mat
    bits: int

    def change_basis(self, gamma):
        return Enclosed(moved_balls(np.asarray(gamma), self.matrix, self.bits), self.bits)
