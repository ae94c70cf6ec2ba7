r"""Balls as integers and as text, and their size; what is read contains what was written.

A ball has a midpoint m 2^e and a radius of the same form, four integers in all.  As text it is
``[midpoint +/- radius]`` in decimals, rounded outwards: the text denotes a ball that contains the
original one.
"""

from __future__ import annotations

import flint

Arb = flint.arb

# The exponent of 0.
_LEAST_EXPONENT = -(10**9)


def to_integers(x: Arb) -> tuple[int, int, int, int]:
    """Mantissa and exponent of the midpoint and of the radius."""
    mantissa, exponent = x.mid().man_exp()
    radius, radius_exponent = x.rad().man_exp()
    return int(mantissa), int(exponent), int(radius), int(radius_exponent)


def from_integers(mantissa: int, exponent: int, radius: int, radius_exponent: int) -> Arb:
    """A ball that contains the one that :func:`to_integers` was given, and hardly more."""
    return Arb(Arb((mantissa, exponent)), Arb((radius, radius_exponent)))


def exponent_of(x: Arb) -> int:
    """The least e with |midpoint| < 2^e; very small for 0."""
    mantissa, exponent = x.mid().man_exp()
    return int(exponent) + int(mantissa).bit_length() if mantissa else _LEAST_EXPONENT


def matrix_to_integers(A: flint.acb_mat) -> list[list[tuple[int, ...]]]:
    """Rows of a matrix of complex balls, each as eight integers: they can be pickled."""
    rows = A.tolist() if A.nrows() else []
    return [[(*to_integers(z.real), *to_integers(z.imag)) for z in row] for row in rows]


def matrix_from_integers(rows: list[list[tuple[int, ...]]]) -> flint.acb_mat:
    """A matrix of balls that contain those that :func:`matrix_to_integers` was given."""
    if not rows:
        return flint.acb_mat(0, 0)
    return flint.acb_mat(
        [[flint.acb(from_integers(*n[:4]), from_integers(*n[4:])) for n in row] for row in rows]
    )


def ball_in_text(x: Arb, digits: int) -> str:
    """A decimal enclosure of a ball, with so many digits."""
    return str(x.str(max(digits, 1), more=True))


def ball_from_text(text: str) -> Arb:
    """A ball that contains all that such a text denotes."""
    return Arb(text)
