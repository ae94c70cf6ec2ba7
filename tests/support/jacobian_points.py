"""Period matrices in balls whose endomorphisms are known."""

from dataclasses import replace
from fractions import Fraction

import flint
import numpy as np
from flint import acb, acb_mat, arb

import igl_periods as ip
from igl_periods.complexes.exact_lengths import LengthsByKind
from igl_periods.jacobians import frobenius_basis

L_GLUING = [
    ((0, 1), (1, 3)), ((1, 1), (0, 3)), ((0, 2), (2, 0)),
    ((2, 2), (0, 0)), ((1, 2), (1, 0)), ((2, 1), (2, 3)),
]  # fmt: skip

# Order 3 and 2, and a product of order 7, on the projective line over the field of 8 elements.
MACBEATH = ((1, 2, 0, 6, 5, 7, 8, 4, 3), (0, 4, 6, 8, 1, 7, 2, 5, 3))


def silhol():
    """Eight squares of genus 3: (1 + i)/2 [[2, 1, 1], [1, 2, 1], [1, 1, 2]]."""
    half = acb(0.5, 0.5)
    return acb_mat([[half * (2 if i == j else 1) for j in range(3)] for i in range(3)])


def fifth_roots():
    """y² = x⁵ − 1, whose Jacobian has complex multiplication by the fifth roots of unity."""
    fifth = flint.fmpq(1, 5)
    sin, cos = arb.sin_pi_fmpq(fifth), arb.cos_pi_fmpq(2 * fifth)
    off = acb(-(3 - arb(5).sqrt()) / 4, -sin)
    return acb_mat([[acb(0, 2 * sin), off], [off, acb(-cos, arb.sin_pi_fmpq(2 * fifth))]])


def random_point(g, seed, digits=50):
    """A random point of the Siegel half-space in balls of radius 10^−digits."""
    rng = np.random.default_rng(seed)

    def number():
        return arb(int(rng.integers(0, 1 << 62)) << 62 | int(rng.integers(0, 1 << 62))) / 2**124

    X = [[number() for _ in range(g)] for _ in range(g)]
    B = flint.arb_mat([[number() - arb(0.5) for _ in range(g)] for _ in range(g)])
    Y = B * B.transpose() + flint.arb_mat(np.eye(g).tolist()) / 2
    radius = arb(10) ** -digits
    rows = [[None] * g for _ in range(g)]
    for i in range(g):
        for j in range(i + 1):
            z = acb(arb(X[i][j].mid(), radius), arb(Y[i, j].mid(), radius))
            rows[i][j] = rows[j][i] = z
    return acb_mat(rows)


def rational(q):
    q = Fraction(q)
    return arb(flint.fmpq(q.numerator, q.denominator))


def period_matrix_of(columns, skew):
    """The period matrix of the lattice of some columns with a principal polarisation."""
    U, divisors = frobenius_basis(skew)
    assert set(divisors) == {1}
    W = acb_mat(np.array(columns, dtype=object).T.tolist()) * acb_mat(flint.fmpz_mat(U.tolist()))
    g = len(columns[0])
    L1, L2 = (acb_mat([[W[i, k + j] for j in range(g)] for i in range(g)]) for k in (0, g))
    Pi = L1.solve(L2)
    return (Pi + Pi.transpose()) / 2


def quaternionic(z):
    """An abelian surface on which a maximal order of the quaternions (−1, 3) acts.

    The lattice is O (z, 1)ᵀ for O = ⟨1, i, j, (1 + i + j + ij)/2⟩, i² = −1, j² = 3, and the form
    tr(μ x ȳ), μ = i/2 − j/6.
    """
    half, root = Fraction(1, 2), arb(3).sqrt()
    order = [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (half,) * 4]

    def product(a, b):
        return (
            a[0] * b[0] - a[1] * b[1] + 3 * a[2] * b[2] + 3 * a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] - 3 * a[2] * b[3] + 3 * a[3] * b[2],
            a[0] * b[2] + a[2] * b[0] - a[1] * b[3] + a[3] * b[1],
            a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1],
        )

    def column(a):
        one, i, j, k = (rational(x) for x in a)
        return [(one + j * root) * z + (k * root - i), (i + k * root) * z + (one - j * root)]

    mu = (0, half, Fraction(-1, 6), 0)
    skew = [
        [int(2 * product(product(mu, x), (y[0], -y[1], -y[2], -y[3]))[0]) for y in order]
        for x in order
    ]
    return period_matrix_of([column(x) for x in order], np.array(skew))


def unequal_arms():
    """An L of three rectangles whose arms, ∛2 − 1 and ∜3 − 1, have no relation to each other."""
    a, b = (lambda: arb(2).root(3) - 1), (lambda: arb(3).root(4) - 1)
    one = lambda: arb(1)  # noqa: E731
    sides = [(one, one), (a, one), (one, b)]
    formulas = [
        formula
        for w, h in sides
        for formula in (w, h, lambda w=w, h=h: (w() ** 2 + h() ** 2).sqrt())
    ]
    sizes = [[float(w()), float(h())] for w, h in sides]
    K = ip.surfaces.glued_rectangles(sizes, L_GLUING)
    return replace(K, exact_lengths=LengthsByKind(K.exact_lengths.kind, tuple(formulas)))
