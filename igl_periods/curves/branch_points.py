r"""Branch points of a hyperelliptic surface from its theta constants.

Let B be the 2g + 2 branch points of y² = ∏ (x − x_i).  Points of order two of the Jacobian are the
subsets of B of even size up to complements, with Weil's pairing e_S · e_T = |S ∩ T|, and spin
structures χ_S those with |S| ≡ g + 1 (mod 2).  θ_S vanishes iff |S| ≠ g + 1, and Thomae's formula
says

.. math:: \theta_S^4 = \pm\, c \prod_{i<j \in S} (x_i - x_j) \prod_{i<j \notin S} (x_i - x_j) .

For four points i, j, k, l and the rest divided into halves V and W therefore

.. math:: \frac{(x_i - x_j)(x_k - x_l)}{(x_i - x_k)(x_j - x_l)} = \pm
          \frac{\theta_{V ij}^2\, \theta_{V kl}^2}{\theta_{V ik}^2\, \theta_{V jl}^2},

and the sign is the only one with which this cross ratio and that with i, j, k, l → i, l, k, j add
up to 1.

So only the labels S of the characteristics are to be found.  For even g those of the one-point
sets are the spin structures of most sections: odd for g = 2, even and vanishing for g = 4.  For odd
g there is one such, χ_∅, even and vanishing for g = 3, odd for g = 5; the differences of those of
the pairs are the e_{ij}, and a star e_{1i}, …, e_{2g+1,i} is a set of 2g + 1 of them with all
pairings 1.

References
----------
Mumford, "Tata lectures on theta II" (1984), sections IIIa.6 and IIIa.8.
Takase, "A generalization of Rosenhain's normal form for hyperelliptic curves with an application"
(1996).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, permutations
from math import comb
from typing import TypeAlias

import flint
import numpy as np

from igl_periods.errors import CurveError
from igl_periods.riemann_theta import SpinStructure, spin_structures

from .binary_forms import Point

# The labels of branch points are spin structures (g even), or points of order two (g odd).
_Vector: TypeAlias = tuple[int, ...]
LARGEST_GENUS = 5


def branch_points(constants: flint.acb_mat) -> list[Point]:
    """The 2g + 2 branch points, the first three of which are 1, 0, ∞.

    Parameters
    ----------
    constants : (2^g, 2^g) acb_mat
        All theta constants (:func:`~igl_periods.moduli.theta_constants`), g from 2 to 5.

    Returns
    -------
    list of (x, z)
        Points of the projective line, in balls.

    Raises
    ------
    CurveError
        If other even theta constants vanish than on a hyperelliptic surface.
    """
    g = constants.nrows().bit_length() - 1
    labels = _Labels.of(vanishing_even(constants), g)
    values = {
        (*s.a, *s.b): z**2 for s, z in zip(spin_structures(g), constants.entries(), strict=True)
    }
    first = _normalised(labels, values)
    return _normalised(labels.in_order(_best_order(first)), values)


def _normalised(labels: _Labels, values: dict[_Vector, flint.acb]) -> list[Point]:
    one, zero = flint.acb(1), flint.acb(0)
    others = [_cross_ratio(labels, values, n) for n in range(3, len(labels.points))]
    return [(one, one), (zero, one), (one, zero), *((x, one) for x in others)]


def _best_order(points: list[Point]) -> list[int]:
    """An order of the points that leaves them far apart, with its first three at 1, 0, ∞."""
    x = np.array([complex(z) for z, _ in points[3:]])
    vectors = np.array([[1, 1], [0, 1], [1, 0], *([z, 1] for z in x)])
    vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    det = vectors[:, None, 0] * vectors[:, 1] - vectors[:, None, 1] * vectors[:, 0]

    def spread(i: int, k: int, j: int) -> float:
        rest = [n for n in range(len(points)) if n not in (i, k, j)]
        moved = np.abs(det[rest, k] * det[i, j] / (det[rest, j] * det[i, k]))
        apart = np.abs(det[rest, i] * det[k, j] / (det[rest, j] * det[i, k]))
        return float(max(moved.max(), 1 / moved.min(), 1 / apart.min()))

    first = min(permutations(range(len(points)), 3), key=lambda triple: spread(*triple))
    return [*first, *(n for n in range(len(points)) if n not in first)]


def vanishing_even(constants: flint.acb_mat) -> list[SpinStructure]:
    """Even spin structures whose theta constants may be 0."""
    g = constants.nrows().bit_length() - 1
    pairs = zip(spin_structures(g), constants.entries(), strict=True)
    return [s for s, z in pairs if s.is_even and z.contains(0)]


def number_vanishing(genus: int) -> int:
    """How many even theta constants vanish on a hyperelliptic surface.

    Examples
    --------
    >>> [number_vanishing(g) for g in (2, 3, 4, 5)]
    [0, 1, 10, 66]
    """
    return (4**genus + 2**genus) // 2 - comb(2 * genus + 1, genus)


class _Labels:
    """The characteristics of sets of branch points."""

    def __init__(self, points: Sequence[_Vector], origin: _Vector) -> None:
        self.points, self.origin = points, origin

    @classmethod
    def of(cls, vanishing: list[SpinStructure], g: int) -> _Labels:
        if len(vanishing) != number_vanishing(g):
            raise CurveError(
                f"{len(vanishing)} even theta constants vanish, and {number_vanishing(g)} do on a "
                f"hyperelliptic surface of genus {g}"
            )
        if g % 2 == 0:
            single = spin_structures(g, "odd") if g == 2 else vanishing
            points = [(*s.a, *s.b) for s in single]
            if len(points) != 2 * g + 2:
                raise CurveError(f"genus {g}: {len(points)} one-point characteristics")
            return cls(points, (0,) * (2 * g))
        centre = (*vanishing[0].a, *vanishing[0].b) if g == 3 else _centre(vanishing, g)
        pairs = spin_structures(g, "odd") if g == 3 else vanishing
        differences = [_plus((*s.a, *s.b), centre) for s in pairs]
        return cls([*_star(differences, g), (0,) * (2 * g)], centre)

    def in_order(self, order: list[int]) -> _Labels:
        """The same with the branch points in another order."""
        return _Labels([self.points[i] for i in order], self.origin)

    def characteristic(self, members: Sequence[int]) -> _Vector:
        """That of a set of g + 1 branch points."""
        return _plus(self.origin, *(self.points[i] for i in members))


def _cross_ratio(labels: _Labels, values: dict[_Vector, flint.acb], n: int) -> flint.acb:
    """The branch point n, where the first three are 1, 0, ∞."""
    i, k, j = 0, 1, 2
    rest = [m for m in range(len(labels.points)) if m not in (i, j, k, n)]
    half = rest[: len(rest) // 2]

    def product(p: int, q: int, r: int, s: int) -> flint.acb:
        first = values[labels.characteristic([*half, p, q])]
        return first * values[labels.characteristic([*half, r, s])]

    common = product(i, k, j, n)
    one, two = product(i, j, k, n) / common, product(i, n, j, k) / common
    for sign in (1, -1):
        for other in (1, -1):
            if (sign * one + other * two - 1).contains(0):
                return sign * one
    raise CurveError("cross ratios of theta constants do not add up to 1")


def _centre(vanishing: list[SpinStructure], g: int) -> _Vector:
    """The odd χ_∅ of genus 5: each e_{ij} pairs to 1 with the 2 · 2g others that share a point."""
    chi = np.array([(*s.a, *s.b) for s in vanishing])
    for spin in spin_structures(g, "odd"):
        e = (chi + np.array((*spin.a, *spin.b))) % 2
        pairings = (e[:, :g] @ e[:, g:].T + e[:, g:] @ e[:, :g].T) % 2
        if np.all(pairings.sum(axis=1) == 4 * g):
            return (*spin.a, *spin.b)
    raise CurveError("the vanishing theta constants do not belong to pairs of points")


def _star(differences: list[_Vector], g: int) -> list[_Vector]:
    """2g + 1 points of order two with all pairings 1: e_{1i}, …, e_{2g+1,i}."""
    a = differences[0]
    b = next(e for e in differences if _pairing(a, e))
    c = next(e for e in differences if _pairing(a, e) and _pairing(b, e) and e != _plus(a, b))
    star = [e for e in differences if all(_pairing(e, s) for s in (a, b, c) if s != e)]
    star = [e for e in star if e not in (_plus(a, b), _plus(b, c), _plus(a, c))]
    if len(star) != 2 * g + 1 or not all(_pairing(p, q) for p, q in combinations(star, 2)):
        raise CurveError("the characteristics do not belong to pairs of points")
    return star


def _plus(*vectors: _Vector) -> _Vector:
    return tuple(sum(digits) % 2 for digits in zip(*vectors, strict=True))


def _pairing(e: _Vector, f: _Vector) -> int:
    g = len(e) // 2
    return (np.dot(e[:g], f[g:]) + np.dot(e[g:], f[:g])) % 2
