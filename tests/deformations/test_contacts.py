"""Distances of triangles, and the energy of contacts."""

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

from igl_periods.deformations.contacts import contact_energy, triangle_distances

V, F = noisy_torus(9, 7, 0.2, 0)


def test_distances_are_the_least_over_both_triangles():
    rng = np.random.default_rng(0)
    one, other = rng.normal(size=(2, 12, 3, 3))
    other += 2.5
    distance, b, c = triangle_distances(one, other)
    for weights in (b, c):
        assert (weights >= 0).all() and np.allclose(weights.sum(axis=1), 1.0)
    closest = np.einsum("kc,kci->ki", b, one) - np.einsum("kc,kci->ki", c, other)
    assert np.allclose(np.linalg.norm(closest, axis=1), distance)
    w = np.concatenate([rng.dirichlet([0.5] * 3, size=300), np.eye(3)])
    p, q = (np.einsum("nc,kci->kni", w, triangle) for triangle in (one, other))
    sampled = np.linalg.norm(p[:, :, None] - q[:, None], axis=3).min(axis=(1, 2))
    assert (sampled >= distance - 1e-12).all() and (sampled < distance + 0.2).all()


def test_facing_sides_and_corners_over_faces():
    """Crossed sides at distance 1 across their middles; a corner 2 above a face."""
    flat = np.array([[-1.0, 0, 0], [1, 0, 0], [0, -5, -5]])
    across = np.array([[0.0, -1, 1], [0, 1, 1], [0, 0, 9]])
    above = np.array([[0.0, 0, 2], [5, 5, 9], [-5, 5, 9]])
    level = np.array([[-3.0, -3, 0], [3, -3, 0], [0, 3, 0]])
    distance, b, _ = triangle_distances(np.stack([flat, level]), np.stack([across, above]))
    assert np.allclose(distance, [1.0, 2.0]) and np.allclose(b[0], [0.5, 0.5, 0.0])


def test_the_gradient_is_the_limit_of_differences():
    rng = np.random.default_rng(1)
    dV, h = rng.normal(size=V.shape), 1e-7
    energy, gradient = contact_energy(V, F, 0.6)
    assert energy > 0
    ahead, back = (contact_energy(V + t * dV, F, 0.6)[0] for t in (h, -h))
    assert np.sum(gradient * dV) == pytest.approx((ahead - back) / (2 * h), rel=1e-5)


def test_nothing_is_in_reach():
    energy, gradient = contact_energy(V, F, 1e-9)
    assert energy == 0.0 and not gradient.any()
