r"""The action of the modular group on balls, and what else is asked of matrices of balls.

γ · Π = (aΠ + b)(cΠ + d)⁻¹ is computed in ball arithmetic, so that the result contains γ · Π for
every matrix Π in the balls.  The energies G of Π (:mod:`igl_periods.symplectic`) follow from it in
the same way.
"""

from __future__ import annotations

from typing import Any

import flint

from igl_periods.arrays import Ints
from igl_periods.errors import NotASiegelPointError

Arb = flint.arb
ArbMat = flint.arb_mat


def moved_balls(gamma: Ints, Pi: flint.acb_mat, bits: int) -> flint.acb_mat:
    """γ · Π for γ in Sp(2g, Z), in balls.

    Raises
    ------
    NotASiegelPointError
        If the balls are so large that nothing is known of it.
    """
    g = Pi.nrows()
    if g == 0:
        return Pi
    a, b = (_integers(block) for block in (gamma[:g, :g], gamma[:g, g:]))
    c, d = (_integers(block) for block in (gamma[g:, :g], gamma[g:, g:]))
    with flint.ctx.workprec(bits):
        numerator, denominator = (a * Pi + b).transpose(), (c * Pi + d).transpose()
        try:
            moved = denominator.solve(numerator)
        except ZeroDivisionError as error:
            raise _too_large("γ · Π") from error
        # The exact matrix is symmetric, so that both of two mirrored balls contain its entry.
        return (moved + moved.transpose()) / 2


def energy_balls(Pi: flint.acb_mat, bits: int) -> ArbMat:
    """The energy matrix G of Π = X + iY, (2g, 2g), in balls.

    Raises
    ------
    NotASiegelPointError
        If Y is not invertible for all matrices in the balls.
    """
    with flint.ctx.workprec(bits):
        X, Y = Pi.real, Pi.imag
        try:
            inverse = Y.inv()
        except ZeroDivisionError as error:
            raise _too_large("the energies") from error
        mixed = -1 * (X * inverse)
        first = Y + X * inverse * X.transpose()
        upper = zip(first.tolist(), mixed.tolist())
        lower = zip(mixed.transpose().tolist(), inverse.tolist())
        G = ArbMat([[*left, *right] for left, right in (*upper, *lower)])
        return (G + G.transpose()) / 2


def cholesky(A: ArbMat) -> ArbMat | None:
    """The lower triangular L with A = L Lᵀ, in balls; None if A is not certainly definite."""
    n = A.nrows()
    L = [[Arb(0)] * n for _ in range(n)]
    for i in range(n):
        for j in range(i + 1):
            rest = A[i, j] - sum((x * y for x, y in zip(L[i][:j], L[j][:j])), Arb(0))
            if i > j:
                L[i][j] = rest / L[j][j]
            elif rest > 0:
                L[i][i] = rest.sqrt()
            else:
                return None
    return ArbMat(L)


def _integers(block: Any) -> flint.acb_mat:
    return flint.acb_mat(flint.fmpz_mat(block.tolist()))


def _too_large(what: str) -> NotASiegelPointError:
    return NotASiegelPointError(
        f"the balls are so large that nothing is known of {what}: ask for more digits, or reduce "
        "the matrix where it is known better"
    )
