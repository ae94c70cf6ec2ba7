"""Δ-complexes: gluings, vertices, invariants, and everything that is refused."""

import igl
import numpy as np
import pytest
from random_surfaces import (
    BOLZA,
    HEXAGON,
    L_SHAPE,
    noisy_torus,
    random_gluing,
    random_lengths,
    torus_grid,
    torus_of_revolution,
)

import igl_periods as ip
from igl_periods.complexes.surface_checks import check_surface, is_orientable
from igl_periods.complexes.triangles import angles, cotangents, double_areas, is_strict, mollify
from igl_periods.complexes.weights import cone_angles, cotan_weights, extrinsic_weights

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


@pytest.mark.parametrize(
    ("gluing", "vertices"), [(L_SHAPE, (1, 25)), (BOLZA, (2, 34)), (HEXAGON, (4, 52))]
)
def test_squares_have_genus_two(gluing, vertices):
    # V = (number of squares) n² − 2, by the Euler characteristic.
    for n, expected in zip((1, 3), vertices, strict=True):
        K = ip.DeltaComplex.from_squares(gluing, n)
        assert expected == len(gluing) // 2 * n * n - 2
        assert (K.genus, K.n_vertices) == (2, expected)
        check_invariants(K)


def test_diagonals_of_squares_have_weight_zero():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 3)
    weights = np.sort(cotan_weights(K))
    n_squares = 27
    np.testing.assert_allclose(weights[:n_squares], 0.0, atol=1e-15)
    np.testing.assert_allclose(weights[n_squares:], 1.0, atol=1e-15)


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


def test_components_are_found_and_keep_their_rows_of_V():
    V, F = torus_of_revolution(2.0, 0.5, 6, 5)
    two = np.concatenate([F + len(V), F])
    K = ip.DeltaComplex.from_mesh(np.concatenate([V, V + 9.0]), two)
    first, second = K.components()
    assert first.labels.min() == len(V)
    assert second.labels.max() == len(V) - 1
    for part in (first, second):
        check_invariants(part)
        assert np.array_equal(part.corner_vertex, F)
    with pytest.raises(ip.ComplexError, match="2 components"):
        check_surface(K)


def test_any_integer_or_float_type_and_lists_are_accepted():
    V, F = torus_of_revolution(2.0, 0.5, 5, 4)
    reference = ip.DeltaComplex.from_mesh(V, F)
    for faces in (F.tolist(), F.astype(np.uint32), F.astype(np.int16), np.asfortranarray(F)):
        K = ip.DeltaComplex.from_mesh(np.asfortranarray(V), faces)
        assert np.array_equal(K.lengths, reference.lengths)
    rounded = ip.DeltaComplex.from_mesh(V.astype(np.float32), F)
    np.testing.assert_allclose(rounded.lengths, reference.lengths, rtol=1e-6)


# Triangles


def test_cotangents_are_those_of_libigl():
    V, F = noisy_torus(9, 6, 0.1, seed=3)
    lengths = igl.edge_lengths(V, F)
    ours, theirs = cotangents(lengths), 2.0 * igl.cotmatrix_entries(lengths)
    np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12 * np.abs(ours).max())


def test_right_angles_of_needles_are_exact():
    # Legs c and 1, c = 2^-26: the hypotenuse rounds to 1, so the triangle stored is isosceles.
    c = 2.0**-26
    needle = np.array([[c, 1.0, 1.0]])
    # Isosceles: cot of the base angles is c / (2h), h² = 1 − c²/4.
    exact = c / (2.0 * np.sqrt(1.0 - c * c / 4.0))
    np.testing.assert_allclose(cotangents(needle)[0, 1:], exact, rtol=1e-15)
    np.testing.assert_allclose(double_areas(needle), c * np.sqrt(1 - c * c / 4), rtol=1e-15)


def test_angles_add_up_to_pi():
    lengths = np.random.default_rng(0).uniform(1.0, 1.99, size=(200, 3))
    np.testing.assert_allclose(angles(lengths).sum(axis=1), np.pi, rtol=1e-14)


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


def test_mollification_mends_what_rounding_broke():
    lengths = np.array([[1.0, 1.0, 2.0], [1.0, 1.0, 1.0]])
    mended, delta = mollify(lengths)
    assert 0 < delta < 1e-12
    assert np.array_equal(mended, lengths + delta)
    assert (double_areas(mended) > 0).all()
    assert mollify(mended) == (pytest.approx(mended, abs=0), 0.0)


