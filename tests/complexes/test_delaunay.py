"""Intrinsic Delaunay flips: the same surface, the same classes, no bad edge left."""

import igl
import numpy as np
import pytest
from support.random_surfaces import (
    L_SHAPE,
    noisy_torus,
    random_gluing,
    random_lengths,
    torus_of_revolution,
)

import igl_periods as ip
from igl_periods.complexes import delaunay
from igl_periods.complexes.delaunay import delaunay_flips, intrinsic_delaunay
from igl_periods.complexes.triangles import double_areas
from igl_periods.complexes.weights import cone_angles, cotan_weights
from igl_periods.harmonic.laplace_matrix import laplacian
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.cohomology import cochains_and_basis, pairing


def check_flipped(K, cochains):
    flipped, carried = intrinsic_delaunay(K, cochains)
    assert cotan_weights(flipped).min() > -1e-11
    twin = flipped.twin.ravel()
    assert np.array_equal(twin[twin], np.arange(twin.size))
    assert np.array_equal(flipped.edge.ravel()[twin], flipped.edge.ravel())
    assert np.array_equal(flipped.sign.ravel()[twin], -flipped.sign.ravel())
    assert np.array_equal(flipped.lengths.ravel()[twin], flipped.lengths.ravel())
    start = np.roll(flipped.corner_vertex, -1, 1).ravel()
    end = np.roll(flipped.corner_vertex, 1, 1).ravel()
    assert np.array_equal(start[twin], end)
    np.testing.assert_allclose(cone_angles(flipped), cone_angles(K), rtol=1e-9)
    np.testing.assert_allclose(
        double_areas(flipped.lengths).sum(), double_areas(K.lengths).sum(), rtol=1e-10
    )
    around = (flipped.sign[..., None] * carried.toarray().T[flipped.edge]).sum(axis=1)
    assert not around.any()
    assert np.array_equal(pairing(flipped, carried, carried), pairing(K, cochains, cochains))
    return flipped, carried


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("shape", [(3, 3), (5, 4), (9, 6)])
def test_noisy_tori(shape, seed):
    K = ip.DeltaComplex.from_mesh(*noisy_torus(*shape, 0.3, seed))
    check_flipped(K, ip.cohomology_basis(K))


@pytest.mark.parametrize("seed", range(15))
def test_random_gluings(seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(int(2 * rng.integers(1, 30)), rng)
    for K in ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components():
        flipped, carried = check_flipped(K, ip.cohomology_basis(K))
        assert np.array_equal(pairing(flipped, carried, carried), standard_form(K.genus))


@pytest.mark.parametrize("seed", range(6))
def test_laplacian_is_that_of_libigl_after_flips(seed):
    V, F = noisy_torus(12, 8, 0.15, seed)
    K = ip.DeltaComplex.from_mesh(V, F)
    flipped, _ = delaunay_flips(K)
    assert flipped is not K
    theirs, _, _ = igl.intrinsic_delaunay_cotmatrix(V, F)
    difference = abs(laplacian(flipped, cotan_weights(flipped)) + theirs).max()
    assert difference < 1e-12 * abs(theirs).max()


@pytest.mark.parametrize(
    "name", ["eight.off", "fertility.off", "rocker-arm.obj", "bob_small.ply", "Csaszar.ply"]
)
def test_laplacian_of_real_meshes_is_that_of_libigl(mesh, name):
    V, F = mesh(name)
    flipped, _ = delaunay_flips(ip.DeltaComplex.from_mesh(V, F))
    theirs, _, _ = igl.intrinsic_delaunay_cotmatrix(V, F)
    difference = abs(laplacian(flipped, cotan_weights(flipped)) + theirs).max()
    assert difference < 1e-12 * abs(theirs).max()


def test_a_delaunay_complex_is_left_alone():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 3)
    cochains, _ = cochains_and_basis(K)
    flipped, carried = intrinsic_delaunay(K, cochains)
    assert flipped is K
    assert carried is cochains


def test_flips_lower_the_dirichlet_energy():
    # Rippa's theorem: for every function on the vertices.
    K = ip.DeltaComplex.from_mesh(*noisy_torus(10, 7, 0.2, 3))
    flipped, _ = delaunay_flips(K)
    before, after = (laplacian(L, cotan_weights(L)).toarray() for L in (K, flipped))
    assert np.linalg.eigvalsh(before - after)[0] > -1e-10 * np.abs(before).max()


def test_a_sheared_torus_comes_back_to_its_short_edges():
    # The unit square torus cut along (1, 0) and (k, 1): flips must undo the shear.
    k = 37
    sides = [np.hypot(1, 0), np.hypot(k, 1), np.hypot(k + 1, 1)]
    twin = [[3, 4, 5], [0, 1, 2]]
    K = ip.DeltaComplex.from_gluing([sides, sides], twin)
    flipped, rounds = delaunay_flips(K)
    assert len(rounds) >= k - 1
    np.testing.assert_allclose(np.sort(flipped.lengths[0]), [1, 1, np.sqrt(2)], rtol=1e-10)
    pm = ip.period_matrix(K)
    assert abs(pm.reduced().matrix[0, 0] - 1j) < 1e-10


def test_flips_end_where_rounding_decides():
    # Nearly all angles of these triangles are decided by the last bits of their lengths.
    V, F = torus_of_revolution(2e9, 1.0, 16, 8)
    flipped, rounds = delaunay_flips(ip.DeltaComplex.from_mesh(V, F))
    assert len(rounds) < 1000
    assert np.isfinite(flipped.lengths).all()


def test_flips_that_do_not_end_are_given_up(monkeypatch):
    monkeypatch.setattr(delaunay, "_MOST_ROUNDS", -89)
    with pytest.raises(ip.ComplexError, match="did not end in 1 rounds"):
        delaunay_flips(ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.5, 1)))


def test_two_runs_give_the_same_bits():
    V, F = noisy_torus(15, 9, 0.2, 2)
    one, other = (delaunay_flips(ip.DeltaComplex.from_mesh(V, F))[0] for _ in range(2))
    assert one.lengths.tobytes() == other.lengths.tobytes()
    assert one.twin.tobytes() == other.twin.tobytes()
