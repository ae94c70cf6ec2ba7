"""Barycentres: the same surface and classes, with three faces for one."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.surfaces_with_bounds import random_genus_two

import igl_periods as ip
from igl_periods.complexes.barycentre_insertion import insert_barycentres
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.surface_checks import check_surface
from igl_periods.complexes.weights import cone_angles
from igl_periods.harmonic.constant_forms import face_areas
from igl_periods.surfaces import flat_torus
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.cohomology import pairing


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