@pytest.mark.parametrize(
    "lengths",
    [
        # A long collinear face among many small ones, and one that misses strictness by little.
        [[1024.0, 512.0, 512.0], *[[1.0, 1.0, 1.0]] * 3600],
        [[1000.0, 500.0, 500.0 + 2e-12], *[[1.0, 1.0, 1.0]] * 5000],
    ],
)
def test_mollified_triangles_are_strict(lengths):
    mended, delta = mollify(np.array(lengths))
    assert 0 < delta < 1e-6
    assert is_strict(mended).all()
    assert (double_areas(mended) > 0).all()


def test_the_most_that_is_mollified():
    faces = np.ones((100, 3))
    faces[0] = 1.0, 0.4, 0.6 - 0.9e-6
    assert mollify(faces)[1] == pytest.approx(0.9e-6, rel=1e-3)
    faces[0, 2] = 0.6 - 1.1e-6
    with pytest.raises(ip.ComplexError, match="face 0 is degenerate"):
        mollify(faces)


def test_complexes_do_not_share_memory_with_what_they_were_made_from():
    V, F = noisy_torus(6, 5, 0.1, seed=1)
    K = ip.DeltaComplex.from_mesh(V, F)
    expected = ip.period_matrix(K).matrix
    F[:] = F[:, ::-1].copy()
    V[:] = 0.0
    assert np.array_equal(ip.period_matrix(K).matrix, expected)
    with pytest.raises(ValueError, match="read-only"):
        K.lengths[0, 0] = 1.0
    assert repr(K) == "DeltaComplex(30 vertices, 90 edges, 60 faces)"


def test_labels_far_apart():
    rows = np.array([0, 7, 10**12, 2**61])
    K = ip.DeltaComplex.from_lengths(np.ones((4, 3)), rows[TETRAHEDRON])
    assert np.array_equal(K.labels, rows)
    assert np.array_equal(K.corner_vertex, TETRAHEDRON)


def test_gluings_that_reverse_orientation_are_checked():
    twin = ip.DeltaComplex.from_mesh(POINTS, TETRAHEDRON).twin
    with pytest.raises(ip.ComplexError, match="same must"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), twin, np.zeros(3, dtype=bool))
    same = np.zeros((4, 3), dtype=bool)
    same[0, 0] = True
    with pytest.raises(ip.ComplexError, match="same differs"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), twin, same)


# What is refused


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_coordinates_that_are_not_finite(bad):
    V = POINTS.copy()
    V[2, 1] = bad
    with pytest.raises(ip.MeshError, match=r"1 vertices have coordinates .* vertex 2"):
        ip.DeltaComplex.from_mesh(V, TETRAHEDRON)


@pytest.mark.parametrize(
    ("F", "message"),
    [
        (TETRAHEDRON + 1, r"vertex 4, out of range: V has 4 rows.*counted from 1"),
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


@pytest.mark.parametrize("V", [np.zeros(4), np.zeros((4, 1))])
def test_positions_of_a_wrong_shape(V):
    with pytest.raises(ip.MeshError, match=r"V must have shape \(n, d\)"):
        ip.DeltaComplex.from_mesh(V, TETRAHEDRON)
    with pytest.raises(ip.MeshError, match="V must hold real numbers"):
        ip.DeltaComplex.from_mesh(np.array([["a", "b", "c"]]), TETRAHEDRON)


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


def test_boundary():
    K = ip.DeltaComplex.from_mesh(POINTS, TETRAHEDRON[:3])
    with pytest.raises(ip.ComplexError, match=r"not closed: it has 3 boundary edges.*double"):
        check_surface(K)


def test_inconsistent_orientation():
    F = TETRAHEDRON.copy()
    F[1] = F[1, ::-1]
    K = ip.DeltaComplex.from_mesh(POINTS, F)
    assert is_orientable(K)
    with pytest.raises(ip.ComplexError, match=r"across 3 edges.*orientable: turn faces over"):
        check_surface(K)


def test_non_orientable():
    # The projective plane on six vertices.
    F = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1],
         [1, 2, 4], [2, 3, 5], [3, 4, 1], [4, 5, 2], [5, 1, 3]]  # fmt: skip
    K = ip.DeltaComplex.from_mesh(np.random.default_rng(0).normal(size=(6, 4)), F)
    assert K.euler_characteristic == 1
    assert not is_orientable(K)
    with pytest.raises(ip.ComplexError, match="not orientable"):
        check_surface(K)


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


