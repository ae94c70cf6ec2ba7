"""Fields and quaternion algebras that act on simple abelian varieties."""

from itertools import product

import flint
import numpy as np
import pytest
from support.jacobian_points import fifth_roots, quaternionic

import igl_periods as ip
from igl_periods.jacobians import MatrixLattice, hilbert_symbol
from igl_periods.jacobians.division_algebras import (
    centre_of,
    commute,
    field_of,
    quaternion_constants,
    ramified_places,
    simple_algebra,
)


@pytest.mark.parametrize(("a", "b"), [*product([-1, -3, 2, 5, 6, -7, 15], repeat=2)])
def test_the_product_formula_of_hilbert(a, b):
    """The product of all symbols is 1: an even number of places ramifies."""
    assert len(ramified_places(a, b)) % 2 == 0


@pytest.mark.parametrize("p", [2, 3, 5, 7])
def test_hilbert_symbols(p):
    for a, b in product([-3, -1, 2, 3, 5, 6, 7], repeat=2):
        assert hilbert_symbol(a, b, p) == hilbert_symbol(b, a, p)
        assert hilbert_symbol(a, -a, p) == 1
        assert hilbert_symbol(a, 4 * b, p) == hilbert_symbol(a, b, p)
        assert hilbert_symbol(a, b, p) * hilbert_symbol(a, 5 * b, p) == hilbert_symbol(a, 5, p)


def test_named_quaternion_algebras():
    assert ramified_places(-1, -1) == (0, 2)
    assert ramified_places(-1, 3) == (2, 3)
    assert ramified_places(2, 5) == (2, 5)
    assert ramified_places(4, 7) == ()
    with pytest.raises(ValueError, match="not 0"):
        ramified_places(0, 7)


def test_quaternionic_multiplication_of_discriminant_6():
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(quaternionic(flint.acb(flint.arb(2).log(), flint.arb.pi() / 2)))
    algebra = simple_algebra(ring.lattice)
    assert ring.rank == 4
    assert algebra.kind == "quaternion algebra"
    assert algebra.ramified == (2, 3)
    assert algebra.is_division
    assert ring.name == "quaternion algebra of discriminant 6"
    a, b = quaternion_constants(ring.lattice)
    assert ramified_places(a, b) == (2, 3)
    assert not ring.has_complex_multiplication
    # tr(M_i M_j) is twice the reduced trace; the reduced discriminant of a maximal order is 6.
    assert abs(ring.trace_discriminant) == 2**4 * 6**2


def test_a_matrix_ring_is_no_division_algebra():
    basis = np.zeros((4, 2, 2), dtype=np.int64)
    basis[range(4), [0, 0, 1, 1], [0, 1, 0, 1]] = 1
    algebra = simple_algebra(MatrixLattice(basis))
    assert algebra.is_division is False
    assert centre_of(MatrixLattice(basis)).rank == 1
    assert not commute(basis)


def test_fields():
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(fifth_roots())
    assert field_of(ring.lattice).degree == 4
    assert commute(ring.basis)
    split = MatrixLattice(np.array([np.eye(2), np.diag([1, 0])], dtype=np.int64))
    assert field_of(split) is None
    assert simple_algebra(split).is_division is None
