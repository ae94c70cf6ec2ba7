"""Finite groups as multiplication tables."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.moduli import are_isomorphic, direct_product, group_of_matrices
from igl_periods.moduli.finite_groups import FiniteGroup
from igl_periods.moduli.group_names import (
    alternating,
    cyclic,
    dicyclic,
    linear_group,
    permutation_group,
    semidirect,
    symmetric,
)


def relabelled(group, seed=0):
    """The same group with its elements in another order, the neutral one first."""
    order = np.concatenate([[0], 1 + np.random.default_rng(seed).permutation(group.order - 1)])
    place = np.argsort(order)
    return FiniteGroup(place[group.table[np.ix_(order, order)]])


@pytest.mark.parametrize(
    "group",
    [symmetric(4), dicyclic(6), semidirect(7, 3, 2), direct_product(symmetric(3), cyclic(4))],
)
def test_the_laws_of_a_group(group):
    T, n = group.table, group.order
    assert np.array_equal(T[T], T[:, T])  # (ab)c = a(bc)
    assert np.array_equal(T[0], np.arange(n))
    assert np.array_equal(T[np.arange(n), group.inverse], np.zeros(n))
    assert group.generated(group.generators) == set(range(n))
    assert are_isomorphic(group, relabelled(group))


def test_numbers_of_the_symmetric_group():
    S4 = symmetric(4)
    assert (S4.order, S4.centre_order, S4.derived_order) == (24, 1, 12)
    assert sorted(S4.orders.tolist()) == [1] + 9 * [2] + 8 * [3] + 6 * [4]
    assert sorted(set(S4.class_sizes.tolist())) == [1, 3, 6, 8]
    assert not S4.is_abelian


def test_groups_of_the_same_order_are_told_apart():
    groups = [
        symmetric(4),
        linear_group(3, (1, 1, 0, 1), (1, 0, 1, 1)),
        dicyclic(6),
        semidirect(12, 2, 11),
        direct_product(alternating(4), cyclic(2)),
        direct_product(symmetric(3), cyclic(4)),
        cyclic(24),
    ]
    for i, G in enumerate(groups):
        for j, H in enumerate(groups):
            assert are_isomorphic(G, relabelled(H, j)) == (i == j)


def test_groups_with_the_same_orders_of_elements_are_told_apart():
    """C4 ⋊ C4 and C2 × Q8 have as many elements of each order."""
    first, second = semidirect(4, 4, 3), direct_product(dicyclic(2), cyclic(2))
    assert sorted(first.orders.tolist()) == sorted(second.orders.tolist())
    assert not are_isomorphic(first, second)


def test_isomorphic_groups_of_different_make():
    assert are_isomorphic(linear_group(2, (1, 1, 0, 1), (1, 0, 1, 1)), symmetric(3))
    psl = linear_group(5, (1, 1, 0, 1), (1, 0, 1, 1), projective=True)
    assert are_isomorphic(psl, alternating(5))
    assert are_isomorphic(permutation_group((1, 2, 3, 4, 0), (0, 4, 3, 2, 1)), semidirect(5, 2, 4))


def test_the_quotient_by_an_involution_in_the_centre():
    group = direct_product(symmetric(4), cyclic(2))
    assert are_isomorphic(group.quotient_by(1), symmetric(4))
    quaternions = dicyclic(2)
    minus = next(k for k, order in enumerate(quaternions.orders) if order == 2)
    assert are_isomorphic(quaternions.quotient_by(minus), direct_product(cyclic(2), cyclic(2)))


def test_groups_of_matrices():
    group = ip.symplectic_automorphism_group(ip.surfaces.square_tiled_period_matrix("omega_2"))
    table = group_of_matrices(list(group)).table
    for i, j in np.random.default_rng(0).integers(0, 48, (50, 2)):
        assert np.array_equal(group[int(table[i, j])], group[int(i)] @ group[int(j)])


def test_refusals():
    one, shear = np.eye(2, dtype=np.int64), np.array([[1, 1], [0, 1]])
    with pytest.raises(ValueError, match="not closed under products"):
        group_of_matrices([one, shear])
    with pytest.raises(ValueError, match="not different"):
        group_of_matrices([one, one])
