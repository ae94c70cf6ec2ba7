"""Capacities in balls: square frames by elliptic integrals, random domains within both bounds."""

from fractions import Fraction

import flint
import numpy as np
import pytest
from support.random_domains import ELL, frame, square
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.domains.capacities import capacity_matrix
from igl_periods.domains.capacity_balls import enclosed_capacities
from igl_periods.surfaces import planar_domain


def bowman(outer, inner):
    """The capacity of a square frame (Bowman 1953): 8 K(k)/K(k'), k = (1 − 2λλ')/(1 + 2λλ').

    λ is the modulus with K(λ')/K(λ) = (outer + inner)/(outer − inner).
    """
    ratio = Fraction(outer + inner, outer - inner)
    tau = flint.acb(0, flint.arb(ratio.numerator) / ratio.denominator)
    m = tau.modular_lambda().real
    product = 2 * (m * (1 - m)).sqrt()
    k = (1 - product) / (1 + product)
    K = [flint.acb(x).elliptic_k().real for x in (k**2, 1 - k**2)]
    return 8 * K[0] / K[1]


@pytest.mark.parametrize(("outer", "inner"), [(4, 2), (3, 1)])
def test_square_frames_to_thirty_digits(outer, inner):
    offset = (outer - inner) / 2
    V, F = planar_domain(square(0, 0, outer), [square(offset, offset, inner)], angle=0)
    C = enclosed_capacities(V, F, digits=30)
    assert C.digits >= 30
    with flint.ctx.workprec(200):
        exact = bowman(outer, inner)
        assert C.matrix[1, 1].contains(exact)
        assert C.matrix[0, 1].contains(-exact)
        assert C.matrix[1, 1].rad() < 1e-28
    # Floating point and its bound.
    low, high = capacity_matrix(frame(outer, inner), tolerance=1e-11).entry_bounds
    assert low[1, 1] <= float(exact) <= high[1, 1]


def test_two_holes_without_a_symmetry():
    holes = [ELL / 2 + 0.5 + 0.5j, [3 + 0.5j, 3.5 + 1j, 2.75 + 1.5j]]
    V, F = planar_domain([0, 4, 4.5 + 2j, 1j + 4j], holes, angle=0)
    C = enclosed_capacities(V, F, digits=8)
    assert C.digits >= 8
    midpoint = np.array([[float(x.mid()) for x in row] for row in C.matrix.tolist()])
    low, high = capacity_matrix(V, F, tolerance=1e-6).entry_bounds
    assert np.all((low <= midpoint) & (midpoint <= high))
    for i in range(3):
        assert sum(C.matrix[i, j] for j in range(3)).contains(0)
    assert repr(C).startswith("CapacityEnclosure of 3 loops, ")


def test_one_loop_and_none():
    assert enclosed_capacities([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]).matrix[0, 0] == 0
    with pytest.raises(ip.ComplexError, match="no boundary"):
        enclosed_capacities(*noisy_torus(5, 5, 0.1, 1))
