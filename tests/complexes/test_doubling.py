"""The double: the involution, what is lifted, genus and labels."""

import pickle
from dataclasses import replace
from fractions import Fraction

import flint
import numpy as np
import pytest
from scipy.sparse import csr_array
from support.flat_surfaces import flat_strip
from support.random_surfaces import noisy_torus, random_gluing, random_lengths
from support.surfaces_with_holes import annulus_pair, tau_inside_certificate

import igl_periods as ip
from igl_periods.complexes import by_kind, root_of
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.doubling import double, involution, lift
from igl_periods.complexes.surface_checks import check_surface
from igl_periods.moduli.equivalence import symplectic_isomorphisms
from igl_periods.topology.cohomology import pairing


def random_surface(seed):
    """Triangles glued at random, some sides free and some reversing the orientation."""
    rng = np.random.default_rng(seed)
    twin = random_gluing(12, rng)
    lengths = random_lengths(twin, rng)
    half_edge = np.arange(twin.size).reshape(-1, 3)
    label = np.minimum(half_edge, twin)
    same = rng.random(twin.size)[label] < 0.3
    free = rng.random(twin.size)[label] < 0.2
    return ip.DeltaComplex.from_gluing(
        lengths, np.where(free, -1, twin), np.where(free, False, same)
    )


@pytest.mark.parametrize("seed", range(30))
def test_involution_is_an_isometry_without_fixed_faces(seed):
    K = random_surface(seed)
    L = double(K)
    assert L.n_boundary_edges == L.n_reversing_edges == 0
    # χ(L) = 2 χ(K) − χ(∂K), and a closed curve has χ = 0.
    assert L.euler_characteristic == 2 * K.euler_characteristic
    sigma = involution(L)
    for image in (sigma.face, sigma.vertex, sigma.half_edge, sigma.edge):
        assert np.array_equal(image[image], np.arange(image.size))
    assert np.all(sigma.face != np.arange(L.n_faces))
    assert np.array_equal(L.lengths.ravel()[sigma.half_edge], L.lengths.ravel())
    assert np.array_equal(sigma.sign[sigma.edge], sigma.sign)
    # Exactly the boundary stays fixed, point by point.
    fixed = sigma.edge == np.arange(L.n_edges)
    assert np.count_nonzero(fixed & (sigma.sign > 0)) == K.n_boundary_edges
    # σ maps the start of an edge to the start of its image, if it keeps the direction.
    start, end = np.empty((2, L.n_edges), dtype=int)
    h = np.flatnonzero(L.sign.ravel() > 0)
    start[L.edge.ravel()[h]] = np.roll(L.corner_vertex, -1, 1).ravel()[h]
    end[L.edge.ravel()[h]] = np.roll(L.corner_vertex, 1, 1).ravel()[h]
    expected = np.where(sigma.sign > 0, start[sigma.edge], end[sigma.edge])
    assert np.array_equal(sigma.vertex[start], expected)


@pytest.mark.parametrize("seed", range(10))
def test_lifted_cochains_are_closed_and_invariant(seed):
    K = random_surface(seed)
    L = double(K)
    f = np.random.default_rng(seed).integers(-9, 9, K.n_vertices)
    start, end = np.roll(K.corner_vertex, -1, 1), np.roll(K.corner_vertex, 1, 1)
    exact = np.empty(K.n_edges, dtype=int)
    exact[K.edge] = K.sign * (f[end] - f[start])
    lifted = lift(K, L, csr_array(exact[None]))
    around = (L.sign * lifted.toarray()[0][L.edge]).sum(axis=1)
    assert np.all(around == 0)
    moved = involution(L).pull_back(lifted)
    assert np.array_equal(moved.toarray(), lifted.toarray())
    # Restricted to the first sheet they are what they were.
    along = (L.sign * lifted.toarray()[0][L.edge])[: K.n_faces]
    assert np.array_equal(along, K.sign * exact[K.edge])


