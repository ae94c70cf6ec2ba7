import flint
import numpy as np
import pytest
from support.enclosed_surfaces import generic_genus_two, l_shape, triangulated

from igl_periods.complexes import cotangents, delaunay_flips
from igl_periods.enclosures.delaunay_moves import fan, improve_shapes, insert_centres, make_delaunay
from igl_periods.surfaces import double_polygon, flat_torus, origami, regular_polygon


def test_all_edges_are_delaunay_and_agree_with_the_other_implementation():
    K = generic_genus_two(seed=1)
    with flint.ctx.workprec(200):
        surface, _ = triangulated(K)
        for h in range(0, len(surface.twin), 4):
            surface.flip(h)
        make_delaunay(surface)
    lengths = surface.lengths_in_floats()
    cot = cotangents(lengths).ravel()
    assert (cot + cot[surface.twin] > -1e-8).all()
    delaunay, _ = delaunay_flips(K)
    ours, theirs = (np.sort(x.ravel()) for x in (lengths, delaunay.lengths))
    assert np.allclose(ours, theirs, rtol=1e-12)


def test_fan_walks_once_around_the_vertex():
    K = flat_torus(0.2 + 1.1j, 3, 2)
    surface, _ = triangulated(K)
    for corner in range(len(surface.twin)):
        corners = fan(surface, corner)
        assert sorted(corners) == sorted(
            c for c, v in enumerate(surface.corner_vertex) if v == surface.corner_vertex[corner]
        )


@pytest.mark.parametrize(("K", "cells"), [(regular_polygon(10), [10]), (double_polygon(7), [7, 7])])
def test_large_regular_cells_are_divided_about_their_centres(K, cells):
    surface, _ = triangulated(K)
    make_delaunay(surface)
    assert insert_centres(surface) == len(cells)
    assert (surface.n_faces, surface.n_vertices) == (sum(cells), K.n_vertices + len(cells))
    corners = np.bincount(surface.corner_vertex)
    assert corners[K.n_vertices :].tolist() == cells
    # Spokes are as long as the circumradius of the unit polygon, nearly.
    spokes = np.sort(surface.lengths_in_floats().ravel())
    assert np.allclose(spokes[sum(cells) :], 1 / (2 * np.sin(np.pi / cells[0])), rtol=1e-3)
    cot = cotangents(surface.lengths_in_floats()).ravel()
    assert (cot + cot[surface.twin] > -1e-8).all()


def test_squares_and_triangles_are_left_alone():
    for K in (origami("(1,2)", "(1,3)", 2), flat_torus(0.5 + 0.75**0.5 * 1j, 3, 2)):
        surface, _ = triangulated(K)
        assert insert_centres(surface) == 0
        assert surface.n_vertices == K.n_vertices


@pytest.mark.parametrize("thickness", [2.0**-5, 2.0**-8, 2.0**-12])
def test_triangles_grow_step_by_step_from_the_ends_of_short_edges(thickness):
    with flint.ctx.workprec(200):
        surface, _ = triangulated(l_shape(1.0 + thickness))
        make_delaunay(surface)
        inserted = improve_shapes(surface, 2.0)
    # A bounded number of triangles for each octave between the thickness and 1.
    assert 0 < inserted < 12 * -np.log2(thickness)
    lengths = surface.lengths_in_floats()
    corners = np.array(surface.corner_vertex).reshape(-1, 3)
    shortest = np.full(surface.n_vertices, np.inf)
    for side in range(3):
        for end in (1, 2):
            np.minimum.at(shortest, corners[:, (side + end) % 3], lengths[:, side])
    a, b, c = lengths.T
    s = 0.5 * (a + b + c)
    circumradius = a * b * c / (4.0 * np.sqrt(s * (s - a) * (s - b) * (s - c)))
    assert (circumradius <= 2.0 * (1 + 1e-9) * shortest[corners].min(axis=1)).all()
