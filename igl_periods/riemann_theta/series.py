r"""The theta series and its derivatives by z, in balls.

With Y = Im Π, y = Im z and c = Y⁻¹y a term has the modulus

.. math:: e^{\pi y^T Y^{-1} y}\; e^{-\pi Q(m + c)}, \qquad Q(x) = x^T Y x ,

so that the sum runs over the m in an ellipsoid Q(m + c) ≤ R².  The rest is bounded by splitting off
a fraction ε of the exponent: Y = L diag(d) Lᵀ, and sums over one coordinate after the other,

.. math:: \sum_{Q > R^2} e^{-\pi Q} \le e^{-\pi (1 - ε) R^2}
          \prod_i \big( 1 + 1/\sqrt{ε\, d_i} \big),

because Σ_n exp(−πt (n − s)²) ≤ 1 + 1/√t for every s.  A derivative of order k has the factors
2π |m_j| ≤ 2π (√(Q/λ) + |c|), λ the least eigenvalue of Y, which another ε/2 of the exponent pays
for: :math:`Q^{k/2} e^{-\pi ε Q/2} \le (k / (\pi ε e))^{k/2}`.

References
----------
Deconinck, Heil, Bobenko, van Hoeij, Schmies, "Computing Riemann theta functions" (2004), whose
bounds are sharper.
"""

from __future__ import annotations

import math
from itertools import combinations_with_replacement

import flint
import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import NotASiegelPointError
from igl_periods.siegel import cholesky, short_vectors

# The fraction of the exponent that pays for the number of terms.
_SPARE = 0.125
_MORE_BITS = 20
# Y is rounded to double precision for the enumeration: relative slacks, checked in balls.
_SLACKS = (2.0**-20, 2.0**-10, 2.0**-5, 2.0**-2)

Jet = dict[tuple[int, ...], flint.acb]


def theta_series(
    Pi: flint.acb_mat, z: flint.acb_mat, a: list[int], b: list[int], order: int = 0
) -> Jet:
    """All partial derivatives of order k of θ with characteristic (a/2, b/2), at z.

    Works at the precision ``flint.ctx.prec``.  Im Π should be reduced.

    Parameters
    ----------
    Pi : (g, g) acb_mat
        Symmetric.
    z : (g, 1) acb_mat
    a, b : list of int
        Any integers.
    order : int

    Returns
    -------
    dict
        From increasing index tuples (j_1, …, j_k) to ∂_{j_1} … ∂_{j_k} θ.

    Raises
    ------
    NotASiegelPointError
        If Im Π is not positive definite in balls.
    EnumerationLimitError
        If Im Π is so small that the series has too many terms; Siegel reduce it.
    """
    g = Pi.nrows()
    indices = list(combinations_with_replacement(range(g), order))
    if g == 0:
        return {(): flint.acb(1)}
    Y = flint.arb_mat([[Pi[i, j].imag for j in range(g)] for i in range(g)])
    y = flint.arb_mat([[z[i, 0].imag] for i in range(g)])
    c = Y.solve(y)
    half = flint.arb_mat([[flint.arb(flint.fmpq(k, 2))] for k in a])
    bits = flint.ctx.prec + _MORE_BITS
    radius = bits * math.log(2.0) / (math.pi * (1.0 - _SPARE))
    m = _terms(Y, half + c, radius)
    tail = _tail(Y, c, radius, order) * ((y.transpose() * c)[0, 0] * flint.arb.pi()).exp()
    sums = dict.fromkeys(indices, flint.acb(0))
    shift = [z[i, 0] + flint.arb(flint.fmpq(b[i], 2)) for i in range(g)]
    factor = flint.acb(0, 2) * flint.arb.pi()
    for row in (2 * m + np.array(a)).tolist():
        term = _term(Pi, shift, row)
        for index in indices:
            sums[index] += term * flint.fmpq(math.prod(row[j] for j in index), 2**order)
    error = flint.acb(flint.arb(0, tail), flint.arb(0, tail))
    return {index: value * factor**order + error for index, value in sums.items()}


def _term(Pi: flint.acb_mat, shift: list[flint.acb], row: list[int]) -> flint.acb:
    """Exp πi(mᵀΠm + 2 mᵀ shift) for 2m = row."""
    g = len(row)
    exponent = flint.acb(0)
    for i in range(g):
        if row[i]:
            inner = Pi[i, i] * row[i]
            for j in range(i):
                if row[j]:
                    inner += Pi[i, j] * (2 * row[j])
            exponent += (inner * flint.fmpq(1, 4) + shift[i]) * row[i]
    return exponent.exp_pi_i()


def _terms(Y: flint.arb_mat, centre: flint.arb_mat, radius: float) -> Ints:
    """All integer n with Q(n + centre) ≤ radius, and some more."""
    g = Y.nrows()
    rounded: Floats = np.array([float(x.mid()) for x in Y.entries()]).reshape(g, g)
    rounded = 0.5 * (rounded + rounded.T)
    point = np.array([float(x.mid()) for x in centre.entries()])
    nearby = flint.arb_mat([[flint.arb(x)] for x in point.tolist()])
    off = centre - nearby
    distance = float((off.transpose() * Y * off)[0, 0].abs_upper())
    # Q ≥ (1 − slack) Q~, and the centre is off by the distance: what is left out has Q > radius.
    wide = (math.sqrt(radius) + 1.001 * math.sqrt(distance) + 1e-9) ** 2
    for slack in _SLACKS:
        if cholesky(Y - flint.arb_mat(rounded.tolist()) * (1 - flint.arb(slack))) is not None:
            return short_vectors(rounded, wide / (1.0 - slack) * (1.0 + 1e-12), shift=point)[0]
    raise NotASiegelPointError("Im Π is not known to be positive definite, or very badly scaled")


def _tail(Y: flint.arb_mat, c: flint.arb_mat, radius: float, order: int) -> flint.arb:
    """A bound of the terms that are left out, without the factor exp(π yᵀY⁻¹y)."""
    factor = cholesky(Y)
    if factor is None:
        raise NotASiegelPointError("Im Π is not known to be positive definite")
    spare, pi = flint.arb(_SPARE), flint.arb.pi()
    count = flint.arb(1)
    for i in range(Y.nrows()):
        count *= 1 + (2 / spare).sqrt() / factor[i, i]
    size = (-pi * (1 - spare) * flint.arb(radius)).exp() * count
    if order == 0:
        return size.upper()
    inverse = Y.inv()
    largest = sum((inverse[i, i] for i in range(Y.nrows())), flint.arb(0))  # ≥ 1/λ
    shift = sum((x * x for x in c.entries()), flint.arb(0)).sqrt()
    growth = (order * largest / (pi * spare * flint.arb(1).exp())) ** (flint.arb(order) / 2)
    return (size * (2 * pi) ** order * 2 ** (order - 1) * (growth + shift**order)).upper()
