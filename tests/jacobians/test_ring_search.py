"""Endomorphisms of whatever a period matrix is known by."""

import warnings

import flint
import numpy as np
import pytest
from support.enclosed_surfaces import generic_genus_two
from support.jacobian_points import MACBEATH, random_point, unequal_arms

import igl_periods as ip
from igl_periods.jacobians.ring_search import in_marking_of, known_bits


@pytest.mark.parametrize(("g", "seed"), [*((2, seed) for seed in range(8)), (3, 0), (3, 1)])
def test_random_points_have_no_endomorphisms_and_no_automorphisms(g, seed):
    Pi = random_point(g, seed)
    assert ip.endomorphisms(Pi).rank == 1
    assert ip.symplectic_automorphism_group(Pi).order == 2


@pytest.mark.slow
@pytest.mark.parametrize("g", [2, 3])
def test_two_hundred_random_points(g):
    for seed in range(1000, 1200):
        Pi = random_point(g, seed)
        ring = ip.endomorphisms(Pi)
        assert ring.rank == 1
        assert ring.evidence.excluded > 10
        assert ip.symplectic_automorphism_group(Pi).order == 2


def test_an_l_with_unequal_arms_has_only_the_integers():
    e = ip.enclose(unequal_arms(), digits=20)
    ring = ip.endomorphisms(e)
    assert (ring.rank, ring.name) == (1, "Q")
    assert ring.evidence.excluded > 4
    assert not e.reduced().recognize(degree=10).complete


def test_an_enclosure_is_checked_with_more_digits():
    e = ip.enclose(ip.surfaces.square_tiled_surface("omega_1"), digits=15).reduced()
    ring = ip.endomorphisms(e, check_digits=25)
    assert ring.rank == 8
    assert ring.evidence.digits < 18
    assert ring.evidence.checked_digits >= 25
    assert ring.matrix.overlaps(e.matrix)


def test_enclosures_in_the_same_marking():
    e = ip.enclose(generic_genus_two(), digits=12)
    # A random cone metric: nothing of it is recognised, and it has no endomorphisms.
    assert not any(x for row in e.reduced().recognize().entries for x in row)
    assert ip.endomorphisms(e).rank == 1
    gamma = np.kron(np.array([[0, 1], [-1, 1]]), np.eye(2, dtype=np.int64))
    moved = e.change_basis(gamma)
    assert in_marking_of(e, moved).matrix.overlaps(moved.matrix)
    assert in_marking_of(moved, moved) is moved
    other = ip.enclose(ip.surfaces.regular_map_surface("bolza"), digits=5)
    assert in_marking_of(other, e).genus == 2


def test_period_matrices_and_arrays():
    pm = ip.period_matrix(ip.surfaces.square_tiled_surface("omega_2", 2), tolerance=1e-10)
    assert ip.endomorphisms(pm).rank == 8
    assert ip.endomorphisms(ip.surfaces.regular_map_period_matrix("klein")).rank == 18


@pytest.mark.slow
def test_the_surface_of_fricke_and_macbeath():
    """Genus 7, 168 triangles {3, 7}: E⁷ with j(E) = 1792, seven times."""
    e = ip.enclose(ip.surfaces.regular_map(*MACBEATH), digits=30)
    factors = ip.jacobian_factors(e.reduced())
    assert factors.ring.rank == 49
    assert factors.ring.name == "M₇(Q)"
    assert str(factors) == "E⁷"
    assert [factor.exact_j.polynomial for factor in factors.elliptic_curves] == [(-1792, 1)] * 7
    assert all(factor.exact_j.evidence.left_over > 20 for factor in factors.elliptic_curves)
    group = ip.symplectic_automorphism_group(e.reduced())
    assert (group.order, group.name) == (1008, "PSL(2,8) x C2")


def test_known_bits():
    radius = flint.arb(0, 2.0**-40)
    ball = flint.acb(radius, 1 + radius)
    assert known_bits(flint.acb_mat([[ball]]), 100) in (39, 40)
    assert known_bits(flint.acb_mat([[flint.acb(0, 1)]]), 100) == 100


def test_refusals():
    with pytest.raises(ValueError, match="check_digits needs a PeriodEnclosure"):
        ip.endomorphisms([[1j]], check_digits=50)
    with pytest.raises(ValueError, match="genus 1 to 7, not 8"):
        ip.endomorphisms(1j * np.eye(8))
    with pytest.raises(ip.NotASiegelPointError):
        ip.endomorphisms([[-1j]])
    wide = flint.acb(flint.arb(0, 1e-3), flint.arb(1, 1e-3))
    with pytest.raises(ValueError, match="too few to tell"):
        ip.endomorphisms(flint.acb_mat([[wide]]))


def test_no_warnings():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert ip.endomorphisms([[1j]]).rank == 2
