"""Jacobians up to isogeny."""

import flint
import numpy as np
import pytest
from support.enclosed_surfaces import l_shape_matrix
from support.jacobian_points import fifth_roots, quaternionic, silhol

import igl_periods as ip
from igl_periods.jacobians.splitting import minimal_polynomial, short_elements, split
from igl_periods.jacobians.subvarieties import whole
from igl_periods.surfaces.exact_matrices import bring, klein

SPLIT = {
    "L": (lambda: l_shape_matrix(flint.arb(2).root(3)), [1, 1]),
    "Silhol": (silhol, [1, 1, 1]),
    "Klein": (klein, [1, 1, 1]),
    "Bring": (bring, [1, 1, 1, 1]),
    "y² = x⁵ − 1": (fifth_roots, [2]),
    "quaternions": (lambda: quaternionic(flint.acb(0.1, flint.arb.pi())), [2]),
}


@pytest.mark.parametrize("name", SPLIT)
def test_dimensions_and_orthogonality(name):
    make, dimensions = SPLIT[name]
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(make())
    parts = split(whole(ring.genus), ring.symmetric.basis)
    assert [part.dimension for part in parts] == dimensions
    total = sum(p.idempotent()[0] * (5040 // p.exponent) for p in parts)
    assert np.array_equal(total, 5040 * np.eye(2 * ring.genus))


def test_all_factors_of_a_power_are_isogenous():
    with flint.ctx.workdps(50):
        assert [len(parts) for parts in ip.endomorphisms(bring()).simple_parts] == [4]
        two = flint.acb_mat([[flint.acb(0, 1), 0], [0, flint.acb(0, flint.arb.pi())]])
        assert [len(parts) for parts in ip.endomorphisms(two).simple_parts] == [1, 1]


def test_short_elements_lie_in_the_lattice():
    ring = ip.endomorphisms(silhol())
    for M in list(short_elements(ring.lattice, 30))[::7]:
        assert ring.contains(M)


def test_minimal_polynomials():
    M = np.diag([2, 2, 3])
    assert minimal_polynomial(M) == flint.fmpz_poly([6, -5, 1])
