"""What two period matrices are compared by in balls: each reduced, with the γ that leads there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import flint
import numpy as np

from igl_periods.arrays import Ints
from igl_periods.siegel import (
    ARRAY_ERROR,
    ball_matrix,
    balls_of,
    bits_of,
    energy_balls,
    moved_balls,
    siegel_reduce,
)
from igl_periods.symplectic import form_action, product, unimodular_inverse

_DIGITS_PER_BIT = math.log10(2.0)


@dataclass(frozen=True, eq=False)
class ReducedBalls:
    """A reduced period matrix in balls.

    Attributes
    ----------
    matrix : (g, g) acb_mat
    gamma : (2g, 2g) int
        Leads from the given marking to this one.
    bits : int
        A precision that loses nothing.
    proved : bool
        Whether the balls contain the exact matrix, not only what an array is taken to be.
    """

    matrix: flint.acb_mat
    gamma: Ints
    bits: int
    proved: bool

    @property
    def genus(self) -> int:
        """The genus g."""
        return len(self.gamma) // 2

    def __repr__(self) -> str:
        known = "proved" if self.proved else "taken for right"
        return f"ReducedBalls(genus {self.genus}, {self.bits} bits, {known})"

    def energies(self) -> flint.arb_mat:
        """The energy matrix in balls; (2g, 2g)."""
        return energy_balls(self.matrix, self.bits)

    def reflected(self) -> ReducedBalls:
        """−Π̄, which is reduced with Π."""
        with flint.ctx.workprec(self.bits):
            mirrored = -1 * self.matrix.conjugate()
        # γ · Π = Π' implies (K γ K) · (−Π̄) = −Π̄', K = diag(1, −1).
        return ReducedBalls(mirrored, form_action(self.gamma), self.bits, self.proved)

    def relative_radius(self) -> float:
        """The largest radius of an entry, relative to √(Y_ii Y_jj)."""
        if self.genus == 0:
            return 0.0
        scale = [float(self.matrix[i, i].imag.mid()) for i in range(self.genus)]
        return max(
            float(self.matrix[i, j].rad()) / math.sqrt(scale[i] * scale[j])
            for i in range(self.genus)
            for j in range(self.genus)
        )


def in_balls(Pi1: Any, Pi2: Any) -> bool:
    """Whether two points are compared in balls: one has them, and none has a bound in floats."""
    known = [balls_of(Pi) is not None for Pi in (Pi1, Pi2)]
    return any(known) and all(
        balls or not hasattr(Pi, "bound") for balls, Pi in zip(known, (Pi1, Pi2))
    )


def reduced_balls(Pi: Any) -> ReducedBalls:
    """Reduce a point, with all that is known about its error."""
    reduced = siegel_reduce(Pi)
    if balls_of(Pi) is not None:
        return ReducedBalls(reduced.matrix, reduced.gamma, bits_of(Pi), True)
    scale = np.sqrt(np.diag(reduced.matrix.imag))
    matrix = ball_matrix(reduced.matrix, ARRAY_ERROR * np.outer(scale, scale))
    return ReducedBalls(matrix, reduced.gamma, bits_of(matrix), False)


def agreeing_digits(one: ReducedBalls, two: ReducedBalls, found: Sequence[Ints]) -> int:
    """Digits to which all γ · Π₁ agree with Π₂, relative to √(Y_ii Y_jj); a lower bound."""
    bits = max(one.bits, two.bits)
    back = unimodular_inverse(one.gamma)
    largest = flint.arb(0)
    for gamma in found:
        between = product(two.gamma, product(gamma, back))
        moved = moved_balls(between, one.matrix, bits)
        with flint.ctx.workprec(bits):
            largest = max(largest, _relative_distance(moved, two.matrix))
    known = int(_DIGITS_PER_BIT * bits)
    if largest == 0:
        return known
    digits = (-largest.log() / flint.arb.const_log10()).lower().floor()
    return max(0, min(known, int(digits.lower().fmpz())))


def _relative_distance(A: flint.acb_mat, B: flint.acb_mat) -> flint.arb:
    """An upper bound of the entries of A − B, relative to √(Y_ii Y_jj), Y = Im B."""
    g = A.nrows()
    roots = [B[i, i].imag.sqrt() for i in range(g)]
    return max(
        (abs(A[i, j] - B[i, j]) / (roots[i] * roots[j])).upper() for i in range(g) for j in range(g)
    )
