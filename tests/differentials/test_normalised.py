"""Normalised differentials: their periods are the matrix."""

import numpy as np
import pytest
from support.parametrized_surfaces import NAMES

import igl_periods as ip
from igl_periods.complexes.cochains import along_sides, walk_cochain
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.differentials.normalised import normalised_differentials
from igl_periods.periods.matrix import PeriodMatrix
from igl_periods.topology.short_cycles import canonical_cycles


@pytest.mark.parametrize("name", NAMES)
def test_periods_are_those_of_the_matrix(surfaces, name):
    pm = surfaces[name]
    zeta = normalised_differentials(pm)
    walks = np.array(
        [walk_cochain(pm.complex, walk) for walk in canonical_cycles(pm.complex, pm.cocycles)]
    )
    expected = np.concatenate([np.eye(pm.genus), pm.matrix], axis=1)
    np.testing.assert_allclose(zeta @ walks.T, expected, rtol=0, atol=1e-12)
    around = along_sides(pm.complex, zeta).sum(axis=-1)
    np.testing.assert_allclose(around, 0, atol=1e-13)


@pytest.mark.parametrize("name", NAMES)
def test_on_delaunay_triangulations_they_are_the_forms_of_the_symplectic_mean(surfaces, name):
    pm = surfaces[name]
    K, cocycles = intrinsic_delaunay(pm.complex, pm.cocycles)
    flipped = PeriodMatrix(pm.dirichlet, True, cocycles, K)
    other = ip.symplectic_mean_forms(K, cocycles)[:, 0]
    np.testing.assert_allclose(normalised_differentials(flipped), other, rtol=0, atol=1e-11)
