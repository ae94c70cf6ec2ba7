r"""The action of the modular group on the Siegel upper half-space, right to rounding.

:math:`\gamma \cdot \Pi = (a \Pi + b)(c \Pi + d)^{-1}` loses digits in plain floating point, in the
sums and in the inverse.  Up to a few dozen rows it is computed in ball arithmetic, with as many
digits as it takes until the balls are smaller than the spacing of floating-point numbers.

Ball arithmetic is O(g³) too, but a hundred times slower than products in floating point; so larger
matrices are computed there and corrected.  Write N = aΠ + b, Q = cΠ + d, and Z for an approximation
of γ·Π.  The *residual* N − ZQ is a small difference of large numbers, and the correction

.. math:: Z \to Z + (N - ZQ)\, Q^{-1}

is as good as the residual is, while the inverse need not be.  Π and Z are split into leading and
trailing bits; products of the leading ones are sums of integers below 2⁵³, exact in whatever order
they are added, and the trailing ones are so small that rounding does not matter.  If a correction
is a fraction ε of Z, then the next one would be about ε²: so one is enough, and its size shows it.
Where it is too large the balls have to do it.
"""

from __future__ import annotations

from typing import NamedTuple

import flint
import numpy as np

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.errors import NotASiegelPointError

# Up to this genus the action is computed in ball arithmetic.
_BALL_GENUS = 40
# Half the digits of a double: a correction below it leaves an error below rounding.
_LARGEST_CORRECTION = 2.0**-27
# Sums of so many bits, and one more for rounding, are exact.
_EXACT_BITS = 51


def moebius(gamma: Ints, Pi: Complexes) -> Complexes:
    """γ · Π for arguments that are known to be valid; every entry is right to rounding.

    O(g³).

    Raises
    ------
    NotASiegelPointError
        If Π is too close to the boundary of the half-space.
    """
    if len(Pi) == 0:
        return Pi.copy()
    corrected = _in_floats(gamma, Pi) if len(Pi) > _BALL_GENUS else None
    return _in_balls(gamma, Pi) if corrected is None else corrected


def _blocks(gamma: Ints) -> tuple[Ints, Ints, Ints, Ints]:
    g = len(gamma) // 2
    return gamma[:g, :g], gamma[:g, g:], gamma[g:, :g], gamma[g:, g:]


# ---- Ball arithmetic ----


def _in_balls(gamma: Ints, Pi: Complexes) -> Complexes:
    a, b, c, d = (flint.acb_mat(flint.fmpz_mat(block.tolist())) for block in _blocks(gamma))
    for doubling in range(8):
        with flint.ctx.workprec(96 << doubling):
            P = flint.acb_mat(Pi.tolist())
            numerator, denominator = (a * P + b).transpose(), (c * P + d).transpose()
            try:
                result = _rounded(denominator.solve(numerator))
            except ZeroDivisionError:
                continue
        if result is not None:
            return 0.5 * (result + result.T)
    raise NotASiegelPointError(
        "γ · Π cannot be computed: Π is too close to the boundary of the Siegel upper half-space"
    )


def _rounded(M: flint.acb_mat) -> Complexes | None:
    """The midpoints as an array, or None where the balls are larger than rounding."""
    entries = M.entries()
    middle = np.array([complex(z) for z in entries]).reshape(M.nrows(), M.ncols())
    scale = min(float(np.abs(np.diag(middle)).min()), 1.0)
    sharp = all(float(z.rad()) <= 2.0**-56 * scale for z in entries)
    return middle if sharp and np.isfinite(middle).all() else None


# ---- Floating point, corrected ----


class _Split(NamedTuple):
    """A matrix as the sum of leading bits and what remains."""

    high: Complexes
    low: Complexes


def _in_floats(gamma: Ints, Pi: Complexes) -> Complexes | None:
    """γ · Π, or None where one correction is not enough."""
    a, b, c, d = (block.astype(np.float64) for block in _blocks(gamma))
    N, Q = _affine(a, b, Pi), _affine(c, d, Pi)
    if N is None or Q is None:
        return None
    try:
        inverse = np.linalg.inv(Q.high + Q.low)
    except np.linalg.LinAlgError:
        return None
    Z: Complexes = (N.high + N.low) @ inverse
    if not np.isfinite(Z).all():
        return None
    correction = _residual(N, Z, Q) @ inverse
    scale = min(float(np.abs(np.diag(Z)).min()), 1.0)
    if not np.abs(correction).max() <= _LARGEST_CORRECTION * scale:
        return None
    Z += correction
    return np.asarray(0.5 * (Z + Z.T))


def _affine(A: Floats, B: Floats, Pi: Complexes) -> _Split | None:
    """A Π + B, A and B integer, with an exact leading part; None where B is too small for one."""
    sums = float(np.abs(A).sum(axis=1).max()) * _largest(Pi) + float(np.abs(B).max())
    unit = _unit(sums, _EXACT_BITS)
    if unit > 1.0:
        return None
    high = _rounded_to(unit, Pi)
    low = Pi - high
    # A real matrix times a complex one is two products of real ones, not four.
    return _Split((A @ high.real + B) + 1j * (A @ high.imag), A @ low.real + 1j * (A @ low.imag))


def _residual(N: _Split, Z: Complexes, Q: _Split) -> Complexes:
    """N − Z Q with many more digits than a product in floating point has."""
    bits = (_EXACT_BITS - int(np.ceil(np.log2(2 * len(Z))))) // 2
    Z_high = _rounded_to(_unit(_largest(Z), bits), Z)
    Q_high = _rounded_to(_unit(_largest(Q.high), bits), Q.high)
    Q_low = (Q.high - Q_high) + Q.low
    small = Z_high @ Q_low + (Z - Z_high) @ (Q_high + Q_low)
    return ((N.high - Z_high @ Q_high) + N.low) - small


def _largest(M: Complexes) -> float:
    return max(float(np.abs(M.real).max()), float(np.abs(M.imag).max()))


def _unit(largest: float, bits: int) -> float:
    """A power of 2 of which numbers up to ``largest`` hold at most 2^bits."""
    return float(np.ldexp(1.0, int(np.ceil(np.log2(largest))) - bits))


def _rounded_to(unit: float, M: Complexes) -> Complexes:
    return np.asarray(unit * np.rint(M / unit))
