"""Doubles in balls: strips of 4 × 3 rectangles with diagonals 5, all lengths exact."""

import flint
import numpy as np

import igl_periods as ip

RECTANGLE = [[3.0, 5.0, 4.0], [4.0, 3.0, 5.0]]


def strip(n, turned=False):
    """n rectangles in a row, the last one glued to the first, turned over if wanted."""
    twin = -np.ones((2 * n, 3), dtype=np.int64)
    same = np.zeros((2 * n, 3), dtype=bool)
    for i in range(n):
        lower, upper, onward = 2 * i, 2 * i + 1, 2 * ((i + 1) % n) + 1
        twin[lower, 1], twin[upper, 2] = 3 * upper + 2, 3 * lower + 1
        twin[lower, 0], twin[onward, 1] = 3 * onward + 1, 3 * lower
        same[lower, 0] = same[onward, 1] = turned and i == n - 1
    return ip.DeltaComplex.from_gluing(np.tile(RECTANGLE, (n, 1)), twin, same)


def test_a_cylinder_is_a_rectangular_torus():
    # Circumference 8 and height 3: τ = 2i · 3/8, or 4i/3.
    enclosed = ip.enclose(ip.double(strip(2)), digits=25).reduced()
    assert enclosed.digits >= 25
    with flint.ctx.workprec(200):
        assert enclosed.contains(flint.acb_mat([[flint.acb(0, flint.arb(4) / 3)]]))


def test_a_moebius_band_is_a_rhombic_torus():
    # Core 12 and height 3: τ = 1/2 + 3i/24; compared by Klein's j.
    enclosed = ip.enclose(ip.double(strip(3, turned=True)), digits=25)
    tau = flint.acb(flint.arb(1) / 2, flint.arb(1) / 8)
    assert enclosed.digits >= 25
    with flint.ctx.workprec(200):
        j = enclosed.matrix[0, 0].modular_j()
        assert j.overlaps(tau.modular_j())
        assert float(abs(j).mid()) > 1e3
