"""Slit planes and discs: exact values of squares, Koebe's relation, harmonic measures."""

import numpy as np
import pytest
from scipy.special import gamma
from support.random_domains import random_domain, square
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.domains import boundary_loops, capacity_matrix, harmonic_measures
from igl_periods.domains.slit_planes import (
    circular_slit_disc,
    circular_slit_plane,
    parallel_slit_plane,
    radial_slit_disc,
    radial_slit_plane,
)
from igl_periods.surfaces import planar_domain

MAPS = (parallel_slit_plane, circular_slit_disc, radial_slit_disc)


@pytest.fixture(scope="module")
def pierced():
    """A domain with three holes, and a vertex in the interior that is far from all of them."""
    outer, holes = random_domain(np.random.default_rng(2))
    assert len(holes) == 3
    K = ip.DeltaComplex.from_mesh(*planar_domain(outer, holes, area=2.5))
    z = K.positions @ [1, 1j]
    ring = np.concatenate([z[loop.vertices] for loop in boundary_loops(K)])
    distance = np.abs(z[:, None] - ring).min(axis=1)
    return K, z[np.argmax(distance)]


# The conformal radius of the unit square at its centre.
RADIUS = 4 * np.sqrt(np.pi) / gamma(0.25) ** 2


def test_square_by_the_gamma_function():
    V, F = planar_domain(square(-0.5, -0.5, 1), area=0.02)
    errors = []
    for degree in (4, 6, 8, 10):
        # The disc is mapped by ζ + 1/ζ onto the plane without [-2, 2].
        w = parallel_slit_plane(V, F, 0, degree=degree).values
        on_slit = w[boundary_loops(ip.DeltaComplex.from_mesh(V, F))[0].vertices]
        assert np.ptp(on_slit.imag) < 1e-12
        errors.append(abs(np.ptp(on_slit.real) - 4 / RADIUS))
    # Exponentially in the degree.
    assert errors[3] < 1e-10
    assert errors[0] > 100 * errors[2] > 10000 * errors[3]


def test_derivative_at_the_point():
    V, F = planar_domain(square(-0.5, -0.5, 1), area=0.02)
    w = circular_slit_disc(V, F, 0, degree=8).values
    z = V @ [1, 1j]
    near = np.argsort(np.abs(z))[1:4]
    # w = z / R + O(z⁵), real on the real axis.
    assert np.allclose(w[near] / z[near], 1 / RADIUS, rtol=np.abs(z[near]).max() ** 4 * 5)
    assert np.array_equal(w, radial_slit_disc(V, F, 0, degree=8).values)


def test_other_points_of_a_simply_connected_domain_differ_by_a_mobius_map():
    V, F = planar_domain(square(-0.5, -0.5, 1), area=0.01)
    a = complex(*V[np.argmin(np.abs(V @ [1, 1j] - 0.2 - 0.1j))])
    one = circular_slit_disc(V, F, 0, degree=10).values
    other = circular_slit_disc(V, F, a, degree=10).values
    at = one[np.argmin(np.abs(V @ [1, 1j] - a))]
    moved = (one - at) / (1 - np.conj(at) * one)
    far = np.abs(moved) > 0.1
    turn = other[far] / moved[far]
    assert np.abs(turn - turn.mean()).max() < 1e-6
    assert abs(turn.mean()) == pytest.approx(1, abs=1e-6)


def upright(m):
    w = m.values[m.complex.corner_vertex]
    w = w[np.isfinite(w).all(axis=1)]
    return np.mean(np.imag(np.conj(w[:, 1] - w[:, 0]) * (w[:, 2] - w[:, 0])) > 0)


