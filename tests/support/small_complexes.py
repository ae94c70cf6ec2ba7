"""A tetrahedron, and what holds for every closed Δ-complex."""

import numpy as np

TETRAHEDRON = np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])


POINTS = np.array([[0.0, 0, 0], [1, 0, 0], [0.3, 1, 0], [0.2, 0.4, 0.9]])


def check_invariants(K):
    flat = K.twin.ravel()
    assert np.array_equal(flat[flat], np.arange(flat.size))
    assert np.all(flat != np.arange(flat.size))
    assert np.array_equal(K.edge.ravel()[flat], K.edge.ravel())
    assert np.array_equal(K.sign.ravel()[flat], -K.sign.ravel())
    assert np.array_equal(np.bincount(K.edge.ravel()), np.full(K.n_edges, 2))
    assert np.array_equal(K.lengths.ravel()[flat], K.lengths.ravel())
    start, end = np.roll(K.corner_vertex, -1, 1).ravel(), np.roll(K.corner_vertex, 1, 1).ravel()
    assert np.array_equal(start[flat], end)
    assert K.euler_characteristic == 2 - 2 * K.genus
    assert np.array_equal(np.unique(K.corner_vertex), np.arange(K.n_vertices))
