"""The cut surface is a disk."""

import numpy as np
import pytest
from support.parametrized_surfaces import NAMES, random_coefficients

from igl_periods.complexes.cochains import along_sides
from igl_periods.differentials.parametrization import parametrize


@pytest.mark.parametrize("name", NAMES)
def test_the_cut_surface_is_a_disk_and_the_map_integrates_the_form(surfaces, name):
    pm = surfaces[name]
    P = parametrize(pm, random_coefficients(pm.genus, 1))
    twin = pm.complex.twin.ravel()
    tail, head = (np.roll(P.corner, shift, axis=1).ravel() for shift in (-1, 1))
    whole = ~P.cut.ravel()
    assert np.array_equal(tail[whole], head[twin][whole])
    n_edges = np.count_nonzero(whole) // 2 + np.count_nonzero(P.cut)
    assert len(P.vertex) - n_edges + len(P.corner) == 1
    # One boundary loop: every vertex on the cut has two sides of it.
    assert np.all(np.bincount(tail[~whole], minlength=len(P.vertex)) <= 1)
    assert np.array_equal(P.vertex[P.corner], pm.complex.corner_vertex)
    assert np.array_equal(P.cut.ravel()[pm.complex.twin.ravel()], P.cut.ravel())
    assert 2 * P.seams.size == np.count_nonzero(P.cut)
    z = P.corner_uv
    along = np.roll(z, 1, axis=1) - np.roll(z, -1, axis=1)
    np.testing.assert_allclose(along, along_sides(P.complex, P.form), rtol=0, atol=1e-12)
