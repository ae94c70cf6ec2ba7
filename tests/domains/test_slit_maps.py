"""Slit maps: where boundary loops go, and that nothing is folded."""

import numpy as np
import pytest
from support.random_domains import circle, random_domain, square
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.domains import boundary_loops, extremal_length
from igl_periods.domains.slit_maps import circular_slit_map, parallel_slit_map, radial_slit_map
from igl_periods.surfaces import planar_domain


def domain(seed, area=1.0):
    outer, holes = random_domain(np.random.default_rng(seed))
    return planar_domain(outer, holes, area=area)


SEEDS = [s for s in range(8) if len(random_domain(np.random.default_rng(s))[1]) > 1][:1]


def share_kept_upright(m):
    """Part of the triangles whose images have the same orientation."""
    z = m.values[m.complex.corner_vertex]
    area = np.imag(np.conj(z[:, 1] - z[:, 0]) * (z[:, 2] - z[:, 0]))
    return np.mean(area > 0)


def winding(z):
    return np.rint(np.angle(np.roll(z, -1) / z).sum() / (2 * np.pi))


@pytest.mark.parametrize("seed", SEEDS)
def test_annulus_with_circular_slits(seed):
    m = circular_slit_map(domain(seed), degree=4)
    radii = [np.abs(m.values[loop.vertices]) for loop in m.loops]
    for r in radii:
        assert np.ptp(r) < 1e-8
    assert radii[0][0] == pytest.approx(1, abs=1e-8)
    assert min(r.mean() for r in radii) == radii[1].mean()
    assert [winding(m.values[loop.vertices]) for loop in m.loops] == (
        [1, -1] + [0] * (len(radii) - 2)
    )
    assert np.all((np.abs(m.values) < 1 + 1e-6) & (np.abs(m.values) > radii[1].mean() - 1e-6))
    assert share_kept_upright(m) > 0.97


@pytest.mark.parametrize("seed", SEEDS)
def test_annulus_with_radial_slits(seed):
    m = radial_slit_map(domain(seed), degree=4)
    for k, loop in enumerate(m.loops):
        w = m.values[loop.vertices]
        if k < 2:
            assert np.ptp(np.abs(w)) < 1e-8
            assert winding(w) == (1 if k == 0 else -1)
        else:
            assert np.ptp(np.angle(w / w[0])) < 1e-3
            assert np.ptp(np.abs(w)) > 1e-3
    assert share_kept_upright(m) > 0.97


@pytest.mark.parametrize("seed", SEEDS)
def test_rectangle_with_parallel_slits(seed):
    V, F = domain(seed)
    corners = [0, 2, 3, 5]
    m = parallel_slit_map(V, F, corners, degree=4)
    h = extremal_length(V, F, corners, degree=4).value
    z = m.values[corners]
    assert np.allclose(z.real, [0, 0, 1, 1], atol=1e-8)
    assert np.allclose(z.imag, [1 / h, 0, 0, 1 / h], atol=2e-3 / h)
    for loop in m.loops[1:]:
        w = m.values[loop.vertices]
        assert np.ptp(w.imag) < 2e-3 / h
        assert np.ptp(w.real) > 1e-2
    assert share_kept_upright(m) > 0.97


def test_round_annuli_and_rectangles_are_mapped_by_similarities():
    n = 48
    V, F = planar_domain(circle(n), [circle(n, 0.4)], area=0.05)
    z = V @ [1, 1j]
    for m in (circular_slit_map(V, F, degree=3), radial_slit_map(V, F, degree=3)):
        assert np.abs(m.values - z / z[0]).max() < 5e-3
    V, F = planar_domain(square(0, 0, 2), area=0.1)
    m = parallel_slit_map(V, F, [3, 0, 1, 2])
    assert np.allclose(m.values, V @ [1, 1j] / 2, atol=1e-10)


def test_refusals():
    V, F = domain(SEEDS[0])
    with pytest.raises(ip.ComplexError, match="inner = 9"):
        circular_slit_map(V, F, 9)
    with pytest.raises(ip.ComplexError, match="inner = 1: of 1 boundary loops"):
        radial_slit_map(planar_domain(square(0, 0, 1)))
    W, G = noisy_torus(9, 8, 0.1, 1)
    with pytest.raises(ip.ComplexError, match="has genus 1"):
        circular_slit_map(W, np.delete(G, [0, 60], axis=0))
    with pytest.raises(ip.ComplexError, match="four corners"):
        parallel_slit_map(V, F, [0, 1])


def test_shown():
    m = circular_slit_map(domain(SEEDS[0]), degree=2)
    assert "boundary loops" in repr(m)
    assert len(m.loops) == len(boundary_loops(m.complex))
