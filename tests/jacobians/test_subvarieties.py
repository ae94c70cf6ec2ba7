"""Abelian subvarieties as sublattices."""

import flint
import numpy as np
from support.enclosed_surfaces import l_shape_matrix
from support.jacobian_points import random_point

import igl_periods as ip
from igl_periods.jacobians import Subvariety, image_of, rosati_adjoint
from igl_periods.jacobians.subvarieties import whole
from igl_periods.symplectic import standard_form


def golden():
    return l_shape_matrix((1 + flint.arb(5).sqrt()) / 2)


def test_the_whole_jacobian():
    Pi = random_point(2, 0)
    tau, divisors = whole(2).period_matrix(Pi)
    assert divisors == (1, 1)
    assert tau.overlaps(Pi)
    assert repr(whole(2)) == "Subvariety(dimension 2 of 2)"
    assert whole(2).complement().dimension == 0


def test_idempotents_are_symmetric_and_complementary():
    for part in [p for parts in ip.endomorphisms(golden()).simple_parts for p in parts]:
        e, n = part.idempotent()
        assert np.array_equal(e @ e, n * e)
        assert np.array_equal(rosati_adjoint(e), e)
        assert part.exponent == n
        other, m = part.complement().idempotent()
        assert np.array_equal(m * e + n * other, m * n * np.eye(4))
        # The image of n e is the subvariety again.
        same = image_of(e)
        assert flint.fmpz_mat(np.hstack([same.lattice, part.lattice]).tolist()).rank() == 2


def test_the_type_of_complementary_subvarieties_is_the_same():
    ring = ip.endomorphisms(golden())
    part = ring.simple_parts[0][0]
    Pi = golden()
    assert part.period_matrix(Pi)[1] == part.complement().period_matrix(Pi)[1] == (2,)


def test_the_diagonal_of_a_product():
    """E × E: the diagonal has twice the polarisation, and the same τ."""
    tau = flint.acb(0.25, 1.5)
    Pi = flint.acb_mat([[tau, 0], [0, tau]])
    diagonal = Subvariety(np.array([[1, 0], [1, 0], [0, 1], [0, 1]]))
    twice, divisors = diagonal.period_matrix(Pi)
    assert divisors == (2,)
    assert twice[0, 0].overlaps(2 * tau)
    assert diagonal.meets(diagonal.complement(), np.eye(4, dtype=np.int64)[None]) is False


def test_forms_are_restricted():
    part = Subvariety(np.array([[1, 0], [0, 0], [0, 3], [0, 1]]))
    assert np.array_equal(part.form, 3 * standard_form(1))
    assert part.denominator == 3
