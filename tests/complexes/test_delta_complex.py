"""Δ-complexes: vertices, invariants, and everything that is refused."""

import igl
import numpy as np
import pytest
from support.random_surfaces import (
    noisy_torus,
    random_gluing,
    random_lengths,
    torus_grid,
    torus_of_revolution,
)
from support.small_complexes import POINTS, TETRAHEDRON, check_invariants

import igl_periods as ip
from igl_periods.complexes.weights import cone_angles


@pytest.mark.parametrize("seed", range(20))
def test_random_gluings_have_consistent_vertices_and_edges(seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(2 * rng.integers(1, 12), rng)
    for K in ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components():
        check_invariants(K)
        np.testing.assert_allclose(
            (2 * np.pi - cone_angles(K)).sum(), 2 * np.pi * K.euler_characteristic, atol=1e-9
        )


def test_mesh_and_its_lengths_and_its_gluing_give_the_same_complex():
    V, F = noisy_torus(7, 5, 0.1, seed=1)
    from_mesh = ip.DeltaComplex.from_mesh(V, F)
    lengths = igl.edge_lengths(V, F)
    from_lengths = ip.DeltaComplex.from_lengths(lengths, F)
    from_gluing = ip.DeltaComplex.from_gluing(lengths, from_mesh.twin)
    for K in (from_lengths, from_gluing):
        assert np.array_equal(K.twin, from_mesh.twin)
        assert np.array_equal(K.edge, from_mesh.edge)
        assert np.array_equal(K.lengths, from_mesh.lengths)
        assert K.n_vertices == from_mesh.n_vertices
    assert np.array_equal(from_lengths.corner_vertex, F)


@pytest.mark.parametrize("dimension", [2, 3, 4, 6])
def test_lengths_are_euclidean_in_every_dimension(dimension):
    V = np.random.default_rng(dimension).normal(size=(4, dimension))
    K = ip.DeltaComplex.from_mesh(V, TETRAHEDRON)
    for s in range(3):
        ends = V[TETRAHEDRON[:, (s + 1) % 3]] - V[TETRAHEDRON[:, (s + 2) % 3]]
        np.testing.assert_allclose(K.lengths[:, s], np.linalg.norm(ends, axis=1), rtol=1e-15)


def test_rows_of_V_that_no_face_uses_are_no_vertices():
    V, F = torus_of_revolution(2.0, 0.5, 6, 5)
    spread = np.insert(V, [0, 7, 30], np.nan, axis=0)
    rows = np.setdiff1d(np.arange(len(spread)), [0, 8, 32])
    K, L = ip.DeltaComplex.from_mesh(V, F), ip.DeltaComplex.from_mesh(spread, rows[F])
    assert np.array_equal(K.corner_vertex, L.corner_vertex)
    assert np.array_equal(L.labels, rows)
    assert np.array_equal(L.positions, V)


def test_complexes_do_not_share_memory_with_what_they_were_made_from():
    V, F = noisy_torus(6, 5, 0.1, seed=1)
    K = ip.DeltaComplex.from_mesh(V, F)
    expected = ip.period_matrix(K).matrix
    F[:] = F[:, ::-1].copy()
    V[:] = 0.0
    assert np.array_equal(ip.period_matrix(K).matrix, expected)
    with pytest.raises(ValueError, match="read-only"):
        K.lengths[0, 0] = 1.0
    assert repr(K) == "DeltaComplex(30 vertices, 90 edges, 60 faces; genus 1)"


def test_labels_far_apart():
    rows = np.array([0, 7, 10**12, 2**61])
    K = ip.DeltaComplex.from_lengths(np.ones((4, 3)), rows[TETRAHEDRON])
    assert np.array_equal(K.labels, rows)
    assert np.array_equal(K.corner_vertex, TETRAHEDRON)


@pytest.mark.parametrize(
    ("F", "message"),
    [
        (TETRAHEDRON + 1, r"vertex 4, out of range: V has 4 rows.*counted from 1"),
        (2 * TETRAHEDRON, r"vertex 6, out of range: V has 4 rows, counted from 0\.$"),
        (TETRAHEDRON - 1, r"negative indices \(the least is -1\)"),
        ([[0, 1, 1], [0, 3, 1]], r"1 faces repeat a vertex; the first is face 0"),
        (np.zeros((4, 4), int), r"shape \(m, 3\), not \(4, 4\)"),
        (TETRAHEDRON.astype(float), "must be integer"),
        (TETRAHEDRON == 1, "must be integer, not bool|must be integer"),
        (TETRAHEDRON.astype(np.uint64) + np.uint64(2**64 - 4), "out of range|no sensible index"),
        ([[0, 1, 2], [0, 3]], "rows have different lengths"),
        (np.zeros((0, 3), int), "empty: it has no faces"),
        ([[0, 1, 2], [0, 1, 3], [1, 0, 2]], "borders 3"),
    ],
)
def test_faces_that_form_no_surface(F, message):
    with pytest.raises(ip.MeshError, match=message):
        ip.DeltaComplex.from_mesh(POINTS, F)


@pytest.mark.parametrize("scale", [1e-200, 1e-80, 1e80, 1e200])
def test_scales_at_which_areas_cannot_be_computed(scale):
    with pytest.raises(ip.ComplexError, match=r"Rescale the surface|degenerate: its sides 0, 0, 0"):
        ip.DeltaComplex.from_mesh(POINTS * scale, TETRAHEDRON)


@pytest.mark.parametrize("exponent", [-190, -7, 190])
def test_scaling_by_powers_of_two_changes_no_bit(exponent):
    V, F = noisy_torus(6, 5, 0.2, 3)
    one, other = (ip.period_matrix(W, F) for W in (V, V * 2.0**exponent))
    assert one.dirichlet.tobytes() == other.dirichlet.tobytes()
    assert one.bound == other.bound


def test_two_fans_at_a_vertex():
    apex_shared = np.concatenate([TETRAHEDRON, np.where(TETRAHEDRON == 0, 0, TETRAHEDRON + 3)])
    V = np.random.default_rng(0).normal(size=(7, 3))
    with pytest.raises(ip.MeshError, match="vertex 0, joins 2"):
        ip.DeltaComplex.from_mesh(V, apex_shared)


def test_degenerate_triangles_beyond_mollification():
    with pytest.raises(ip.ComplexError, match=r"face 0 is degenerate"):
        ip.DeltaComplex.from_mesh(np.zeros((4, 3)), TETRAHEDRON)
    # The edge between vertices 0 and 1, opposite corners 2 and 3 of the other faces.
    lengths = np.ones((4, 3))
    lengths[0, 2] = lengths[1, 1] = 2.9
    with pytest.raises(ip.ComplexError, match=r"face 0 is degenerate.*inequality by 0.9"):
        ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)


def test_a_collapsed_edge_is_mended_and_reported():
    V, F = torus_of_revolution(2.0, 0.7, 6, 5)
    V[F[0, 0]] = V[F[0, 1]]
    K = ip.DeltaComplex.from_mesh(V, F)
    assert 0 < K.mollification < 1e-12
    check_invariants(K)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_lengths_that_are_not_positive(bad):
    lengths = np.ones((4, 3))
    lengths[2, 0] = bad
    with pytest.raises(ip.ComplexError, match="not positive and finite; the first is face 2"):
        ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)


def test_torus_grid_is_a_torus():
    K = ip.DeltaComplex.from_lengths(np.ones((24, 3)), torus_grid(4, 3))
    assert (K.genus, K.n_vertices, K.n_edges) == (1, 12, 36)
