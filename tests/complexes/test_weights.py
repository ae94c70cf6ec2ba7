"""Weights: cotangents of glued triangles, and of triangles in space."""

import numpy as np
import pytest
from support.random_surfaces import L_SHAPE, torus_of_revolution

import igl_periods as ip
from igl_periods.complexes.weights import cotan_weights, extrinsic_weights


def test_diagonals_of_squares_have_weight_zero():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 3)
    weights = np.sort(cotan_weights(K))
    n_squares = 27
    np.testing.assert_allclose(weights[:n_squares], 0.0, atol=1e-15)
    np.testing.assert_allclose(weights[n_squares:], 1.0, atol=1e-15)


def test_extrinsic_weights_are_intrinsic_ones_where_the_surface_is_flat():
    # A doubly covered polygon, flat but for its rim: over the inner edges both are the same.
    V, F = torus_of_revolution(2.0, 1.0, 5, 4)
    V = V @ np.diag([1.0, 1.0, 0.0]) + np.random.default_rng(1).normal(size=V.shape) * [0.1, 0.1, 0]
    K = ip.DeltaComplex.from_mesh(V, F)
    edge_normal = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])[:, 2]
    here = np.flatnonzero(K.sign.ravel() > 0)
    same_side = edge_normal[here // 3] * edge_normal[K.twin.ravel()[here] // 3] > 0
    edges = K.edge.ravel()[here[same_side]]
    assert edges.size > 10
    np.testing.assert_allclose(
        extrinsic_weights(K)[edges], np.abs(cotan_weights(K)[edges]), rtol=1e-9, atol=1e-9
    )


def test_extrinsic_weights_without_positions():
    with pytest.raises(ip.ComplexError, match="need vertex positions"):
        extrinsic_weights(ip.DeltaComplex.from_squares(L_SHAPE))
