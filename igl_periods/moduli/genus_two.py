r"""The curve of genus 2 that belongs to a period matrix.

Every surface of genus 2 is a double cover y² = ∏ (x − x_i) of the sphere with six branch points,
unique up to Möbius transformations.  Three of them may be 0, 1, ∞; the others are Rosenhain's
quotients of theta constants.  Invariants of the binary sextic ∏ (x − x_i), those of Igusa and
Clebsch, no longer depend on an order of the branch points.

Where Π is known in balls all of them are balls that contain the exact numbers.

References
----------
Rosenhain, "Abhandlung über die Functionen zweier Variabler mit vier Perioden" (1851).
Igusa, "Arithmetic variety of moduli for genus two" (1960).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations, permutations
from math import prod
from typing import Any, overload

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes
from igl_periods.siegel import PointInBalls, balls_of, bits_of, siegel_reduce

from .theta import of_genus, theta_constants, vanishing_even_characteristics


@overload
def rosenhain_roots(Pi: PointInBalls) -> list[flint.acb]: ...
@overload
def rosenhain_roots(Pi: ArrayLike) -> Complexes: ...
def rosenhain_roots(Pi: ArrayLike | PointInBalls) -> Complexes | list[flint.acb]:
    """Branch points λ, μ, ν of the curve y² = x(x − 1)(x − λ)(x − μ)(x − ν) of genus 2.

    The other three are 0, 1, ∞.  Another marking of the surface permutes the six, so that
    the triple is one of up to 720 for the same curve.

    Parameters
    ----------
    Pi : (2, 2) array-like, PeriodMatrix, PeriodEnclosure or acb_mat

    Returns
    -------
    (3,) complex, or three acb of what is known in balls

    Raises
    ------
    ValueError
        If Π has another genus, or is (within its error) the period matrix of a product of two
        elliptic curves, which is not a curve of genus 2.

    References
    ----------
    Rosenhain (1851); with these characteristics in Dupont, "Moyenne arithmético-géométrique,
    suites de Borchardt et applications" (2006), section 6.3.

    Examples
    --------
    >>> rosenhain_roots(1j / np.sqrt(3) * np.array([[2, -1], [-1, 2]])).real.round(9).tolist()
    [1.5, 2.0, 3.0]
    """
    matrix, balls = of_genus(Pi, 2), balls_of(Pi)
    if vanishing := vanishing_even_characteristics(Pi):
        raise ValueError(
            f"the theta constant of characteristic {vanishing[0]} vanishes: this is the period "
            "matrix of a product of two elliptic curves, or too close to one"
        )
    if balls is None:
        return np.array(_quotients(theta_constants(siegel_reduce(matrix).matrix)))
    with flint.ctx.workprec(bits_of(Pi)):
        return _quotients(theta_constants(siegel_reduce(Pi).matrix))


def _quotients(theta: Any) -> list[Any]:
    """Rosenhain's quotients of theta constants."""
    even = [(0b00, b) for b in range(4)] + [(0b11, 0b00), (0b11, 0b11)]
    t0, t2, t1, t3, t12, t15 = (theta[a, b] * theta[a, b] for a, b in even)
    return [t0 * t1 / (t2 * t3), t1 * t12 / (t2 * t15), t0 * t12 / (t3 * t15)]


@overload
def igusa_clebsch_invariants(roots: list[flint.acb]) -> list[flint.acb]: ...
@overload
def igusa_clebsch_invariants(roots: ArrayLike) -> Complexes: ...
def igusa_clebsch_invariants(roots: ArrayLike | list[flint.acb]) -> Complexes | list[flint.acb]:
    r"""Igusa–Clebsch invariants I₂, I₄, I₆, I₁₀ of the curve y² = ∏ (x − x_i) of genus 2.

    With (ij) = x_i − x_j they are sums over the ways to divide six points,

    .. math:: I_2 = \sum_{15} (12)^2 (34)^2 (56)^2, \qquad
              I_4 = \sum_{10} (12)^2 (23)^2 (31)^2 (45)^2 (56)^2 (64)^2, \\
              I_6 = \sum_{60} (12)^2 (23)^2 (31)^2 (45)^2 (56)^2 (64)^2 (14)^2 (25)^2 (36)^2,
              \qquad I_{10} = \prod_{i<j} (ij)^2 ,

    where a factor with a point at ∞ is left out.  Two curves are isomorphic iff the invariants
    are proportional with weights 2, 4, 6, 10.

    Parameters
    ----------
    roots : (3,), (5,) or (6,) array-like of complex, or list of acb
        Rosenhain's λ, μ, ν; or the finite branch points, ∞ being the sixth if there are five.

    Returns
    -------
    (4,) complex, or four acb

    Raises
    ------
    ValueError
        If there is another number of roots, or two coincide, or may coincide.

    References
    ----------
    Igusa, "Arithmetic variety of moduli for genus two" (1960), section 3.

    Examples
    --------
    >>> igusa_clebsch_invariants([0, 1, -1, 1j, -1j]).real.round(9).tolist()  # y² = x⁵ − x
    [-40.0, -80.0, 320.0, -256.0]
    """
    if isinstance(roots, list) and any(isinstance(x, flint.acb) for x in roots):
        with flint.ctx.workprec(bits_of(flint.acb_mat([roots]))):
            return _invariants(_squared_differences(roots))
    array = np.asarray(roots, dtype=np.complex128)
    if array.ndim != 1:
        raise ValueError(f"a curve of genus 2 has 3, 5 or 6 finite roots here, not {array.shape}")
    return np.array(_invariants(_squared_differences(array.tolist())))


