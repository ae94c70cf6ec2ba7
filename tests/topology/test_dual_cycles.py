"""Cycles on Γ*: intersection numbers and Poincaré duality."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.random_surfaces import noisy_torus
from support.walked_surfaces import SURFACES, free_reduction

import igl_periods as ip
from igl_periods.complexes.half_edges import half_edge_ends
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.cohomology import pairing
from igl_periods.topology.dual_cycles import crossing_cochain, dual_homology_basis, dual_walk


# Cycles on Γ and on Γ*.
def test_dual_cycles_are_closed_walks_of_faces(K):
    twin = K.twin.ravel()
    for walk in dual_homology_basis(K):
        assert walk.size
        assert np.array_equal(twin[walk] // 3, np.roll(walk, -1) // 3)
        assert free_reduction(K, walk) == walk.tolist()


@pytest.mark.parametrize("name", [name for name in SURFACES if name != "random gluing 100"])
def test_intersection_numbers(name):
    # Every passage of a cycle on Γ over an edge is compared with every crossing of that edge by
    # a cycle on Γ*, one by one.  a_i·b_j = δ_ij = −b_i·a_j, and all others are 0.
    def crossings(dual, walk):
        twin, total = K.twin.ravel(), 0
        for leaves in dual:
            total += np.count_nonzero(walk == leaves) - np.count_nonzero(walk == twin[leaves])
        return total

    K = SURFACES[name]
    for root in (0, K.n_vertices - 1):
        cycles, dual = ip.homology_basis(K, root), dual_homology_basis(K, root)
        numbers = [[crossings(d, c) for c in cycles] for d in dual]
        expected = standard_form(K.genus)
        assert np.array_equal(np.reshape(numbers, expected.shape), expected)


def test_dual_cycles_are_poincare_dual_to_the_cohomology_basis(K):
    # The crossing cochains of a_i, b_i are closed, and cohomologous to β_i, −α_i; and
    # ∫ β_i ∧ α_j = −δ_ij = ∫ −α_i ∧ β_j.
    g, basis = K.genus, ip.cohomology_basis(K)
    crossing = [crossing_cochain(K, walk) for walk in dual_homology_basis(K)]
    cochains = csr_array(np.reshape(crossing, (2 * g, K.n_edges)))
    assert not (K.sign * cochains.toarray()[:, K.edge]).sum(axis=2).any()
    assert np.array_equal(pairing(K, cochains, basis), -np.eye(2 * g))


def test_a_loop_around_a_vertex_becomes_one_around_it_or_nothing():
    # Around vertex 0 clockwise, left is outside; counterclockwise it is the fan of vertex 0.
    K = ip.DeltaComplex.from_mesh(*noisy_torus(8, 7, 0.05, 0))
    f, s = np.nonzero(K.corner_vertex == 0)
    around = {int(t): 3 * int(i) + int(j) for i, j, t in zip(
        f, s, half_edge_ends(K)[0][3 * f + s])}  # fmt: skip
    walk, vertex = [], next(iter(around))
    head = half_edge_ends(K)[1]
    while not walk or vertex != half_edge_ends(K)[0][walk[0]]:
        walk.append(around[vertex])
        vertex = int(head[walk[-1]])
    inside = dual_walk(K, np.array(walk))
    assert sorted(inside // 3) == sorted(f)
    outside = dual_walk(K, K.twin.ravel()[np.array(walk)[::-1]])
    assert not set(outside // 3) & set(f)
    for dual in (inside, outside):
        pairs = pairing(K, csr_array(crossing_cochain(K, dual)[None]), ip.cohomology_basis(K))
        assert not pairs.any()


def test_walks_that_are_not_closed_are_refused():
    K = ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0))
    walk = ip.homology_basis(K)[0]
    with pytest.raises(ip.ComplexError, match="the walk is not closed"):
        dual_walk(K, walk[:-1])
