from fractions import Fraction

import flint
import numpy as np
from flint import arb

from igl_periods.complexes import by_kind, circumradius, lattice_length, root_of


def test_each_edge_has_the_length_of_its_kind():
    edge = np.array([[0, 1, 2], [2, 1, 3]])
    kind = np.array([[0, 1, 1], [1, 1, 0]])
    lengths = by_kind(edge, kind, (root_of(Fraction(2)), root_of(Fraction(9, 4))))(200)
    assert [float(x) for x in lengths] == [2**0.5, 1.5, 1.5, 2**0.5]
    with flint.ctx.workprec(200):
        assert (lengths[0] * lengths[0]).contains(2)


def test_formulas():
    with flint.ctx.workprec(200):
        # A hexagon is made of equilateral triangles; |1 + τ|² for τ = ½ + i.
        assert circumradius(6, 2).contains(arb(0.5))
        length = lattice_length(0.5 + 1j, Fraction(1), Fraction(1))
        assert (length * length).contains(arb(3.25))
