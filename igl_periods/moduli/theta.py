r"""Theta constants of a period matrix, and what they tell about the curve.

For a, b ∈ {0, 1}^g the theta constant of characteristic (a, b) is

.. math:: \theta_{a,b}(\Pi) = \sum_{n \in \mathbb{Z}^g} \exp \pi i \Big(
          (n + \tfrac a2)^T\, \Pi\, (n + \tfrac a2) + (n + \tfrac a2)^T b \Big).

It is even if a·b is, and odd ones vanish.  Sp(2g, Z) permutes the even ones up to factors, so that
ratios of them become invariants:

* g = 1: Klein's j, which determines the curve;
* g = 2: none of the 10 even ones vanishes on a curve, and they determine it
  (:mod:`igl_periods.moduli.genus_two`).  On a product of elliptic curves one of them vanishes;
* g = 3: none of the 36 even ones vanishes on a plane quartic, one does on a hyperelliptic curve,
  more on products.

Everything is computed in ball arithmetic from Π and its error, in the reduced marking.

References
----------
Mumford, "Tata lectures on theta II" (1984), section IIIa.
Glass, "Theta constants of genus three" (1980).
"""

from __future__ import annotations

from itertools import product
from typing import Any, overload

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes
from igl_periods.siegel import (
    ARRAY_ERROR,
    PRECISION,
    PointInBalls,
    ball_matrix,
    balls_of,
    bits_of,
    check_siegel_point,
    siegel_reduce,
)

Characteristic = tuple[tuple[int, ...], tuple[int, ...]]


@overload
def theta_constants(Pi: PointInBalls) -> flint.acb_mat: ...
@overload
def theta_constants(Pi: ArrayLike) -> Complexes: ...
def theta_constants(Pi: ArrayLike | PointInBalls) -> Complexes | flint.acb_mat:
    """The theta constants of all characteristics; shape (2^g, 2^g).

    Parameters
    ----------
    Pi : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat

    Returns
    -------
    (2^g, 2^g) complex, or acb_mat
        Entry [a, b], with the digits of a and b read as binary numbers, a_1 the leading digit.  Of
        a point that is known in balls: balls that contain them.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.

    Examples
    --------
    >>> abs(theta_constants([[1j]])).round(6).tolist()  # π^{1/4} / Γ(3/4) = 1.086435
    [[1.086435, 0.913579], [0.913579, 0.0]]
    """
    matrix = check_siegel_point(Pi)
    size = 2 ** len(matrix)
    balls = balls_of(Pi)
    if balls is not None:
        return flint.acb_mat(size, size, _theta(balls, bits_of(Pi)))
    values = [complex(z) for z in _theta(ball_matrix(matrix, np.zeros(matrix.shape)), PRECISION)]
    return np.array(values).reshape(size, -1)


def vanishing_even_characteristics(
    Pi: ArrayLike | PointInBalls,
) -> list[Characteristic] | None:
    """The even characteristics (a, b) with a theta constant that may vanish, after reduction.

    Parameters
    ----------
    Pi : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat
        Its error is that of the certificate, or of the balls; a plain array is taken to be right
        to 1e-8.

    Returns
    -------
    list of (a, b), or None
        In the marking of ``siegel_reduce(Pi)``.  The theta constants of all other even
        characteristics are certainly not 0.  None if the error is too large to compute anything.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.
    ValueError
        If Π is a ``PeriodMatrix`` without a certificate.
    """
    reduced = _reduced_in_balls(Pi)
    values = _theta(reduced, bits_of(reduced if balls_of(Pi) is None else Pi))
    if not all(z.is_finite() for z in values):
        return None
    digits = list(product((0, 1), repeat=reduced.nrows()))
    even = [np.dot(a, b) % 2 == 0 for a, b in product(digits, digits)]
    return [
        characteristic
        for characteristic, is_even, z in zip(product(digits, digits), even, values, strict=True)
        if is_even and z.contains(0)
    ]


def is_hyperelliptic(Pi: ArrayLike | PointInBalls) -> bool | None:
    """Whether the surface is hyperelliptic, as far as Π tells here.

    Surfaces of genus 1 and 2 are.  One of genus 3 is iff an even theta constant vanishes: False
    is proved for all matrices within the error of Π, True means that one of the 36 may vanish and
    the others certainly do not, so that Π is as close as its error (to all digits, in balls) to a
    hyperelliptic one.  None where several may vanish: the error is too large, or this is a product.
    None beyond genus 3.

    Raises
    ------
    NotASiegelPointError, ValueError
        As :func:`vanishing_even_characteristics`.

    Examples
    --------
    Every curve of genus 2 is.

    >>> import igl_periods as ip
    >>> ip.is_hyperelliptic([[2j, 0.5], [0.5, 2j]])
    True
    """
    genus = len(check_siegel_point(Pi))
    if genus < 3:
        return True
    vanishing = vanishing_even_characteristics(Pi) if genus == 3 else None
    return None if vanishing is None or len(vanishing) > 1 else bool(vanishing)


def of_genus(Pi: ArrayLike | PointInBalls, genus: int) -> Complexes:
    """Π, checked to be a Siegel point of this genus; ValueError otherwise."""
    matrix = check_siegel_point(Pi)
    if len(matrix) != genus:
        raise ValueError(f"this needs a surface of genus {genus}, and Π has genus {len(matrix)}")
    return matrix


def _reduced_in_balls(Pi: Any) -> flint.acb_mat:
    """The reduced matrix, with what is known about its error."""
    if balls_of(Pi) is not None:
        return siegel_reduce(Pi).matrix
    if hasattr(Pi, "reduced"):
        reduced = Pi.reduced()
        if reduced.entry_bounds is None:
            raise ValueError("a period matrix without a certificate: take its array, pm.matrix")
        return ball_matrix(reduced.matrix, reduced.entry_bounds)
    matrix = siegel_reduce(Pi).matrix
    scale = np.sqrt(np.diag(matrix.imag))
    return ball_matrix(matrix, ARRAY_ERROR * np.outer(scale, scale))


def _theta(Pi: flint.acb_mat, bits: int) -> list[flint.acb]:
    """All theta constants of a ball matrix, a before b in binary order."""
    if Pi.nrows() == 0:
        return [flint.acb(1)]
    with flint.ctx.workprec(bits):
        return list(Pi.theta(flint.acb_mat(Pi.nrows(), 1)).entries())
