"""Lawson's surfaces: minimal, embedded, of genus mk; convergence to the exact matrix."""

import igl
import numpy as np
import pytest
from support.lawson_convergence import errors, orders, segments_of

import igl_periods as ip
from igl_periods.complexes.triangles import angles, cotangents, double_areas
from igl_periods.complexes.weights import cotan_weights
from igl_periods.surfaces import (
    lawson_period_matrix,
    lawson_sides,
    lawson_surface,
    lawson_surface_jittered,
    lawson_surface_poor,
    lawson_surface_voronoi,
    stereographic,
)
from igl_periods.surfaces.lawson.plateau import laplacian, vertex_normals

ORDERS = [(1, 1), (2, 1), (1, 2), (3, 1), (2, 2), (3, 2), (3, 3), (4, 3)]


def area(V, F):
    return double_areas(igl.edge_lengths(V, F)).sum() / 2


# --- the meshes
@pytest.mark.parametrize(("n", "vertices"), [(5, 298), (10, 1198), (14, 2350), (29, 10090)])
def test_genus_two_surface(n, vertices):
    V, F = lawson_surface(2, 1, n)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert (len(V), K.n_vertices, K.genus) == (vertices, vertices, 2)
    assert np.abs(np.linalg.norm(V, axis=1) - 1).max() < 1e-15
    assert np.degrees(angles(K.lengths).min()) > 45
    assert cotan_weights(K).min() > 0


@pytest.mark.slow
def test_finest_mesh_of_the_genus_two_surface():
    V, F = lawson_surface(2, 1, 58)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert (K.n_vertices, K.genus) == (40366, 2)
    assert np.degrees(angles(K.lengths).min()) > 45
    assert area(V, F) == pytest.approx(21.9085, abs=2e-3)


@pytest.mark.parametrize(
    ("m", "k", "n", "limit"),
    # Areas extrapolated from meshes up to n = 128; the first is that of Clifford's torus.
    [(1, 1, 8, 2 * np.pi**2), (2, 1, 14, 21.90851), (3, 1, 12, 22.8203), (2, 2, 8, 26.94962)],
)
def test_area_converges_with_order_two(m, k, n, limit):
    coarse, fine = (area(*lawson_surface(m, k, q)) for q in (n, 2 * n))
    assert np.log2((limit - coarse) / (limit - fine)) == pytest.approx(2, abs=0.05)
    assert (4 * fine - coarse) / 3 == pytest.approx(limit, rel=5e-5)


@pytest.mark.parametrize(("m", "k"), ORDERS)
def test_meshes_are_minimal_embedded_and_have_genus_mk(m, k):
    n = 3
    V, F = lawson_surface(m, k, n)
    K = ip.DeltaComplex.from_mesh(V, F)
    triangles = 8 if min(m, k) > 1 else 2
    assert K.genus == m * k
    assert K.n_vertices == 2 - 2 * m * k + (k + 1) * (m + 1) * triangles * n * n
    # Mean curvature along the normal of the surface in the sphere, and Δx = −2x along x.
    L, areas = laplacian(F, cotangents(K.lengths), len(V)), np.zeros(len(V))
    np.add.at(areas, F, double_areas(K.lengths)[:, None] / 6)
    H = np.sum((L @ V) * vertex_normals(V, F), axis=1) / areas
    assert np.abs(H).max() < 1e-11
    assert np.sum((L @ V) * V) == pytest.approx(2 * areas.sum(), rel=1e-12)


@pytest.mark.parametrize("pattern", ["diagonal_q", "diagonal_p", "corner", "cross"])
def test_patterns(pattern):
    triangles = {"diagonal_q": 2, "diagonal_p": 2, "corner": 8, "cross": 4}[pattern]
    missing = []
    for n in (4, 8):
        V, F = lawson_surface(2, 1, n, pattern)
        assert ip.DeltaComplex.from_mesh(V, F).genus == 2
        assert len(V) == 2 - 4 + 6 * triangles * n * n
        missing.append(21.90851 - area(V, F))
    # Where the corners of the disc do not suit the pattern, the order is less than 2.
    assert missing[0] > 2.8 * missing[1] > 0


def test_exchanging_m_and_k_gives_a_congruent_surface():
    V, F = lawson_surface(3, 1, 5)
    W, G = lawson_surface(1, 3, 5)
    assert len(V) == len(W)
    assert area(V, F) == pytest.approx(area(W, G), rel=1e-12)


