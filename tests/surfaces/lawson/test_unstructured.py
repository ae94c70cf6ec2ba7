"""Unstructured meshes of Lawson's surfaces converge too."""

import numpy as np
import pytest
from support.lawson_convergence import errors, orders

import igl_periods as ip
from igl_periods.complexes.triangles import angles
from igl_periods.surfaces import (
    lawson_segments,
    lawson_surface_jittered,
    lawson_surface_poor,
    lawson_surface_voronoi,
)


@pytest.mark.parametrize("seed", [0, 1])
def test_jittered_family_converges_with_order_two(seed):
    values = []
    for n in (5, 10, 20):
        V, F = lawson_surface_jittered(2, 1, n, seed=seed)
        K = ip.DeltaComplex.from_mesh(V, F)
        assert (K.n_vertices, K.genus) == (12 * n * n - 2, 2)
        assert np.degrees(angles(K.lengths).min()) > 30
        assert np.abs(np.linalg.norm(V, axis=1) - 1).max() < 1e-15
        values.append(errors(V, F, 2, 1, n))
    observed = np.log2(np.divide(values[:-1], values[1:]))
    assert np.all(observed[:, [0, 2]] > 1.8)
    assert 1e-6 < values[-1][1] < 2e-4  # no symmetry makes the symplectic mean exact


def test_centroidal_family_converges_with_order_two():
    values, sizes = [], (300, 1162)
    for size in sizes:
        V, F = lawson_surface_voronoi(2, 1, size, seed=3)
        K = ip.DeltaComplex.from_mesh(V, F)
        assert (K.n_vertices, K.genus) == (size, 2)
        values.append(errors(V, F, 2, 1, lawson_segments(2, 1, size)))
    primal, _, bound = np.array(values).T
    assert orders(primal[[0, -1]], [sizes[0], sizes[-1]]) > 1.8
    assert orders(bound[[0, -1]], [sizes[0], sizes[-1]]) > 1.8
    assert values[-1][1] < 1e-3


def test_jittered_surface_of_genus_four():
    V, F = lawson_surface_jittered(2, 2, 4, seed=2)
    primal, mean, _ = errors(V, F, 2, 2, 8)
    assert primal < 1e-2
    assert mean < 1e-3


def test_intrinsic_delaunay_restores_the_convergence_of_poor_meshes():
    # The more vertices, the longer and thinner the triangles: as the paper reports of its meshes.
    kept, flipped, sizes = [], [], (600, 2498)
    for size, stretch in zip(sizes, (1.0, 5.0), strict=True):
        V, F = lawson_surface_poor(2, 1, size, stretch, seed=1)
        K = ip.DeltaComplex.from_mesh(V, F)
        assert (K.n_vertices, K.genus) == (size, 2)
        assert angles(K.lengths).min() < np.radians(5)
        segments = lawson_segments(2, 1, size)
        kept.append(errors(V, F, 2, 1, segments, delaunay=False)[2])
        flipped.append(errors(V, F, 2, 1, segments)[2])
    assert orders(kept, sizes) < 0.2
    assert orders(flipped, sizes) > 1.7


def test_the_same_vertices_triangulated_well_converge():
    # Stretched triangles lose the surface itself, which flips on them cannot bring back; the same
    # seed without stretching joins the same vertices by a Delaunay triangulation.
    size, segments = 2498, lawson_segments(2, 1, 2498)
    poor, good = (lawson_surface_poor(2, 1, size, stretch, seed=1) for stretch in (4.0, 1.0))
    assert np.array_equal(poor[0], good[0])
    assert errors(*good, 2, 1, segments)[0] < 0.5 * errors(*poor, 2, 1, segments)[0]


def test_random_meshes_are_reproducible():
    for make in (lawson_surface_voronoi, lawson_surface_poor):
        one, same, other = (make(2, 1, 100, seed=seed) for seed in (5, 5, 6))
        assert np.array_equal(one[0], same[0])
        assert np.array_equal(one[1], same[1])
        assert not np.array_equal(one[0], other[0])
