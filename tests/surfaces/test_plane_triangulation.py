"""Triangulations of plane domains: Delaunay, without small angles where none are given."""

import numpy as np
import pytest
from support.random_domains import circle, random_domain, square

import igl_periods as ip
from igl_periods.surfaces import planar_domain
from igl_periods.surfaces.plane_triangulation import PlaneMesh, Quality, triangulated, turn


def angles(V, F):
    corner = V[F]
    u, v = np.roll(corner, -1, axis=1) - corner, np.roll(corner, 1, axis=1) - corner
    return np.degrees(
        np.arctan2(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0], np.einsum("fsi,fsi->fs", u, v))
    )


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("angle", [25, 30])
def test_no_angle_is_small(seed, angle):
    V, F = planar_domain(*random_domain(np.random.default_rng(seed)), angle=angle)
    assert angles(V, F).min() > angle - 1e-9


@pytest.mark.parametrize("seed", range(5))
def test_without_points_it_is_the_delaunay_triangulation(seed):
    outer, holes = random_domain(np.random.default_rng(seed))
    V, F = planar_domain(outer, holes, angle=0)
    n, h = sum(map(len, [outer, *holes])), len(holes)
    assert (len(V), len(F)) == (n, n + 2 * h - 2)
    assert turn(*(V[F[:, k]] for k in range(3))).min() > 0
    mesh = PlaneMesh.of(V, F)
    side = np.flatnonzero(mesh.twin.ravel() >= 0)
    opposite = np.radians(angles(V, F).ravel())
    assert np.all(opposite[side] + opposite[mesh.twin.ravel()[side]] <= np.pi + 1e-9)


def test_sharp_corners_keep_their_angles_and_nothing_else_does():
    # Angles of 0.6, 5 and 30 degrees, where cuts of the two sides would call for one another.
    needle = planar_domain([0, 10, 10 + 0.1j])
    assert len(needle[0]) < 200
    small = angles(*needle)
    assert small.min() == pytest.approx(np.degrees(np.arctan(0.01)), rel=1e-9)
    for corners in ([0, 10, 10 + 1j, 5 + 0.01j, 4 + 9j], [0, 4, 4 + 2j, 2 + 0.1j, 3j]):
        V, F = planar_domain(corners)
        thin = np.flatnonzero(angles(V, F).min(axis=1) < 25 - 1e-9)
        assert len(thin) <= 2 * len(corners)
        assert len(V) < 400


@pytest.mark.parametrize("n", [400, 1000])
def test_regular_polygons_of_many_corners(n):
    # All corners are on one circle: its centre is that of all triangles.
    V, F = planar_domain(circle(n))
    assert angles(V, F).min() > 25 - 1e-9
    assert turn(*(V[F[:, k]] for k in range(3))).sum() == pytest.approx(
        n * np.sin(2 * np.pi / n), rel=1e-12
    )
    assert len(V) < 5 * n


def test_points_lie_on_sides_or_inside():
    outer = circle(7) * np.exp(0.3j)
    V, F = planar_domain(outer, [0.3 * circle(5)], area=0.01)
    K = ip.DeltaComplex.from_mesh(V, F)
    for loop, ring in zip(ip.domains.boundary_loops(K), (outer, 0.3 * circle(5))):
        assert loop.length == pytest.approx(np.abs(ring - np.roll(ring, 1)).sum(), rel=1e-13)
    corner = V[F]
    assert turn(*(corner[:, k] for k in range(3))).max() / 2 <= 0.01


def test_narrow_passages_are_graded():
    # A hole of width 1/5000 of the domain; what is behind it is not seen through it.
    V, F = planar_domain(square(0, 0, 10), [np.array([4, 6, 6 + 0.002j, 4 + 0.002j]) + 5j])
    assert angles(V, F).min() > 25 - 1e-9
    assert len(V) < 400


def test_rings_that_cannot_be_divided_are_refused():
    bowtie = np.array([[0, 0], [1, 1], [1, 0], [0, 1], [0.5, 2]], dtype=float)
    with pytest.raises(ip.MeshError, match="cannot be triangulated"):
        triangulated(bowtie, [np.array([0, 1, 2, 0])], Quality(0.0, np.inf))
