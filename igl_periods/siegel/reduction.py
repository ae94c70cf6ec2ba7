r"""Siegel reduction: a point with small entries in the orbit of a period matrix.

Siegel reduction walks along the orbit of Π = X + iY under Sp(2g, Z) with three kinds of steps
(:mod:`igl_periods.siegel.reduction_steps`),

* Π → U Π Uᵀ, U unimodular, which LLL-reduces Y and puts a shortest vector first,
* Π → Π − S, S integer and symmetric, which makes the entries of X at most ½,
* the quasi-inversion at an index j with |Π_jj| < 1, the partial modular inversion Π_jj → −1/Π_jj.

Only the last one changes det Y, by the factor |Π_jj|⁻² > 1.  The determinants det Y along an
orbit do not accumulate at a positive number, so the walk ends.  The result is *not* a normal form
for g ≥ 2: it is not to be compared entry by entry.

Above genus 16 the walk starts with a pairwise reduction of the whole canonical basis
(:mod:`~igl_periods.siegel.reducing_pairs`), O(g²) for each round of moves.  It leaves little to do
for the lattice reductions, O(g³) in a few passes, and for the quasi-inversions, about one for each
handle and O(g²) each.  So everything is O(g³), but in dozens of passes.

All transformations are integer and exact.  The matrix that is returned is computed from the
given one and the accumulated γ, right to rounding (:mod:`igl_periods.siegel.action`), so no error
accumulates either.

References
----------
Deconinck, Heil, Bobenko, van Hoeij, Schmies, "Computing Riemann theta functions" (2004), section 5.
"""

from __future__ import annotations

import itertools
from typing import Any, NamedTuple, overload

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Ints
from igl_periods.display import (
    ball_matrix_lines,
    facts_html,
    integer_lines,
    lines_html,
    matrix_html,
    matrix_lines,
    readable_digits,
)
from igl_periods.options import checked_number
from igl_periods.symplectic import energy_matrix, form_action, product

from .action import moebius
from .enclosed_points import PointInBalls, balls_of, in_marking, midpoint
from .half_space import check_siegel_point
from .reducing_pairs import pairwise_reduction
from .reduction_steps import (
    SMALL_GENUS,
    exact_product,
    inversion_step,
    is_nearly_reduced,
    lattice_step,
)

SIEGEL_GENUS_LIMIT = 1000


"""Matrices of larger genus are reduced only if that is asked for: it takes a minute and more."""


# After so many steps (there are seldom ten) every single quasi-inversion starts from exact values,
# so that det Y rises for certain.
_HASTY_STEPS = 100
# Times that the midpoint of balls is rounded and reduced.
_MOST_ROUNDINGS = 8
# Rows up to which γ is shown in a notebook.
_GAMMA_SHOWN = 16


class SiegelReduction(NamedTuple):
    """A reduced period matrix and the modular transformation that leads to it.

    Attributes
    ----------
    matrix : (g, g) complex
        γ · Π.
    gamma : (2g, 2g) int
        Integer symplectic, exactly.

    Examples
    --------
    >>> import igl_periods as ip
    >>> matrix, gamma = ip.siegel_reduce([[5 + 0.5j]])
    >>> matrix, gamma.tolist()
    (array([[0.+2.j]]), [[0, -1], [1, -5]])
    """

    matrix: Complexes
    gamma: Ints

    def __repr__(self) -> str:
        lines = [f"  {line}" for line in matrix_lines(self.matrix, None)]
        size = len(self.gamma)
        return "\n".join([f"SiegelReduction by γ ({size} × {size}) to", *lines])

    def _repr_html_(self) -> str:
        gamma = self.gamma if len(self.gamma) <= _GAMMA_SHOWN else self.gamma[:0]
        parts = [matrix_html(self.matrix, None)]
        parts += [lines_html("γ", integer_lines(gamma))] if gamma.size else []
        return facts_html("Siegel reduction", [("genus", len(self.matrix))], *parts)


