"""Cochains after flips: closed, in their classes, and the same whatever is carried with them."""

import numpy as np
from scipy.sparse import csr_array, vstack
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import delaunay_flips, transport
from igl_periods.complexes.flip_rounds import Flips
from igl_periods.topology import pairing


def flipped_torus():
    K = ip.DeltaComplex.from_mesh(*noisy_torus(9, 7, 0.25, 2))
    L, rounds = delaunay_flips(K)
    assert sum(flips.edge.size for flips in rounds) > 10
    return K, L, rounds


def closed(K, cochains):
    values = cochains.toarray()[:, K.edge] * K.sign
    return not values.sum(axis=2).any()


def test_carried_cochains_are_closed_and_pair_as_before():
    K, L, rounds = flipped_torus()
    basis = ip.cohomology_basis(K)
    carried = transport(basis, rounds)
    assert closed(L, carried)
    assert np.array_equal(pairing(L, carried, carried), pairing(K, basis, basis))


def test_transport_is_linear_however_many_are_carried():
    K, _, rounds = flipped_torus()
    basis = ip.cohomology_basis(K)
    many = csr_array(vstack([basis * k for k in range(1, 21)]))
    single = transport(basis, rounds).toarray()
    together = transport(many, rounds).toarray()
    assert np.array_equal(together, np.concatenate([single * k for k in range(1, 21)]))


def test_values_on_a_flipped_edge_are_sums_over_both_ways_around():
    K, _, rounds = flipped_torus()
    basis = ip.cohomology_basis(K)
    flips: Flips = rounds[0]
    after, before = transport(basis, rounds[:1]).toarray(), basis.toarray()
    way = flips.first_sign * before[:, flips.first] + flips.second_sign * before[:, flips.second]
    assert np.array_equal(after[:, flips.edge], way)


def test_no_rounds_change_nothing():
    K, _, _ = flipped_torus()
    basis = ip.cohomology_basis(K)
    assert transport(basis, []) is basis
