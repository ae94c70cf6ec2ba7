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
from typing import Any

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats
from igl_periods.siegel import (
    ARRAY_ERROR,
    PRECISION,
    ball_matrix,
    check_siegel_point,
    siegel_reduce,
)

Characteristic = tuple[tuple[int, ...], tuple[int, ...]]


def theta_constants(Pi: ArrayLike) -> Complexes:
    """The theta constants of all characteristics; shape (2^g, 2^g).

    Parameters
    ----------
    Pi : (g, g) array-like or PeriodMatrix

    Returns
    -------
    (2^g, 2^g) complex
        Entry [a, b], with the digits of a and b read as binary numbers, a_1 the leading digit.

    Raises
    ------
    NotASiegelPointError
        If Π is no point of the Siegel upper half-space.

    Examples
    --------
    >>> abs(theta_constants([[1j]])).round(6).tolist()  # π^{1/4} / Γ(3/4) = 1.086435
    [[1.086435, 0.913579], [0.913579, 0.0]]
    """
    matrix = check_siegel_point(Pi)
    values = [complex(z) for z in _theta(ball_matrix(matrix, np.zeros(matrix.shape)))]
    return np.array(values).reshape(2 ** len(matrix), -1)


def vanishing_even_characteristics(Pi: ArrayLike) -> list[Characteristic] | None:
    """The even characteristics (a, b) with a theta constant that may vanish, after reduction.

    Parameters
    ----------
    Pi : (g, g) array-like or PeriodMatrix
        Its error is that of the certificate; a plain array is taken to be right to 1e-8.

    Returns
    -------
    list of (a, b), or None
        In the marking of ``siegel_reduce(Pi)``.  The theta constants of all other even
        characteristics are certainly not 0.  None if the error is too large to compute anything.

    Raises
    ------
    NotASiegelPointError
        If Π is no point of the Siegel upper half-space.
    ValueError
        If Π is a ``PeriodMatrix`` without a certificate.
    """
    matrix, error = _reduced_with_error(Pi)
    values = _theta(ball_matrix(matrix, error))
    if not all(z.is_finite() for z in values):
        return None
    digits = list(product((0, 1), repeat=len(matrix)))
    even = [np.dot(a, b) % 2 == 0 for a, b in product(digits, digits)]
    return [
        characteristic
        for characteristic, is_even, z in zip(product(digits, digits), even, values, strict=True)
        if is_even and z.contains(0)
    ]


def is_hyperelliptic(Pi: ArrayLike) -> bool | None:
    """Whether the surface is hyperelliptic, as far as Π tells here.

    Surfaces of genus 1 and 2 are.  One of genus 3 is iff an even theta constant vanishes: False
    is proved for all matrices within the error of Π, True means that one of the 36 may vanish and
    the others certainly do not, so that Π is as close as its error to a hyperelliptic one.  None
    where several may vanish: the error is too large, or this is a product.  None beyond genus 3.

    Raises
    ------
    NotASiegelPointError, ValueError
        As :func:`vanishing_even_characteristics`.
    """
    genus = len(check_siegel_point(Pi))
    if genus < 3:
        return True
    vanishing = vanishing_even_characteristics(Pi) if genus == 3 else None
    return None if vanishing is None or len(vanishing) > 1 else bool(vanishing)


def of_genus(Pi: ArrayLike, genus: int) -> Complexes:
    """Π, checked to be a Siegel point of this genus; ValueError otherwise."""
    matrix = check_siegel_point(Pi)
    if len(matrix) != genus:
        raise ValueError(f"this needs a surface of genus {genus}, and Π has genus {len(matrix)}")
    return matrix


def _reduced_with_error(Pi: Any) -> tuple[Complexes, Floats]:
    """The reduced matrix, and by how much each entry may be wrong."""
    if hasattr(Pi, "reduced"):
        reduced = Pi.reduced()
        if reduced.entry_bounds is None:
            raise ValueError("a period matrix without a certificate: take its array, pm.matrix")
        return reduced.matrix, reduced.entry_bounds
    matrix = siegel_reduce(Pi).matrix
    scale = np.sqrt(np.diag(matrix.imag))
    return matrix, ARRAY_ERROR * np.outer(scale, scale)


def _theta(Pi: flint.acb_mat) -> list[flint.acb]:
    """All theta constants of a ball matrix, a before b in binary order."""
    if Pi.nrows() == 0:
        return [flint.acb(1)]
    with flint.ctx.workprec(PRECISION):
        return list(Pi.theta(flint.acb_mat(Pi.nrows(), 1)).entries())
