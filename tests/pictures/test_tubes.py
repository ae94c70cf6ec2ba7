"""Tubes around curves, and smoothing that keeps curves on the surface."""

import numpy as np
import pytest
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.pictures.scenes import cycles_scene
from igl_periods.pictures.tubes import smooth_closed_curves, tube


def test_smoothed_cycles_stay_on_the_torus_and_in_their_classes(torus):
    scene = cycles_scene(torus)
    windings = []
    for curve in scene.tubes:
        x, y, z = curve.points.T
        distance = np.hypot(x, y)
        # The mesh is inscribed in the torus, of radius 0.7 around the circle of radius 2.
        assert np.all(np.abs(np.hypot(distance - 2.0, z) - 0.7) < 0.03)
        assert np.all(np.abs(np.linalg.norm(curve.normals, axis=1) - 1) < 1e-12)
        loop = [winding(np.arctan2(y, x)), winding(np.arctan2(z, distance - 2.0))]
        windings.append(loop)
    # A basis of the homology of the torus; both are shortest, so one is a meridian.
    assert abs(round(np.linalg.det(windings))) == 1
    assert [0, 1] in np.abs(windings).tolist()


def winding(angle):
    steps = np.diff(np.append(angle, angle[0]))
    return int(np.rint(np.sum((steps + np.pi) % (2 * np.pi) - np.pi) / (2 * np.pi)))


def test_smoothing_shortens_curves():
    V, F = torus_of_revolution(2.0, 0.7, 40, 20)
    u = np.linspace(0, 2 * np.pi, 50, endpoint=False)
    v = 0.3 * np.sin(9 * u)
    ring = 2.0 + 0.7 * np.cos(v)
    wavy = np.stack([ring * np.cos(u), ring * np.sin(u), 0.7 * np.sin(v)], axis=1)
    ((points, _, _, _),) = smooth_closed_curves(V, F, [wavy])
    lengths = [
        np.linalg.norm(np.diff(c, axis=0, append=c[:1]), axis=1).sum() for c in (wavy, points)
    ]
    assert 2 * np.pi * 2.6 < lengths[1] < 0.97 * lengths[0]
    assert smooth_closed_curves(V, F, []) == []


def test_tubes_are_tori_of_the_right_thickness():
    t = 2 * np.pi * np.arange(100) / 100
    circle = np.stack([3 * np.cos(t), 3 * np.sin(t), 0 * t], axis=1)
    V, F = tube(circle, np.tile([0.0, 0, 1], (100, 1)), 0.2, closed=True)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert K.genus == 1
    away = np.hypot(np.hypot(V[:, 0], V[:, 1]) - 3.0, V[:, 2])
    np.testing.assert_allclose(away, 0.2, rtol=1e-12)
    # Outward normals: the enclosed volume is positive, 2π² R r² but for the polygons.
    volume = np.einsum("fi,fi->", V[F[:, 0]], np.cross(V[F[:, 1]], V[F[:, 2]])) / 6
    assert volume == pytest.approx(2 * np.pi**2 * 3 * 0.04, rel=0.06)
    V, F = tube(circle[:30], np.tile([0.0, 0, 1], (30, 1)), 0.2, closed=False)
    assert ip.DeltaComplex.from_mesh(V, F).n_boundary_edges == 24
