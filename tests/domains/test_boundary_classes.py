"""Boundary loops in their order, and the classes that they make on the double."""

import numpy as np
import pytest
from support.flat_surfaces import flat_strip
from support.random_domains import random_domain
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.domains.boundary_classes import boundary_loops, doubled_with_classes
from igl_periods.surfaces import planar_domain
from igl_periods.topology import pairing


@pytest.mark.parametrize("seed", range(5))
def test_loops_are_the_polygons_in_their_order(seed):
    outer, holes = random_domain(np.random.default_rng(seed))
    K = ip.DeltaComplex.from_mesh(*planar_domain(outer, holes))
    loops = boundary_loops(K)
    assert len(loops) == 1 + len(holes)
    for loop, polygon in zip(loops, [outer, *holes]):
        assert complex(*loop.point) == polygon[0]
        perimeter = np.abs(polygon - np.roll(polygon, 1)).sum()
        assert loop.length == pytest.approx(perimeter, rel=1e-12)
        # The surface is on the left: counterclockwise outside, clockwise around holes.
        z = K.positions[loop.vertices] @ [1, 1j]
        area = np.imag(np.conj(z) * np.roll(z, -1)).sum() / 2
        assert (area > 0) == (polygon is outer)
    assert sorted(np.concatenate([loop.half_edges for loop in loops])) == (
        np.flatnonzero(K.twin.ravel() < 0).tolist()
    )


@pytest.mark.parametrize("seed", range(5))
def test_classes_are_closed_and_their_sum_is_exact(seed):
    K = ip.DeltaComplex.from_mesh(*planar_domain(*random_domain(np.random.default_rng(seed))))
    loops = boundary_loops(K)
    L, classes = doubled_with_classes(K, loops)
    along = classes.toarray()[:, L.edge] * L.sign
    assert not along.sum(axis=2).any()
    periods = pairing(L, classes, ip.cohomology_basis(L))
    assert not periods.sum(axis=0).any()
    assert np.linalg.matrix_rank(periods) == len(loops) - 1
    # Half of a symplectic basis: they do not meet each other.
    assert not pairing(L, classes, classes).any()


def test_surface_with_a_handle_and_two_holes():
    V, F = noisy_torus(9, 8, 0.1, 1)
    K = ip.DeltaComplex.from_mesh(V, np.delete(F, [0, 60], axis=0))
    loops = boundary_loops(K)
    assert [len(loop.vertices) for loop in loops] == [3, 3]
    L, classes = doubled_with_classes(K, loops)
    assert L.genus == 3
    assert not (classes.toarray()[:, L.edge] * L.sign).sum(axis=2).any()


def test_loops_are_shown_with_a_point():
    K = ip.DeltaComplex.from_mesh([[1, 2], [3, 2], [1, 5]], [[0, 1, 2]])
    assert repr(boundary_loops(K)) == "[BoundaryLoop(3 edges through (1, 2))]"


def test_surfaces_without_orientation_are_refused():
    band = flat_strip(3, 1, 6, 2, glue_x="turned")
    with pytest.raises(ip.ComplexError, match="not orientable"):
        boundary_loops(band)
    K = flat_strip(3, 1, 6, 2)
    turned = np.where(np.arange(K.n_faces)[:, None] == 3, [0, 2, 1], [0, 1, 2])
    L = ip.DeltaComplex.from_lengths(
        np.take_along_axis(K.lengths, turned, 1), np.take_along_axis(K.corner_vertex, turned, 1)
    )
    with pytest.raises(ip.ComplexError, match="Turn faces over"):
        boundary_loops(L)


def test_several_components_are_refused():
    V = [[0, 0], [1, 0], [0, 1], [5, 0], [6, 0], [5, 1]]
    with pytest.raises(ip.ComplexError, match="2 components"):
        boundary_loops(ip.DeltaComplex.from_mesh(V, [[0, 1, 2], [3, 4, 5]]))
