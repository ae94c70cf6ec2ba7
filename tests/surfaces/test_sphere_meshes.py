"""Meshes of the sphere: fine where they must be, and well shaped."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes.triangles import angles, double_areas
from igl_periods.surfaces.cyclic_covers import centred, on_sphere
from igl_periods.surfaces.sphere_meshes import refined_sphere


def random_points(n, seed):
    rng = np.random.default_rng(seed)
    return rng.normal(size=n) + 1j * rng.normal(size=n)


@pytest.mark.parametrize("graded", [False, True])
def test_meshes_are_fine_enough_and_well_shaped(graded):
    seeds = centred(on_sphere(random_points(6, 4)))

    def size(x):
        distance = np.linalg.norm(x[:, None] - seeds, axis=2).min(axis=1)
        return np.clip(0.3 * distance, 0.02, 0.3) if graded else np.full(len(x), 0.1)

    V, F = refined_sphere(seeds, size)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert (K.n_vertices, K.genus) == (len(V), 0)
    assert np.array_equal(V[:6], seeds)
    assert np.abs(np.linalg.norm(V, axis=1) - 1).max() < 1e-14
    assert np.degrees(angles(K.lengths).min()) > 24
    centre = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    centre /= np.linalg.norm(centre, axis=1, keepdims=True)
    assert np.all(np.sum(centre * V[F[:, 0]], axis=1) > 0)  # outward
    radius = np.prod(K.lengths, axis=1) / (2 * double_areas(K.lengths))
    assert np.all(radius <= size(centre) * (1 + 1e-9))
