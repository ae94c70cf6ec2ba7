"""Which corners are conical: extreme angles, cones separated where needed."""

import numpy as np
import pytest
from support.cone_surfaces import bound_of, forms_of, surface_with_cone

from igl_periods.complexes.weights import cone_angles
from igl_periods.elements.placement import is_cone
from igl_periods.surfaces.square_tiled import (
    square_tiled_surface,
)


# Cone points.
@pytest.mark.parametrize(("theta", "n_faces"), [(8.0, 2), (30.0, 2), (1100.0, 12), (1500.0, 14)])
def test_extreme_cone_angles(theta, n_faces):
    K = surface_with_cone(np.radians(theta), n_faces)
    assert np.isclose(np.degrees(cone_angles(K)), theta, rtol=1e-9).any()
    bounds = [bound_of(K, degree) for degree in (4, 8, 12)]
    assert bounds[2] < 0.05 * bounds[1] < 0.0025 * bounds[0] < 0.0025


def test_cones_are_separated_once_and_only_where_needed():
    K = square_tiled_surface("omega_2")
    assert forms_of(K, 2).complex.n_faces == 4 * K.n_faces
    fine = square_tiled_surface("omega_2", 2)
    assert forms_of(fine, 2).complex is fine
    refined = forms_of(K, 2).complex
    assert np.array_equal(np.flatnonzero(is_cone(refined)), [0, 1])
    assert is_cone(refined)[refined.corner_vertex].sum(axis=1).max() == 1
