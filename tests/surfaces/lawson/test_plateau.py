"""Minimal patches: the boundary stays, the area falls, and where it is stationary it ends."""

import numpy as np
import pytest

from igl_periods.complexes.triangles import cotangents
from igl_periods.surfaces.lawson import disc
from igl_periods.surfaces.lawson.plateau import (
    harmonic,
    laplacian,
    minimal,
    on_sides,
    vertex_normals,
)


def sides_of(x, faces):
    corners = x[faces]
    return np.linalg.norm(np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1), axis=2)


def area(patch):
    u, v = (patch.x[patch.faces[:, i]] - patch.x[patch.faces[:, 0]] for i in (1, 2))
    gram = (u * u).sum(axis=1) * (v * v).sum(axis=1) - (u * v).sum(axis=1) ** 2
    return 0.5 * np.sqrt(gram).sum()


@pytest.fixture(scope="module", params=[(2, 1), (1, 3), (3, 2)], ids=str)
def stages(request):
    """A patch as it starts, after the harmonic map, and minimal."""
    m, k = request.param
    start = disc._start(m, k, 4, disc._checked_pattern(m, k, None))
    return start, harmonic(start), minimal(harmonic(start))


def test_vertices_stay_on_the_sphere_and_the_sides_on_their_circles(stages):
    for patch in stages:
        np.testing.assert_allclose(np.linalg.norm(patch.x, axis=1), 1, rtol=0, atol=1e-14)
        on_circles = on_sides(patch.ends, patch.angles).reshape(-1, 4)
        first = patch.n_corners
        np.testing.assert_allclose(
            patch.x[first : first + len(on_circles)], on_circles, rtol=0, atol=1e-14
        )
        assert np.array_equal(patch.x[:first], stages[0].x[:first])
    # The second stage leaves the boundary as the first made it.
    assert np.array_equal(stages[1].angles, stages[2].angles)


def test_the_area_falls_and_is_stationary_in_the_end(stages):
    start, first, last = stages
    assert area(last) <= area(first) * (1 + 1e-14)
    assert area(last) < area(start)
    # The gradient of the area is L x; along inner normals it vanishes.
    cot = cotangents(sides_of(last.x, last.faces))
    gradient = laplacian(last.faces, cot, len(last.x)) @ last.x
    inner = slice(last.n_corners + last.angles.size, None)
    along = (gradient * vertex_normals(last.x, last.faces)).sum(axis=1)
    assert np.abs(along[inner]).max() < 1e-10


def test_the_laplacian_is_symmetric_and_kills_constants(stages):
    patch = stages[-1]
    L = laplacian(patch.faces, cotangents(sides_of(patch.x, patch.faces)), len(patch.x))
    assert abs(L - L.T).max() == 0
    assert np.abs(L @ np.ones(len(patch.x))).max() < 1e-13


def test_normals_are_unit_tangents_of_the_sphere(stages):
    patch = stages[-1]
    normals = vertex_normals(patch.x, patch.faces)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, rtol=0, atol=1e-14)
    assert np.abs((normals * patch.x).sum(axis=1)).max() < 1e-14
