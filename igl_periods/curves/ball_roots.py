"""Roots and logarithms of complex balls that may meet the negative real axis.

The principal branches jump there, so that a ball around a negative number would have a root with a
radius as large as itself.  Left of the imaginary axis another branch is taken, that of −z times a
root of −1: one of the roots, which is all that is asked for.
"""

from __future__ import annotations

import flint


def root(z: flint.acb, n: int) -> flint.acb:
    """One of the n-th roots of z.

    Examples
    --------
    >>> root(flint.acb(-4), 2)  # 2i
    2.00000000000000j
    """
    if z.real.mid() >= 0:
        return z.root(n)
    return (-z).root(n) * flint.acb(flint.fmpq(1, n)).exp_pi_i()


def logarithm(z: flint.acb) -> flint.acb:
    """One of the logarithms of z."""
    if z.real.mid() >= 0:
        return z.log()
    return (-z).log() + flint.acb(0, flint.arb.pi())