def test_koebe_s_relation(pierced):
    # w_θ = e^{iθ}(cos θ w_0 − i sin θ w_{π/2}); the trial functions of all of them are the same.
    K, a = pierced
    straight, upwards = (
        parallel_slit_plane(K, a, angle=t, degree=3).values for t in (0, np.pi / 2)
    )
    for angle in (0.4, 1.1):
        m = parallel_slit_plane(K, a, angle=angle, degree=3)
        finite = np.isfinite(m.values)
        assert np.count_nonzero(~finite) == 1
        parts = np.cos(angle) * straight[finite] - 1j * np.sin(angle) * upwards[finite]
        size = np.abs(m.values[m.loops[0].vertices]).max()
        assert np.abs(np.exp(1j * angle) * parts - m.values[finite]).max() < 1e-12 * size
        for loop in m.loops:
            w = m.values[loop.vertices] * np.exp(-1j * angle)
            assert np.ptp(w.imag) < 1e-12
            assert np.ptp(w.real) > 1e-3


def test_discs_and_harmonic_measures(pierced):
    # log |w| = c_k on C_k with C c = −2π ω(a), C the grounded capacities: another computation.
    K, a = pierced
    m = circular_slit_disc(K, a, degree=6)
    at = np.argmin(np.abs(K.positions @ [1, 1j] - a))
    omega = harmonic_measures(K, 6)[1:, at]
    c = -2 * np.pi * np.linalg.solve(capacity_matrix(K, degree=6).grounded, omega)
    radii = [np.abs(m.values[loop.vertices]) for loop in m.loops]
    for r in radii:
        assert np.ptp(r) < 1e-12
    assert radii[0][0] == pytest.approx(1, abs=1e-14)
    assert np.log([r[0] for r in radii[1:]]) == pytest.approx(c, rel=1e-7)
    assert upright(m) > 0.97
    assert m.values[at] == 0


def test_radial_slits(pierced):
    K, a = pierced
    m = radial_slit_disc(K, a, degree=4)
    assert np.abs(np.abs(m.values[m.loops[0].vertices]) - 1).max() < 1e-12
    for loop in m.loops[1:]:
        w = m.values[loop.vertices]
        assert np.ptp(np.angle(w / w[0])) < 1e-12
        assert np.ptp(np.abs(w)) > 1e-3
    assert upright(m) > 0.97


def test_planes_with_a_zero_and_a_pole(pierced):
    K, a = pierced
    z = K.positions @ [1, 1j]
    b = a + 4 * np.exp(1j)
    for slit_plane, part in ((circular_slit_plane, np.abs), (radial_slit_plane, np.angle)):
        m = slit_plane(K, a, b, degree=4)
        assert not m.is_bounded
        assert m.values[np.argmin(np.abs(z - a))] == 0
        for loop in m.loops:
            w = m.values[loop.vertices]
            assert np.ptp(part(w / w[0])) < 1e-12
            assert np.rint(np.angle(np.roll(w, -1) / w).sum() / (2 * np.pi)) == 0
        # w (z − b) → 1.
        near = np.argsort(np.abs(z - b))[:1]
        assert abs(m.values[near] * (z[near] - b) - 1) < 5 * abs(z[near] - b)


def test_refusals():
    V, F = planar_domain(square(0, 0, 1), [square(0.4, 0.4, 0.2)], area=0.05)
    for slit_map in MAPS:
        with pytest.raises(ip.ComplexError, match=r"the point 0.5\+0.5j is not inside"):
            slit_map(V, F, 0.5 + 0.5j)
        with pytest.raises(ip.ComplexError, match="too close to the boundary"):
            slit_map(V, F, 1e-4 + 0.3j, degree=2)
    with pytest.raises(ip.ComplexError, match="counterclockwise"):
        parallel_slit_plane(V, F[:, [0, 2, 1]], 0.2 + 0.2j)
    with pytest.raises(ip.ComplexError, match="has to lie there"):
        parallel_slit_plane(np.column_stack([V, V[:, 0] ** 2]), F, 0.2 + 0.2j)
    W, G = noisy_torus(9, 8, 0.1, 1)
    with pytest.raises(ip.ComplexError, match="has genus 1"):
        parallel_slit_plane(W, np.delete(G, [0, 60], axis=0), 0.1)
