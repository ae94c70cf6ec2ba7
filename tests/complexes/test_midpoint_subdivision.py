"""Midpoint refinement: the same surface, the same cohomology classes.  Exact wherever possible."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.random_surfaces import BOLZA, L_SHAPE, noisy_torus, random_gluing, random_lengths
from support.subdivided_points import locate

import igl_periods as ip
from igl_periods.complexes.midpoint_subdivision import split
from igl_periods.complexes.surface_checks import is_orientable
from igl_periods.complexes.triangles import double_areas
from igl_periods.complexes.weights import cone_angles, cotan_weights
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.potentials import harmonic_potentials
from igl_periods.topology.cohomology import pairing


def _surfaces():
    yield ip.DeltaComplex.from_squares(L_SHAPE)
    yield ip.DeltaComplex.from_squares(BOLZA, 2)
    yield ip.DeltaComplex.from_mesh(*noisy_torus(5, 4, 0.1, 0))
    rng = np.random.default_rng(5)
    for n_faces in (2, 2, 2, 6, 10):
        twin = random_gluing(n_faces, rng)
        yield from ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()


SURFACES = list(_surfaces())


def test_surfaces_include_faces_glued_to_themselves():
    glued = [np.any(K.twin // 3 == np.arange(K.n_faces)[:, None]) for K in SURFACES]
    assert any(glued)
    assert any(K.n_vertices == 1 for K in SURFACES)


@pytest.mark.parametrize("K", SURFACES)
def test_invariants_of_the_complex(K):
    refined, _ = split(K, ip.cohomology_basis(K))
    # The checked constructor numbers edges and vertices in its own way; all else must agree.
    checked = ip.DeltaComplex.from_gluing(refined.lengths, refined.twin)
    assert np.array_equal(checked.sign, refined.sign)
    for ours, theirs in (
        (refined.edge, checked.edge),
        (refined.corner_vertex, checked.corner_vertex),
    ):
        pairs = np.unique(np.stack([ours.ravel(), theirs.ravel()], axis=1), axis=0)
        assert len(pairs) == ours.max() + 1 == theirs.max() + 1
    assert (refined.n_vertices, refined.n_edges) == (checked.n_vertices, checked.n_edges)
    assert refined.n_vertices == K.n_vertices + K.n_edges
    assert refined.genus == K.genus
    assert refined.labels.tolist() == [*K.labels, *[-1] * K.n_edges]


@pytest.mark.parametrize("K", SURFACES)
def test_same_metric(K):
    refined, _ = split(K, ip.cohomology_basis(K))
    angles = cone_angles(refined)
    assert np.allclose(angles[: K.n_vertices], cone_angles(K), rtol=1e-13)
    assert np.allclose(angles[K.n_vertices :], 2 * np.pi, rtol=1e-13)
    areas = double_areas(refined.lengths).reshape(-1, 4)
    assert np.allclose(areas, double_areas(K.lengths)[:, None] / 4, rtol=1e-13)


@pytest.mark.parametrize("K", SURFACES)
def test_cochains_stay_in_their_classes(K):
    basis = ip.cohomology_basis(K)
    refined, carried = split(K, basis)
    assert np.issubdtype(carried.dtype, np.integer)
    for cochain in carried.toarray():
        assert not (refined.sign * cochain[refined.edge]).sum(axis=1).any()
    assert np.array_equal(pairing(refined, carried, carried), pairing(K, basis, basis))
    # The integral over every edge is the sum over its halves, whichever way those run.
    tail, _ = _ends(refined)
    halves = carried.toarray()[:, : 2 * K.n_edges].reshape(-1, K.n_edges, 2)
    starts_at_midpoint = tail[: 2 * K.n_edges].reshape(-1, 2) >= K.n_vertices
    runs = np.where(starts_at_midpoint == [False, True], 1, -1)
    assert np.array_equal((halves * runs).sum(axis=2), basis.toarray())


@pytest.mark.parametrize("K", SURFACES)
def test_finer_trial_functions_have_less_energy(K):
    # The coarse piecewise linear functions are among the fine ones: D_fine ≤ D_coarse (Loewner).
    basis = ip.cohomology_basis(K)
    if basis.shape[0] == 0:
        return
    coarse, fine = (
        dirichlet_matrix(L, c, harmonic_potentials(L, cotan_weights(L), c))
        for L, c in ((K, basis), split(K, basis))
    )
    assert np.linalg.eigvalsh(coarse - fine)[0] > -1e-12 * np.linalg.norm(coarse)


def test_positions_are_midpoints():
    V, F = noisy_torus(5, 4, 0.1, 0)
    K = ip.DeltaComplex.from_mesh(V, F)
    refined, _ = split(K, ip.cohomology_basis(K))
    corners = refined.positions[refined.corner_vertex]
    sides = np.linalg.norm(np.roll(corners, 1, axis=1) - np.roll(corners, -1, axis=1), axis=2)
    assert np.allclose(sides, refined.lengths, rtol=1e-13)
    assert np.array_equal(refined.positions[: len(V)], V)


def test_points_are_located_in_the_children():
    V, F = noisy_torus(5, 4, 0.1, 0)
    K = ip.DeltaComplex.from_mesh(V, F)
    refined, _ = split(K, ip.cohomology_basis(K))
    rng = np.random.default_rng(0)
    face, weights = rng.integers(0, K.n_faces, 200), rng.dirichlet([1, 1, 1], 200)
    child, located = locate(face, weights)
    assert np.array_equal(child // 4, face)
    assert set(child % 4) == {0, 1, 2, 3}
    assert located.min() >= 0
    assert np.allclose(located.sum(axis=1), 1, rtol=1e-14)
    for L, f, w in ((K, face, weights), (refined, child, located)):
        points = np.einsum("ns,nsd->nd", w, L.positions[L.corner_vertex[f]])
        assert np.allclose(points, np.einsum("ns,nsd->nd", weights, V[F[face]]), atol=1e-13)


def test_boundary_and_orientation_survive():
    # A square of two triangles: with free sides, a Möbius band by gluing left and right reversed.
    free = np.full((2, 3), -1)
    free[0, 1], free[1, 2] = 5, 1
    K = ip.DeltaComplex.from_gluing([[1, np.sqrt(2), 1], [1, 1, np.sqrt(2)]], free)
    refined, _ = split(K, csr_array((0, K.n_edges), dtype=np.int64))
    assert (refined.n_boundary_edges, refined.euler_characteristic) == (8, 1)
    strip = np.array([[2 * i, 2 * i + 2, 2 * i + 1] for i in range(5)] +
                     [[2 * i + 1, 2 * i + 2, 2 * i + 3] for i in range(5)])  # fmt: skip
    strip[strip == 10], strip[strip == 11] = 1, 0
    K = ip.DeltaComplex.from_lengths(np.ones((10, 3)), strip)
    refined, _ = split(K, csr_array((0, K.n_edges), dtype=np.int64))
    assert (K.n_boundary_edges, K.euler_characteristic, is_orientable(K)) == (10, 0, False)
    assert (refined.n_boundary_edges, refined.euler_characteristic) == (20, 0)
    assert not is_orientable(refined)


def test_cochains_of_another_complex_are_refused():
    K = ip.DeltaComplex.from_squares(L_SHAPE)
    with pytest.raises(ip.ComplexError, match="7 columns, but the complex has 9 edges"):
        split(K, csr_array((2, 7), dtype=np.int64))


def _ends(K):
    forward = np.flatnonzero(K.sign.ravel() > 0)
    tail, head = np.empty((2, K.n_edges), dtype=np.int64)
    tail[K.edge.ravel()[forward]] = np.roll(K.corner_vertex, -1, 1).ravel()[forward]
    head[K.edge.ravel()[forward]] = np.roll(K.corner_vertex, 1, 1).ravel()[forward]
    return tail, head
