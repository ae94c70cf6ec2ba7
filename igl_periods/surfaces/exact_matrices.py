r"""Exact period matrices of named surfaces in balls, to any number of digits.

Each function computes at the working precision of python-flint, ``flint.ctx.prec``, and its balls
contain the exact entries, in the same marking as the floating-point matrix of the surface: square
roots; roots of unity for y² = xⁿ − 1; values of beta and hypergeometric functions for Lawson's
surfaces; and for Bring's curve the point τ = ½ + iy at which Klein's invariant has the value
j(τ) = −29³ 5 / 2⁵, enclosed by a change of sign.

References
----------
Braden, Northover, "Bring's curve: its period matrix and the vector of Riemann constants" (2012).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

import flint
import numpy as np

from igl_periods.arrays import Ints

Rows: TypeAlias = Sequence[Sequence[float | flint.arb]]

# Sign changes are looked for at so many bits beyond the working precision.
_GUARD_BITS = 40
_BRING = [[4, 1, -1, 1], [1, 4, 1, -1], [-1, 1, 4, 1], [1, -1, 1, 4]]
_BRING_START = "0.18667646246280991"


def square_torus() -> flint.acb_mat:
    """τ = i."""
    return _matrix([[0]], [[1]])


def hexagonal_torus() -> flint.acb_mat:
    """τ = exp(πi/3)."""
    return _matrix([[0.5]], [[flint.arb(3).sqrt() / 2]])


def omega_1() -> flint.acb_mat:
    """The L-shaped origami."""
    third = flint.arb(1) / 3
    return _matrix(np.zeros((2, 2)).tolist(), [[5 * third, -4 * third], [-4 * third, 5 * third]])


def bolza() -> flint.acb_mat:
    """y² = x⁵ − x."""
    third, root = flint.arb(1) / 3, flint.arb(2).sqrt() / 3
    return _matrix(
        [[-2 * third, third], [third, -2 * third]], [[2 * root, -root], [-root, 2 * root]]
    )


def l_shape(x: flint.arb) -> flint.acb_mat:
    """A unit square with two arms of length x − 1: i/(2x − 1) times a real matrix."""
    scale = 1 / (2 * x - 1)
    a, b = scale * (2 * x * x - 2 * x + 1), -scale * 2 * x * (x - 1)
    return _matrix(np.zeros((2, 2)).tolist(), [[a, b], [b, a]])


def golden_l() -> flint.acb_mat:
    """The L-shape of x = (1 + √5)/2."""
    return l_shape((1 + flint.arb(5).sqrt()) / 2)


def rational_l(numerator: int, denominator: int) -> flint.acb_mat:
    """The L-shape of a rational x."""
    return l_shape(flint.arb(flint.fmpq(numerator, denominator)))


def polygon(g: int, basis: Ints) -> flint.acb_mat:
    """y² = x^{2g+1} − x, in an integer symplectic basis of the sides of the regular 4g-gon."""
    periods = flint.acb_mat(
        [
            [root_of_unity(Fraction((2 * j - 1) * k, 4 * g)) for k in range(2 * g)]
            for j in range(1, g + 1)
        ]
    )
    a, b = (integer_balls(half) for half in (basis[:g].T, basis[g:].T))
    return symmetrised((periods * a).solve(periods * b))


def klein() -> flint.acb_mat:
    """x³y + y³z + z³x = 0."""
    root = flint.arb(7).sqrt() / 4
    real = [[-0.25 if i == j else 0.5 for j in range(3)] for i in range(3)]
    return _matrix(real, [[root * (i == j) for j in range(3)] for i in range(3)])


def fermat() -> flint.acb_mat:
    """x⁴ + y⁴ + z⁴ = 0."""
    return _matrix(
        [[1, -0.5, 0], [-0.5, 0.5, 0.5], [0, 0.5, 0]],
        [[1, -0.5, 0], [-0.5, 1, -0.5], [0, -0.5, 1]],
    )


def bring() -> flint.acb_mat:
    """Σ x_i = Σ x_i² = Σ x_i³ = 0."""
    y = _root_of_j(flint.arb(_BRING_START), flint.fmpq(-(29**3) * 5, 2**5))
    tau = flint.acb(0.5, y)
    return flint.acb_mat([[tau * x for x in row] for row in _BRING])


def binomial(n: int, basis: Ints) -> flint.acb_mat:
    """y² = xⁿ − 1, in an integer symplectic basis of the curves c_0, …, c_{2g−1}."""
    g = len(basis) // 2
    periods = flint.acb_mat(
        [[root_of_unity(Fraction(j * k, n)) for k in range(2 * g)] for j in range(1, g + 1)]
    )
    a, b = (integer_balls(half) for half in (basis[:g].T, basis[g:].T))
    return symmetrised((periods * a).solve(periods * b))


def lawson_integral(a: int, b: int, M: int, n: int) -> flint.arb:
    """∫₀¹ ((1 + x^M) / (1 − x^M))^{b/n} x^{a−1} dx / (1 + x^M), by Euler's integral."""
    p, q = flint.arb(a) / M, flint.arb(n - b) / n
    beta = p.gamma() * q.gamma() / (p + q).gamma()
    return beta * flint.arb(-1).hypgeom_2f1(q, p, p + q) / M


def root_of_unity(turn: Fraction) -> flint.acb:
    """exp(2πi · turn)."""
    return flint.acb(2 * flint.arb(flint.fmpq(turn.numerator, turn.denominator))).exp_pi_i()


def integer_balls(matrix: Ints) -> flint.acb_mat:
    """A matrix of integers."""
    return flint.acb_mat(flint.fmpz_mat(matrix.tolist()))


def symmetrised(Pi: flint.acb_mat) -> flint.acb_mat:
    """The mean of a matrix and its transpose: both contain the exact one, which is symmetric."""
    return (Pi + Pi.transpose()) / 2


def _matrix(real: Rows, imag: Rows) -> flint.acb_mat:
    rows = zip(real, imag)
    return flint.acb_mat([[flint.acb(x, y) for x, y in zip(*row)] for row in rows])


def _root_of_j(y: flint.arb, value: flint.fmpq) -> flint.arb:
    """The y near a start with j(½ + iy) = value, by secants, then a change of sign."""
    bits = flint.ctx.prec

    def excess(x: flint.arb) -> flint.arb:
        return flint.acb(0.5, x).modular_j().real - value

    with flint.ctx.workprec(bits + _GUARD_BITS):
        one, two = y.mid(), (y + flint.arb(2) ** -40).mid()
        tiny = flint.arb(2) ** (-bits - _GUARD_BITS // 2)
        while not abs(two - one) < tiny:
            f, g = excess(one), excess(two)
            one, two = two, (two - g * (two - one) / (g - f)).mid()
        radius = flint.arb(2) ** -bits
        low, high = excess(two - radius), excess(two + radius)
        # j is real on this line, and continuous.
        assert low * high < 0
    return two + flint.arb(0, radius)
