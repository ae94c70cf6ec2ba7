"""Where a bound comes from, refinement at those places, and advice in words."""

import numpy as np
import pytest
from random_surfaces import (
    BOLZA,
    L_SHAPE,
    noisy_torus,
    random_gluing,
    random_lengths,
    torus_of_revolution,
)
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.complexes.barycentre_insertion import insert_barycentres
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.complexes.surface_checks import check_surface
from igl_periods.complexes.weights import cone_angles, cotan_weights
from igl_periods.elements.least_energy import dirichlet_matrix as high_order_matrix
from igl_periods.elements.least_energy import high_order_forms
from igl_periods.harmonic.constant_forms import face_areas, gradients, linear_parts
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.excess import energy_excess
from igl_periods.harmonic.potentials import harmonic_potentials
from igl_periods.periods.adaptive_mesh import refined_period_matrix
from igl_periods.periods.matrix import PeriodMatrix
from igl_periods.periods.quality import mesh_quality
from igl_periods.reports.words import advice
from igl_periods.surfaces import flat_torus
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.symplectic.williamson_form import williamson, williamson_basis
from igl_periods.topology.cohomology import pairing


def random_genus_two(seed):
    """A random gluing of 12 triangles of genus 2 with random lengths."""
    rng = np.random.default_rng(seed)
    while True:
        twin = random_gluing(12, rng)
        K = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin)
        if len(K.components()) == 1 and K.genus == 2:
            return K


def harmonic(K):
    L, cochains = intrinsic_delaunay(K, ip.cohomology_basis(K))
    potentials = harmonic_potentials(L, cotan_weights(L), cochains)
    return L, cochains, potentials, dirichlet_matrix(L, cochains, potentials)


def forms(K, cochains, potentials):
    tail, head = edge_ends(K)
    return cochains.toarray() + (potentials[head] - potentials[tail]).T


SURFACES = [
    lambda: ip.DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.15, 2)),
    lambda: ip.DeltaComplex.from_squares(BOLZA, 2),
    lambda: random_genus_two(1),
    lambda: random_genus_two(2),
]


