"""Where a bound comes from."""

import numpy as np
import pytest
from support.random_surfaces import (
    L_SHAPE,
)
from support.surfaces_with_bounds import SURFACES, harmonic

import igl_periods as ip
from igl_periods.harmonic.excess import energy_excess
from igl_periods.periods.adaptive_mesh import refined_period_matrix
from igl_periods.periods.quality import mesh_quality
from igl_periods.reports.words import advice
from igl_periods.surfaces import flat_torus
from igl_periods.symplectic.williamson_form import williamson


@pytest.mark.parametrize("surface", SURFACES)
def test_shares_of_the_faces_add_up_to_the_bound(surface):
    L, cochains, potentials, D = harmonic(surface())
    shares = energy_excess(L, cochains, potentials, D)
    assert shares.min() >= 0
    np.testing.assert_allclose(shares.sum(axis=1), williamson(D)[0] - 1, rtol=1e-9)
    quality = mesh_quality(surface())
    np.testing.assert_allclose(quality.vertex_excess.sum(), quality.bound, rtol=1e-12)
    np.testing.assert_allclose(quality.bound, ip.period_matrix(surface()).bound, rtol=1e-9)


def test_nothing_originates_where_the_form_is_exact():
    quality = mesh_quality(flat_torus(0.31 + 1.2j, 4, 5))
    assert quality.excess.max() < 1e-28
    assert quality.flips == quality.mollification == 0


def test_most_of_the_bound_can_come_from_few_triangles():
    K = refined_period_matrix(ip.DeltaComplex.from_squares(L_SHAPE, 20), 1.0).complex
    quality = mesh_quality(K)
    assert quality.half_of_the_bound < 0.05 * K.n_faces
    assert "refining just those places" in " ".join(advice(quality))
    worst = np.argsort(quality.excess)[-quality.half_of_the_bound :]
    assert quality.part(np.isin(np.arange(quality.excess.size), worst)) >= 0.5