def test_pairing_changes_sign():
    L = double(annulus_pair())
    omega = ip.cohomology_basis(L)
    moved = involution(L).pull_back(omega)
    assert np.array_equal(pairing(L, moved, moved), -pairing(L, omega, omega))


def test_orientation_does_not_matter():
    # Faces turned over give the same double up to the names of its parts.
    K = flat_strip(1.7, 0.9, 5, 4, glue_x="straight")
    turned = np.where(np.arange(K.n_faces)[:, None] % 3 == 0, [0, 2, 1], [0, 1, 2])
    L = ip.DeltaComplex.from_lengths(
        np.take_along_axis(K.lengths, turned, 1), np.take_along_axis(K.corner_vertex, turned, 1)
    )
    assert L.n_reversing_edges > 0
    one, other = (ip.period_matrix(double(surface)) for surface in (K, L))
    assert tau_inside_certificate(one, 2j * 0.9 / 1.7)
    assert tau_inside_certificate(other, 2j * 0.9 / 1.7)


def test_double_of_a_closed_surface_is_two_mirror_images():
    K = ip.DeltaComplex.from_mesh(*noisy_torus(7, 6, 0.1, 1))
    L = double(K)
    with pytest.raises(ip.ComplexError, match="2 components"):
        ip.period_matrix(L)
    one, mirror = L.components()
    tau, other = (ip.period_matrix(part) for part in (one, mirror))
    assert np.array_equal(one.twin, K.twin)
    assert symplectic_isomorphisms(tau, other, tolerance=1e-9, reversing=True)
    assert not symplectic_isomorphisms(tau, other, tolerance=1e-9)


def test_genus_and_labels():
    # The double of a surface of genus g with b ≥ 1 boundary loops has genus 2g + b − 1.
    V, F = noisy_torus(7, 6, 0.1, 1)
    V = np.concatenate([[[9.0, 9, 9]], V])
    K = ip.DeltaComplex.from_mesh(V, np.delete(F, [0, 40], axis=0) + 1)
    L = double(K)
    check_surface(L)
    assert L.genus == 3
    assert np.array_equal(V[L.labels], L.positions)
    assert L.n_vertices == 2 * K.n_vertices - 6


def test_what_is_no_double_is_refused():
    L = double(annulus_pair())
    flipped, _ = intrinsic_delaunay(L, ip.cohomology_basis(L))
    assert flipped is not L
    for K in (flipped, ip.DeltaComplex.from_mesh(*noisy_torus(5, 5, 0.1, 1))):
        with pytest.raises(ip.ComplexError, match="is not a double"):
            involution(K)
    with pytest.raises(ip.ComplexError, match="of 7 faces, is not a double"):
        involution(ip.DeltaComplex.from_lengths(np.ones((7, 3)), np.arange(21).reshape(7, 3)))


def test_the_double_has_the_exact_lengths_of_what_lies_below():
    # A square of two triangles; its diagonal is √2, which no double is.
    K = ip.DeltaComplex.from_lengths([[2**0.5, 1, 1]] * 2, [[0, 1, 2], [3, 2, 1]])
    kind = np.array([[1, 0, 0]] * 2)
    K = replace(
        K, exact_lengths=by_kind(K.edge, kind, (root_of(Fraction(1)), root_of(Fraction(2))))
    )
    L = double(K)
    balls = L.exact_lengths(200)
    assert len(balls) == L.n_edges
    stored = np.empty(L.n_edges)
    stored[L.edge] = L.lengths
    assert np.allclose([float(x.mid()) for x in balls], stored, rtol=1e-15)
    root = [x for x in balls if x > 1.2]
    with flint.ctx.workprec(200):
        assert all((x * x).contains(2) for x in root)
    assert (len(root), len(balls)) == (2, 6)
    assert pickle.loads(pickle.dumps(L)).exact_lengths(80)[0].overlaps(balls[0])
    assert double(random_surface(0)).exact_lengths is None