class EnclosedReduction(NamedTuple):
    """A reduced period matrix in balls, and the modular transformation that leads to it.

    Attributes
    ----------
    matrix : (g, g) acb_mat
        γ · Π for every Π in the given balls.
    gamma : (2g, 2g) int
        Integer symplectic, exactly.
    """

    matrix: flint.acb_mat
    gamma: Ints

    def __repr__(self) -> str:
        size = len(self.gamma)
        rows = [f"  {row}" for row in self._rows()]
        return "\n".join([f"EnclosedReduction by γ ({size} × {size}) to", *rows])

    def _repr_html_(self) -> str:
        gamma = self.gamma if len(self.gamma) <= _GAMMA_SHOWN else self.gamma[:0]
        parts = [lines_html("the matrix", self._rows())] if len(self.gamma) else []
        parts += [lines_html("γ", integer_lines(gamma))] if gamma.size else []
        return facts_html("Siegel reduction", [("genus", len(self.gamma) // 2)], *parts)

    def _rows(self) -> list[str]:
        return ball_matrix_lines(self.matrix, readable_digits(len(self.gamma) // 2))


@overload
def siegel_reduce(
    Pi: PointInBalls, *, max_genus: int = SIEGEL_GENUS_LIMIT
) -> EnclosedReduction: ...
@overload
def siegel_reduce(Pi: ArrayLike, *, max_genus: int = SIEGEL_GENUS_LIMIT) -> SiegelReduction: ...
def siegel_reduce(
    Pi: ArrayLike | PointInBalls, *, max_genus: int = SIEGEL_GENUS_LIMIT
) -> SiegelReduction | EnclosedReduction:
    """Siegel reduction: a modular transformation γ to a matrix Π' = γ · Π with small entries.

    It promises |Re Π'| ≤ ½, Im Π' LLL-reduced (up to g = 8 with a shortest vector first), and
    |Π'_jj| ≥ 1 at every index j, all up to 1e-12.

    Parameters
    ----------
    Pi : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat
        Symmetric, with positive definite imaginary part.
    max_genus : int
        The largest genus to try.  The time grows like g³: seconds at genus 600, a minute at 1300.

    Returns
    -------
    SiegelReduction, or EnclosedReduction
        ``(matrix, gamma)``.  Of a point that is known in balls the matrix is one of balls, and
        reduced at its midpoint.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space, or so close to its boundary that γ would
        not fit into 64-bit integers.
    ValueError
        If its genus is larger than ``max_genus``.

    References
    ----------
    Deconinck, Heil, Bobenko, van Hoeij, Schmies (2004), section 5; here with quasi-inversions at
    all indices, which needs fewer lattice reductions.

    Examples
    --------
    >>> matrix, gamma = siegel_reduce([[0.25 + 0.25j]])
    >>> np.round(matrix, 12), gamma.tolist()
    (array([[0.+2.j]]), [[2, -1], [1, 0]])
    """
    start = check_siegel_point(Pi)
    _check_genus(len(start), max_genus)
    return _reduced_point(start) if balls_of(Pi) is None else _reduced_balls(Pi)


def _reduced_point(start: Complexes) -> SiegelReduction:
    g = len(start)
    small = g <= SMALL_GENUS
    point, gamma = start, np.eye(2 * g, dtype=np.int64)
    # At high genus a pairwise reduction comes first, and points are moved in floating point.
    if not small and not is_nearly_reduced(start):
        gamma = form_action(pairwise_reduction(energy_matrix(start)))
        point = moebius(gamma, start)
    exact, n_idle = True, 0
    for n_steps in itertools.count():
        hasty = n_steps < _HASTY_STEPS
        if n_steps % 2 == 0:
            step = lattice_step(point)
        else:
            step = inversion_step(point, g if hasty else 1)
        n_idle = n_idle + 1 if step.idle else 0
        if n_idle == 2 and exact:
            return SiegelReduction(point, gamma)
        if not step.idle:
            gamma = exact_product(step.gamma, gamma)
            moved = None if small or not hasty else step.point
            exact = moved is None
            point = moebius(gamma, start) if moved is None else moved
        elif n_idle == 2:
            point, exact, n_idle = moebius(gamma, start), True, 0
    raise AssertionError("unreachable: the walk along the orbit ends")


def _reduced_balls(Pi: Any) -> EnclosedReduction:
    """Reduce the midpoint, and again as long as its rounding has left something to reduce."""
    balls, total = balls_of(Pi), np.eye(2 * len(check_siegel_point(Pi)), dtype=np.int64)
    assert balls is not None
    for _ in range(_MOST_ROUNDINGS):
        gamma = _reduced_point(check_siegel_point(midpoint(balls))).gamma
        if np.array_equal(gamma, np.eye(len(gamma))):
            break
        total = product(gamma, total)
        balls = in_marking(Pi, total)
    return EnclosedReduction(balls, total)


def _check_genus(genus: int, max_genus: int) -> None:
    """Raise ValueError if a genus is too large for Siegel reduction."""
    if not genus <= checked_number("max_genus", max_genus):
        raise ValueError(
            f"Siegel reduction is done up to genus {max_genus} unless asked for, and this matrix "
            f"has genus {genus}: the time grows like g³, to a minute and more above genus "
            f"{SIEGEL_GENUS_LIMIT}. max_genus={genus} does it nevertheless; the matrix as it is "
            "needs no reduction to be right."
        )