def _invariants(squares: list[list[Any]]) -> list[Any]:
    i2 = sum(_product(squares, pairs) for pairs in _pairings((0, 1, 2, 3, 4, 5)))
    i4 = i6 = 0
    for one, two in _halves():
        triangles = _product(squares, [*combinations(one, 2), *combinations(two, 2)])
        i4 += triangles
        i6 += sum(
            triangles * _product(squares, zip(one, p, strict=True)) for p in permutations(two)
        )
    return [i2, i4, i6, _product(squares, combinations(range(6), 2))]


@overload
def absolute_igusa_invariants(Pi: PointInBalls) -> list[flint.acb] | None: ...
@overload
def absolute_igusa_invariants(Pi: ArrayLike) -> Complexes | None: ...
def absolute_igusa_invariants(
    Pi: ArrayLike | PointInBalls,
) -> Complexes | list[flint.acb] | None:
    r"""The absolute invariants :math:`(I_2^5, I_2^3 I_4, I_2^2 I_6) / I_{10}` of a curve.

    Two curves of genus 2 with I₂ ≠ 0 are isomorphic iff all three agree.

    Returns
    -------
    (3,) complex, three acb of what is known in balls, or None
        None for a product of two elliptic curves, or what cannot be told from one.

    References
    ----------
    Igusa, "Arithmetic variety of moduli for genus two" (1960), section 8.

    Examples
    --------
    >>> Pi = 1j / np.sqrt(3) * np.array([[2, -1], [-1, 2]])  # y² = x⁶ − 1
    >>> absolute_igusa_invariants(Pi).real.round(3).tolist()
    [17066666.667, 480000.0, 148000.0]
    """
    try:
        i2, i4, i6, i10 = igusa_clebsch_invariants(rosenhain_roots(Pi))
    except ValueError:
        return None
    if balls_of(Pi) is not None:
        with flint.ctx.workprec(bits_of(Pi)):
            return [i2**5 / i10, i2**3 * i4 / i10, i2**2 * i6 / i10]
    absolute = np.array([i2**5, i2**3 * i4, i2**2 * i6]) / i10
    return absolute if np.isfinite(absolute).all() else None


def _product(squares: list[list[Any]], pairs: Iterable[Sequence[int]]) -> Any:
    return prod(squares[i][j] for i, j in pairs)


def _pairings(points: tuple[int, ...]) -> Iterator[list[tuple[int, int]]]:
    """The ways to divide points into pairs: 15 for six points."""
    if not points:
        yield []
        return
    first, *others = points
    for partner in others:
        rest = tuple(i for i in others if i != partner)
        yield from ([(first, partner), *pairs] for pairs in _pairings(rest))


def _halves() -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    """The 10 ways to divide six points into two triples."""
    for half in combinations(range(1, 6), 2):
        yield (0, *half), tuple(i for i in range(1, 6) if i not in half)


def _squared_differences(roots: list[Any]) -> list[list[Any]]:
    """(x_i − x_j)² of the six branch points, 1 where one of them is ∞."""
    if len(roots) not in (3, 5, 6):
        raise ValueError(f"a curve of genus 2 has 3, 5 or 6 finite roots here, not {len(roots)}")
    finite = [0, 1, *roots] if len(roots) == 3 else list(roots)
    squares: list[list[Any]] = [[1] * 6 for _ in range(6)]
    for i, j in permutations(range(len(finite)), 2):
        squares[i][j] = (finite[i] - finite[j]) * (finite[i] - finite[j])
        square = squares[i][j]
        if square == 0 or (isinstance(square, flint.acb) and square.contains(0)):
            raise ValueError("two branch points coincide: the curve is singular")
    return squares
