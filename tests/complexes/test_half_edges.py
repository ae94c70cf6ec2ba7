"""Half-edges: where they start and end, on whatever face, and walks made of them."""

import numpy as np
import pytest
from support.homology_surfaces import SURFACES

import igl_periods as ip
from igl_periods.complexes.half_edges import (
    edge_ends,
    forward_half_edges,
    half_edge_ends,
    walk_vertices,
)


@pytest.mark.parametrize("K", SURFACES)
def test_glued_half_edges_run_against_each_other(K):
    tail, head = half_edge_ends(K)
    twin = K.twin.ravel()
    assert np.array_equal(tail[twin], head)
    assert np.array_equal(head[twin], tail)


@pytest.mark.parametrize("K", SURFACES)
def test_an_edge_runs_as_its_forward_half_edge(K):
    forward = forward_half_edges(K)
    assert np.array_equal(K.edge.ravel()[forward], np.arange(K.n_edges))
    assert (K.sign.ravel()[forward] == 1).all()
    for ends, half_edge in zip(edge_ends(K), half_edge_ends(K)):
        assert np.array_equal(ends, half_edge[forward])


def test_edges_of_the_boundary_have_one_half_edge():
    K = ip.DeltaComplex.from_mesh(np.eye(3), [[0, 1, 2]])
    assert np.array_equal(K.edge.ravel()[forward_half_edges(K)], np.arange(3))
    assert {frozenset(ends) for ends in np.transpose(edge_ends(K)).tolist()} == {
        frozenset(pair) for pair in ((0, 1), (1, 2), (0, 2))
    }


@pytest.mark.parametrize("K", SURFACES)
def test_differences_of_a_function_add_up_to_zero_around_faces(K):
    f = np.arange(K.n_vertices) ** 2
    tail, head = edge_ends(K)
    around = K.sign * (f[head] - f[tail])[K.edge]
    assert not around.sum(axis=1).any()


@pytest.mark.parametrize("K", SURFACES)
def test_vertices_of_a_closed_walk_are_where_its_half_edges_meet(K):
    tail, head = half_edge_ends(K)
    for walk in ip.homology_basis(K):
        passed = walk_vertices(K, walk)
        assert np.array_equal(passed, tail[walk])
        assert np.array_equal(np.roll(passed, -1), head[walk])
