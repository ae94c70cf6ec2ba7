"""Trees and cotrees: they span, do not cross, and are shortest where they say so."""

import numpy as np
import pytest
from support.homology_surfaces import SURFACES
from support.walked_surfaces import edge_lengths

from igl_periods.complexes.half_edges import half_edge_ends
from igl_periods.topology.spanning_trees import shortest_tree_cotree, tree_cotree


@pytest.mark.parametrize("K", SURFACES)
def test_tree_and_cotree_span_and_do_not_cross(K):
    trees = tree_cotree(K, root=K.n_vertices - 1)
    edge = K.edge.ravel()
    in_tree = edge[trees.vertex_parent[trees.vertex_parent >= 0]]
    in_cotree = edge[trees.face_parent[trees.face_parent >= 0]]
    both = np.concatenate([in_tree, in_cotree, edge[trees.generators]])
    assert (in_tree.size, in_cotree.size) == (K.n_vertices - 1, K.n_faces - 1)
    assert np.array_equal(np.sort(both), np.arange(K.n_edges))


def test_shortest_tree_and_cotree_span_and_do_not_cross(K):
    trees = shortest_tree_cotree(K, K.n_vertices // 2)
    edge = K.edge.ravel()
    in_tree = edge[trees.vertex_parent[trees.vertex_parent >= 0]]
    in_cotree = edge[trees.face_parent[trees.face_parent >= 0]]
    both = np.concatenate([in_tree, in_cotree, edge[trees.generators]])
    assert (in_tree.size, in_cotree.size) == (K.n_vertices - 1, K.n_faces - 1)
    assert np.array_equal(np.sort(both), np.arange(K.n_edges))
    tail, head = half_edge_ends(K)
    twin, reached = K.twin.ravel(), np.flatnonzero(trees.vertex_parent >= 0)
    assert np.array_equal(head[trees.vertex_parent[reached]], reached)
    left = np.flatnonzero(trees.face_parent >= 0)
    assert np.array_equal(trees.face_parent[left] // 3, left)
    # Both lead to their roots.
    vertex, face = np.arange(K.n_vertices), np.arange(K.n_faces)
    for _ in range(K.n_vertices + K.n_faces):
        parent = trees.vertex_parent[vertex]
        vertex = np.where(parent >= 0, tail[parent], vertex)
        parent = trees.face_parent[face]
        face = np.where(parent >= 0, twin[parent] // 3, face)
    assert np.array_equal(vertex, np.full(K.n_vertices, K.n_vertices // 2))
    assert not face.any()


def test_tree_paths_are_shortest(K):
    # Second route: relaxation of all edges until nothing changes.
    trees, lengths = shortest_tree_cotree(K, 0), edge_lengths(K)[K.edge.ravel()]
    tail, head = half_edge_ends(K)
    distance = np.where(np.arange(K.n_vertices) == 0, 0.0, np.inf)
    for _ in range(K.n_vertices):
        np.minimum.at(distance, head, distance[tail] + lengths)
    along_tree = trees.vertex_parent[1:]
    np.testing.assert_allclose(
        distance[1:], distance[tail[along_tree]] + lengths[along_tree], rtol=1e-14
    )