def test_lengths_of_a_wrong_shape_or_type():
    with pytest.raises(ip.ComplexError, match=r"lengths must have shape \(4, 3\)"):
        ip.DeltaComplex.from_lengths(np.ones((3, 3)), TETRAHEDRON)
    with pytest.raises(ip.ComplexError, match="lengths must hold real numbers"):
        ip.DeltaComplex.from_lengths(np.ones((4, 3), dtype=complex), TETRAHEDRON)


def test_unequal_lengths_of_glued_sides():
    lengths = np.ones((4, 3))
    lengths[1, 1] = 1.0 + 1e-6
    with pytest.raises(
        ip.ComplexError, match=r"different lengths: 1 at side 2 of face 0, 1\.000001 at"
    ):
        ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)
    for difference, allowed in ((0.9e-9, True), (1.1e-9, False)):
        lengths[1, 1] = 1.0 + difference
        if allowed:
            ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)
            continue
        with pytest.raises(ip.ComplexError, match="different lengths"):
            ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)
    lengths[1, 1] = 1.0 + 1e-12
    K = ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)
    assert K.lengths[1, 1] == K.lengths.ravel()[K.twin[1, 1]] == 1.0 + 0.5e-12


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t.__setitem__((0, 0), t[1, 1]), "no involution"),
        (lambda t: t.__setitem__((0, 0), 0), "no involution without fixed points"),
        (lambda t: t.__setitem__((0, 0), 99), "entries from .* to 99"),
        (lambda t: t.__setitem__((0, 0), -2), "entries from -2"),
    ],
)
def test_gluings_that_are_none(change, message):
    twin = ip.DeltaComplex.from_mesh(POINTS, TETRAHEDRON).twin.copy()
    change(twin)
    with pytest.raises(ip.ComplexError, match=message):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), twin)


def test_gluings_of_a_wrong_shape_or_type():
    with pytest.raises(ip.ComplexError, match=r"twin must have shape \(m, 3\)"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), np.zeros(12, dtype=int))
    with pytest.raises(ip.ComplexError, match="twin must be integer"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), np.zeros((4, 3)))
    with pytest.raises(ip.ComplexError, match="twin is no rectangular array"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), [[0, 1, 2], [0]])
    # −1 is a free side; 2^64 − 1, which has the same bits, is no half-edge.
    unsigned = np.full((1, 3), 2**64 - 1, dtype=np.uint64)
    with pytest.raises(ip.ComplexError, match=r"entries from 18446744073709551615 to"):
        ip.DeltaComplex.from_gluing(np.ones((1, 3)), unsigned)
    with pytest.raises(ip.ComplexError, match="same is no rectangular array"):
        ip.DeltaComplex.from_gluing(np.ones((2, 3)), np.full((2, 3), -1), [[True], [False, True]])


@pytest.mark.parametrize(
    ("gluing", "n", "message"),
    [
        ([((0, 0), (0, 2)), ((0, 1), (0, 1))], 1, "side 1 of square 0 is glued 2 times"),
        ([((0, 0), (0, 2)), ((0, 1), (1, 3))], 1, "side 3 of square 0 is glued 0 times"),
        ([((0, 0), (0, 4)), ((0, 1), (0, 3))], 1, "sides are 0 bottom"),
        ([((0, 0), (0, 2)), ((0, 1), (0, 3))], 0, "n = 0"),
        ([((0, 0), (0, 2)), ((0, 1), (0, 3))], 2.0, "n = 2.0"),
        ([((0, 0), (0, 2)), ((0, 1), (10**9, 3))], 1, "square 1000000000 is named"),
        ([((0, 0), (0, 2)), ((0, 1),)], 1, "list of pairs"),
        ([(0, 1), (2, 3)], 1, "list of pairs"),
        (None, 1, "list of pairs"),
        ([((0, 0), (0, 2)), ((0, 1), (0, 3))], 10**9, r"have 2e\+18 triangles, and up to 1e\+08"),
    ],
)
def test_gluings_of_squares_that_are_none(gluing, n, message):
    with pytest.raises(ip.ComplexError, match=message):
        ip.DeltaComplex.from_squares(gluing, n)


def test_extrinsic_weights_without_positions():
    with pytest.raises(ip.ComplexError, match="need vertex positions"):
        extrinsic_weights(ip.DeltaComplex.from_squares(L_SHAPE))


def test_torus_grid_is_a_torus():
    K = ip.DeltaComplex.from_lengths(np.ones((24, 3)), torus_grid(4, 3))
    assert (K.genus, K.n_vertices, K.n_edges) == (1, 12, 36)
