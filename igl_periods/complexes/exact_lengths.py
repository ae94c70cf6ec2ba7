r"""Lengths that are exact: functions of the precision that give balls.

The doubles in ``lengths`` of a complex are rounded: √2 is not among them.  A complex may carry
``exact_lengths``, a function of a number of bits that gives a ball for every edge, and then what is
proved about it is proved about these lengths.  The reference surfaces do, since only a few lengths
occur on them, each given by a formula.

The functions are dataclasses and partial applications of functions on the top level of this
module, so that a complex which carries them can be pickled.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

import flint
import numpy as np

from igl_periods.arrays import Ints, ReadOnlyArrays

ExactLengths = Callable[[int], Sequence[flint.arb]]


@dataclass(frozen=True, eq=False, repr=False)
class LengthsByKind(ReadOnlyArrays):
    """A few lengths, and which of them each edge has.

    Attributes
    ----------
    kind : (n_edges,) int
    formulas : sequence of functions
        Each gives a ball, at the working precision of python-flint.
    """

    kind: Ints
    formulas: Sequence[Callable[[], flint.arb]]

    def __repr__(self) -> str:
        return f"LengthsByKind({len(self.formulas)} lengths of {self.kind.size} edges)"

    def __call__(self, bits: int) -> list[flint.arb]:
        """The lengths of the edges."""
        with flint.ctx.workprec(bits):
            values = [formula() for formula in self.formulas]
        return [values[k] for k in self.kind.tolist()]


@dataclass(frozen=True, eq=False)
class LengthsAbove(ReadOnlyArrays):
    """The lengths of a surface over another one, whose edges lie over edges of that.

    Attributes
    ----------
    lengths : function
        The lengths below.
    edge : (n_edges,) int
        The edge below each edge.
    """

    lengths: ExactLengths
    edge: Ints

    def __call__(self, bits: int) -> list[flint.arb]:
        """The lengths of the edges."""
        below = list(self.lengths(bits))
        return [below[e] for e in self.edge.tolist()]


def by_kind(edge: Ints, kind: Ints, formulas: Sequence[Callable[[], flint.arb]]) -> LengthsByKind:
    """Lengths whose kinds are known for the sides of all faces, (m, 3) int like ``edge``."""
    of_edge = np.zeros(int(edge.max()) + 1, dtype=np.int64)
    of_edge[edge.ravel()] = kind.ravel()
    return LengthsByKind(of_edge, tuple(formulas))


def rational(x: float | Fraction) -> flint.arb:
    """A rational number; doubles are."""
    exact = Fraction(x)
    return flint.arb(flint.fmpq(exact.numerator, exact.denominator))


def square_root(square: Fraction) -> flint.arb:
    """√q."""
    return rational(square).sqrt()


def root_of(square: Fraction) -> Callable[[], flint.arb]:
    """The formula √q."""
    return partial(square_root, square)


def circumradius(k: int, n: int) -> flint.arb:
    """The circumradius of a regular k-gon with sides 1/n: 1 / (2 n sin π/k)."""
    return 1 / (2 * n * flint.arb.sin_pi_fmpq(flint.fmpq(1, k)))


def lattice_length(tau: complex, p: Fraction, q: Fraction) -> flint.arb:
    """|p + q τ|, τ taken as it is stored."""
    x = rational(p) + rational(q) * rational(tau.real)
    y = rational(q) * rational(tau.imag)
    return (x * x + y * y).sqrt()
