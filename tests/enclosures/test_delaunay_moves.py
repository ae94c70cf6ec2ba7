import flint
import numpy as np
from support.enclosed_surfaces import generic_genus_two, triangulated

from igl_periods.complexes import cotangents, delaunay_flips
from igl_periods.enclosures.delaunay_moves import fan, make_delaunay
from igl_periods.surfaces import flat_torus


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
