"""Forms that are eigenforms of real multiplication: L(λ), after McMullen."""

import pickle
from math import isqrt

import flint
import numpy as np
import pytest
from flint import acb, arb
from support.enclosed_surfaces import l_shape_matrix

import igl_periods as ip


def square_root(n, d=1):
    return lambda: (1 + (arb(n) / d).sqrt()) / 2


EIGENFORMS = {  # λ = (1 + √d)/2 and the discriminant of the order
    "golden": (square_root(5), "Q(√5)", 5),
    "d = 2": (square_root(2), "Q(√2)", 8),
    "d = 3": (square_root(3), "Q(√3)", 12),
    "d = 13": (square_root(13), "Q(√13)", 13),
    "d = 7/3": (square_root(7, 3), "Q(√21)", 21),
}
RATIONAL = {
    "5/4": lambda: arb(5) / 4,
    "3/2": lambda: arb(3) / 2,
    "2": lambda: arb(2),
    "3": lambda: arb(3),
}
OTHERS = {
    "√2": lambda: arb(2).sqrt(),
    "1 + √2": lambda: 1 + arb(2).sqrt(),
    "∛2": lambda: arb(2).root(3),
    "π": lambda: arb.pi(),
}


def dz_of_l_shape(arm):
    """The endomorphisms of L(λ) with dz as eigenform; its a-periods are λ and λ − 1."""
    ring = ip.endomorphisms(l_shape_matrix(arm))
    return ip.eigenform_ring(ring, [acb(arm), acb(arm - 1)])


@pytest.mark.parametrize("name", EIGENFORMS)
def test_dz_is_an_eigenform_of_real_multiplication(name):
    arm, field, discriminant = EIGENFORMS[name]
    with flint.ctx.workdps(50):
        found = dz_of_l_shape(arm())
    assert str(found.real_multiplication) == field
    assert found.discriminant % discriminant == 0
    # The order may be smaller than the ring of integers, by an index.
    index = isqrt(found.discriminant // discriminant)
    assert found.discriminant == discriminant * index**2
    # There E, τ = i √d, has complex multiplication.
    assert found.ring.rank == 8
    assert not found.splits


def test_golden_l_has_the_maximal_order():
    with flint.ctx.workdps(50):
        found = dz_of_l_shape(EIGENFORMS["golden"][0]())
    assert found.discriminant == 5
    assert repr(found) == "EigenformRing(rank 4, real multiplication Q(√5))"


@pytest.mark.parametrize("name", RATIONAL)
def test_square_tiled_surfaces_cover_a_torus(name):
    with flint.ctx.workdps(50):
        found = dz_of_l_shape(RATIONAL[name]())
    assert found.splits
    assert found.real_multiplication is None


@pytest.mark.parametrize("name", OTHERS)
def test_dz_is_no_eigenform_otherwise(name):
    """Only the rotation by 90°, an automorphism of every L(λ), has dz as eigenform: Z[i]."""
    with flint.ctx.workdps(50):
        found = dz_of_l_shape(OTHERS[name]())
    assert found.real_multiplication is None
    assert not found.splits
    assert found.symmetric.rank == 1
    assert found.rank == 2
    turn = next(M for M in found.lattice.basis if np.trace(M) == 0)
    assert np.array_equal(turn @ turn, -np.eye(4))
    assert (found.eigenvalue(turn) ** 2).overlaps(acb(-1))
    assert found.ring.name == "M₂(Q)"


def test_eigenvalues():
    with flint.ctx.workdps(50):
        found = dz_of_l_shape(EIGENFORMS["golden"][0]())
        s = next(
            M for M in found.symmetric.basis if M.any() and not (M == M[0, 0] * (M != 0)).all()
        )
        eigenvalue = ip.recognize(found.eigenvalue(s))
    assert eigenvalue.degree <= 2
    assert eigenvalue.is_real


def test_any_form_is_an_eigenform_on_a_torus():
    ring = ip.endomorphisms([[1j]])
    found = ip.eigenform_ring(ring, [1])
    assert found.rank == 2
    assert found.real_multiplication is None


def test_refusals():
    ring = ip.endomorphisms([[1j, 0], [0, 2j]])
    with pytest.raises(ValueError, match="has 2 a-periods"):
        ip.eigenform_ring(ring, [1])
    with pytest.raises(ValueError, match="all a-periods may be 0"):
        ip.eigenform_ring(ring, [0, 0])


def test_results_pickle():
    with flint.ctx.workdps(50):
        found = dz_of_l_shape(EIGENFORMS["golden"][0]())
    again = pickle.loads(pickle.dumps(found))
    assert str(again.real_multiplication) == "Q(√5)"
    assert all(z.overlaps(w) for z, w in zip(again.form, found.form, strict=True))