def test_sides_are_geodesics_with_consecutive_vertices():
    V, F = lawson_surface(2, 1, 5)
    walks = lawson_sides(2, 1, 5)
    edges = {tuple(sorted(e)) for e in np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])}
    steps = np.stack([walks[..., :-1], walks[..., 1:]], axis=-1).reshape(-1, 2)
    assert all(tuple(sorted(step)) in edges for step in steps)
    points = V[walks]
    t = np.arctan2(
        np.linalg.norm(points[..., 2:], axis=-1), np.linalg.norm(points[..., :2], axis=-1)
    )
    assert np.all(np.diff(t, axis=-1) > 0)
    straight = (
        np.cos(t)[..., None] * points[..., :1, :] + np.sin(t)[..., None] * points[..., -1:, :]
    )
    assert np.abs(points - straight).max() < 1e-14


def test_stereographic_image():
    V, F = lawson_surface(2, 1, 10)
    W = stereographic(V, 2, 1)
    volume = np.einsum("fd,fd->", W[F[:, 0]], np.cross(W[F[:, 1]], W[F[:, 2]])) / 6
    assert volume > 0
    # Conformal: |dy| = |dx| / (1 − ⟨x, N⟩), between the extremes of the distance from the pole.
    scale = igl.edge_lengths(W, F) / igl.edge_lengths(V, F)
    factor = 1 / (1 - V[:, :2] @ [np.cos(np.pi / 4), np.sin(np.pi / 4)])
    corner = np.sqrt(np.roll(factor[F], -1, 1) * np.roll(factor[F], 1, 1))
    assert np.abs(scale / corner - 1).max() < 1e-13
    assert factor.max() / factor.min() == pytest.approx(5.83, abs=0.01)


@pytest.mark.parametrize(("m", "k"), [(2, 1), (3, 1), (2, 2), (3, 2), (3, 3), (4, 3)])
def test_meshes_converge_to_the_exact_matrix_in_their_own_marking(m, k):
    values = [errors(*lawson_surface(m, k, n), m, k, segments_of(m, k, n)) for n in (3, 6)]
    primal, _, bound = np.log2(values[0] / values[1])
    assert primal == pytest.approx(2, abs=0.25)
    assert bound == pytest.approx(2, abs=0.25)
    assert values[1][1] < 1e-4


# --- convergence
def test_primal_error_of_the_structured_family():
    # Regression values of an independent computation.
    sizes = {5: "8.2e-03", 10: "2.0e-03", 14: "1.0e-03", 29: "2.3e-04"}
    values = {n: errors(*lawson_surface(2, 1, n), 2, 1, n) for n in sizes}
    assert {n: f"{v[0]:.1e}" for n, v in values.items()} == sizes
    assert max(v[1] for v in values.values()) < 1e-13
    assert np.all(orders([v[0] for v in values.values()], [298, 1198, 2350, 10090]) > 1.9)


def test_stereographic_images_converge_with_order_two():
    values = []
    for n in (7, 14, 28):
        V, F = lawson_surface(2, 1, n)
        values.append(errors(stereographic(V, 2, 1), F, 2, 1, n))
    observed = np.log2(np.divide(values[:-1], values[1:]))
    assert np.all(observed[:, :2] > 1.85)


# --- refusals
@pytest.mark.parametrize(("m", "k"), [(0, 1), (1, 0), (-2, 1)])
def test_orders_below_one_are_refused(m, k):
    V = np.eye(4)
    for call in (
        lambda: lawson_surface(m, k, 4),
        lambda: lawson_period_matrix(m, k),
        lambda: stereographic(V, m, k),
        lambda: lawson_surface_jittered(m, k, 4),
        lambda: lawson_surface_voronoi(m, k, 300),
        lambda: lawson_surface_poor(m, k, 300),
    ):
        with pytest.raises(ip.MeshError, match="needs integers m, k >= 1"):
            call()


def test_other_wrong_arguments_are_refused():
    with pytest.raises(ip.MeshError, match="n >= 2"):
        lawson_surface(2, 1, 1)
    with pytest.raises(ip.MeshError, match="there is no pattern 'star'"):
        lawson_surface(2, 1, 4, "star")
    with pytest.raises(ip.MeshError, match=r"shape \(n, 4\), not \(5, 3\)"):
        stereographic(np.zeros((5, 3)), 2, 1)
    with pytest.raises(ip.MeshError, match=r"take 0 <= amplitude <= 0\.4"):
        lawson_surface_jittered(2, 1, 4, amplitude=0.5)
    with pytest.raises(ip.MeshError, match=r"stretch = 0\.5: take a factor >= 1"):
        lawson_surface_poor(2, 1, 300, stretch=0.5)
    for make in (lawson_surface_voronoi, lawson_surface_poor):
        with pytest.raises(ip.MeshError, match="for the inside of 12 discs; each needs 3"):
            make(2, 1, 40)