@pytest.mark.parametrize("surface", SURFACES)
def test_gradients_give_the_dirichlet_matrix_and_the_pairing(surface):
    L, cochains, potentials, D = harmonic(surface())
    g, area = gradients(L, forms(L, cochains, potentials)), face_areas(L)
    product = (area * g.conj()) @ g.T
    np.testing.assert_allclose(product.real, D, rtol=0, atol=1e-13 * np.trace(D))
    # ω ∧ η = Im(ḡ h) dA for gradients g and h.
    np.testing.assert_allclose(product.imag, standard_form(len(D) // 2), rtol=0, atol=1e-11)


@pytest.mark.parametrize("surface", SURFACES)
def test_linear_parts_reproduce_the_form(surface):
    L, cochains, potentials, _ = harmonic(surface())
    omega = forms(L, cochains, potentials)
    zeta = omega[0] + 1j * omega[1]
    p, q = linear_parts(L, zeta)
    l0, l1, l2 = L.lengths.T
    corner = np.stack([np.zeros(L.n_faces), l2, (l1**2 + l2**2 - l0**2) / (2 * l2)], axis=1) + 0j
    corner[:, 2] += 2j * face_areas(L) / l2
    side = np.roll(corner, 1, axis=1) - np.roll(corner, -1, axis=1)
    values = p[:, None] * side + q[:, None] * side.conj()
    np.testing.assert_allclose(values, L.sign * zeta[L.edge], rtol=0, atol=1e-12)


@pytest.mark.parametrize("surface", SURFACES)
def test_williamson_basis(surface):
    *_, D = harmonic(surface())
    g, d = len(D) // 2, williamson(D)[0]
    T = williamson_basis(D).swapaxes(0, 1).reshape(2 * g, 2 * g)
    np.testing.assert_allclose(T @ standard_form(g) @ T.T, standard_form(g), atol=1e-12)
    np.testing.assert_allclose(T @ D @ T.T, np.diag(np.r_[d, d]), atol=1e-12)


@pytest.mark.parametrize("surface", SURFACES)
def test_shares_of_the_faces_add_up_to_the_bound(surface):
    L, cochains, potentials, D = harmonic(surface())
    shares = energy_excess(L, cochains, potentials, D)
    assert shares.min() >= 0
    np.testing.assert_allclose(shares.sum(axis=1), williamson(D)[0] - 1, rtol=1e-9)
    quality = mesh_quality(surface())
    np.testing.assert_allclose(quality.vertex_excess.sum(), quality.bound, rtol=1e-12)
    np.testing.assert_allclose(quality.bound, ip.period_matrix(surface()).bound, rtol=1e-9)


def test_nothing_originates_where_the_form_is_exact():
    quality = mesh_quality(flat_torus(0.31 + 1.2j, 4, 5))
    assert quality.excess.max() < 1e-28
    assert quality.flips == quality.mollification == 0


@pytest.mark.parametrize("seed", range(8))
def test_barycentres(seed):
    K = random_genus_two(seed)
    rng = np.random.default_rng(seed)
    faces = rng.permutation(K.n_faces)[: rng.integers(1, K.n_faces + 1)]
    alpha = ip.cohomology_basis(K)
    L, beta = insert_barycentres(K, alpha, faces)
    check_surface(L)
    assert (L.genus, L.n_vertices) == (2, K.n_vertices + faces.size)
    flat = L.twin.ravel()
    assert np.array_equal(flat[flat], np.arange(flat.size))
    assert np.array_equal(L.edge.ravel()[flat], L.edge.ravel())
    assert np.array_equal(L.lengths.ravel()[flat], L.lengths.ravel())
    start, end = np.roll(L.corner_vertex, -1, 1).ravel(), np.roll(L.corner_vertex, 1, 1).ravel()
    assert np.array_equal(start[flat], end)
    # The cochains are closed, of the same classes, and unchanged on old edges.
    assert np.all((L.sign * beta.toarray()[:, L.edge]).sum(axis=2) == 0)
    assert np.array_equal(pairing(L, beta, beta), pairing(K, alpha, alpha))
    assert np.array_equal(beta.toarray()[:, : K.n_edges], alpha.toarray())
    # Three triangles of a third of the area; flat at the new vertices, as before at the others.
    np.testing.assert_allclose(face_areas(L)[faces], face_areas(K)[faces] / 3, rtol=1e-13)
    np.testing.assert_allclose(face_areas(L).sum(), face_areas(K).sum(), rtol=1e-13)
    theta = np.r_[cone_angles(K), np.full(faces.size, 2 * np.pi)]
    np.testing.assert_allclose(cone_angles(L), theta, rtol=1e-13)


def test_barycentres_on_surfaces_with_boundary():
    K = ip.DeltaComplex.from_mesh(np.eye(3), [[0, 1, 2]])
    L, _ = insert_barycentres(K, csr_array((0, 3)), np.array([0]))
    assert (L.n_boundary_edges, L.euler_characteristic, L.n_faces) == (3, 1, 3)
    assert L.positions is None
    assert L.labels.tolist() == [0, 1, 2, -1]


def test_all_barycentres_and_flips_are_the_subdivision_by_root_three():
    K = flat_torus(0.5 + 0.75**0.5 * 1j, 4)
    L, cochains = intrinsic_delaunay(
        *insert_barycentres(K, ip.cohomology_basis(K), np.arange(K.n_faces))
    )
    np.testing.assert_allclose(L.lengths, K.lengths[0, 0] / 3**0.5, rtol=1e-13)
    assert L.n_faces == 3 * K.n_faces
    assert np.array_equal(pairing(L, cochains, cochains), standard_form(1))


def test_local_refinement_restores_the_order_of_convergence():
    # One vertex of total angle 6π: with N faces the bound falls like N^(−1/3) if all triangles
    # are divided, and like N^(−1) if those are that hold half of it.
    K = ip.DeltaComplex.from_squares(L_SHAPE, 2)
    slopes, results = [], []
    for local in (True, False):
        refined = refined_period_matrix(K, 1e-9, largest=6000, local=local)
        n, bound = np.array(refined.steps[len(refined.steps) // 2 :]).T
        assert np.all(np.diff(bound) < 0)
        slopes.append(np.polyfit(np.log(n), np.log(bound), 1)[0])
        results.append(refined)
    assert abs(slopes[0] + 1) < 0.08
    assert abs(slopes[1] + 1 / 3) < 0.03
    assert results[0].period_matrix.bound < results[1].period_matrix.bound / 15
    assert results[0].complex.n_faces == 6000


@pytest.mark.parametrize("seed", [1, 5])
def test_refined_matrices_are_within_each_others_bounds(seed):
    K = random_genus_two(seed)
    coarse = ip.period_matrix(K)
    refined = refined_period_matrix(K, coarse.bound / 30).period_matrix
    assert refined.bound <= coarse.bound / 30
    assert refined.complex is K
    assert np.array_equal(refined.cocycles.toarray(), coarse.cocycles.toarray())
    # A third route: elements of high degree on the triangulation as it was.
    D = high_order_matrix(high_order_forms(K, coarse.cocycles, 8))
    accurate = PeriodMatrix(D, True, coarse.cocycles, K)
    for one, other in ((coarse, refined), (coarse, accurate), (refined, accurate)):
        excess = np.abs(one.matrix - other.matrix) - one.entry_bounds - other.entry_bounds
        assert excess.max() < 0
    assert accurate.bound < refined.bound


def test_refinement_stops_at_the_size_limit():
    K = ip.DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.15, 2))
    for local in (True, False):
        refined = refined_period_matrix(K, 1e-12, largest=700, local=local)
        assert refined.complex.n_faces <= 700
        assert refined.steps[-1] == (refined.complex.n_faces, refined.period_matrix.bound)


def test_refinement_of_what_is_good_enough_does_nothing():
    K = flat_torus(1j, 3)
    refined = refined_period_matrix(K, 1e-6)
    assert refined.complex is K
    sphere = ip.DeltaComplex.from_lengths(
        np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    )
    assert refined_period_matrix(sphere, 1e-6).period_matrix.genus == 0


def test_refinement_refuses_what_makes_no_sense():
    K = flat_torus(1j, 3)
    with pytest.raises(ValueError, match="must be positive, not 0"):
        refined_period_matrix(K, 0.0)
    with pytest.raises(ip.ComplexError, match="have 2 columns, but the complex has 27 edges"):
        insert_barycentres(K, csr_array((1, 2)), np.array([0]))
    with pytest.raises(ip.ComplexError, match="not closed"):
        mesh_quality(ip.DeltaComplex.from_mesh(np.eye(3), [[0, 1, 2]]))
    with pytest.raises(ip.ComplexError, match="not closed"):
        refined_period_matrix(ip.DeltaComplex.from_mesh(np.eye(3), [[0, 1, 2]]), 1e-3)


def advice_about(K):
    return " ".join(advice(mesh_quality(K)))


def test_advice_names_what_limits_the_accuracy():
    words = advice_about(ip.DeltaComplex.from_squares(L_SHAPE, 4))
    assert "1 vertex of total angle above 450°, the largest 1080°" in words
    assert "like h^0.67" in words
    assert "to blame" not in words

    V, F = torus_of_revolution(2.0, 0.7, 40, 16)
    words = advice_about(ip.DeltaComplex.from_mesh(V, F))
    assert "the mesh is as coarse as it is" in words
    assert "total angle above" not in words

    words = advice_about(ip.DeltaComplex.from_mesh(*torus_of_revolution(2.0, 0.7, 200, 4)))
    assert "with an angle below 10° in every triangulation" in words

    V, F = noisy_torus(8, 6, 0.15, 2)
    quality = mesh_quality(ip.DeltaComplex.from_mesh(V, F))
    assert quality.flips >= quality.non_delaunay_edges > 0
    assert f"{quality.non_delaunay_edges} of 144 edges of the mesh are not Delaunay" in " ".join(
        advice(quality)
    )


def test_advice_about_degenerate_triangles_and_spheres():
    K = flat_torus(1j, 3)
    lengths = K.lengths.copy()
    # The diagonal of one cell is as long as two sides of it together.
    longest = np.argmax(K.lengths[0])
    pair = [longest, int(K.twin[0, longest])]
    lengths.ravel()[pair] = np.delete(K.lengths[0], longest).sum()
    degenerate = ip.DeltaComplex.from_gluing(lengths, K.twin)
    assert degenerate.mollification > 0
    assert "Some triangles are degenerate" in advice_about(degenerate)
    sphere = ip.DeltaComplex.from_lengths(
        np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    )
    assert "a sphere" in advice_about(sphere)
    assert mesh_quality(sphere).bound == 0


def test_most_of_the_bound_can_come_from_few_triangles():
    K = refined_period_matrix(ip.DeltaComplex.from_squares(L_SHAPE, 20), 1.0).complex
    quality = mesh_quality(K)
    assert quality.half_of_the_bound < 0.05 * K.n_faces
    assert "refining just those places" in " ".join(advice(quality))
    worst = np.argsort(quality.excess)[-quality.half_of_the_bound :]
    assert quality.part(np.isin(np.arange(quality.excess.size), worst)) >= 0.5
