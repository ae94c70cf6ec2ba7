"""Shares of faces in the excess of energy: they add up to d_i − 1, and none is negative."""

import numpy as np
import pytest
from support.surfaces_with_bounds import SURFACES, harmonic

from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.excess import energy_excess
from igl_periods.surfaces import flat_torus
from igl_periods.symplectic.williamson_form import williamson


@pytest.mark.parametrize("surface", SURFACES)
def test_shares_are_positive_and_add_up_to_the_excess(surface):
    K, cochains, potentials, D = harmonic(surface())
    shares = energy_excess(K, cochains, potentials, D)
    assert shares.shape == (len(D) // 2, K.n_faces)
    assert (shares >= 0).all()
    np.testing.assert_allclose(shares.sum(axis=1), williamson(D)[0] - 1, rtol=0, atol=1e-12)


def test_any_potentials_have_shares_of_their_own_excess():
    K, cochains, potentials, D = harmonic(SURFACES[0]())
    rng = np.random.default_rng(0)
    other = potentials + 0.01 * rng.normal(size=potentials.shape)
    E = dirichlet_matrix(K, cochains, other)
    shares = energy_excess(K, cochains, other, E)
    np.testing.assert_allclose(shares.sum(axis=1), williamson(E)[0] - 1, rtol=0, atol=1e-12)
    assert shares.sum() > energy_excess(K, cochains, potentials, D).sum()


def test_nothing_is_in_excess_where_forms_are_exact():
    K, cochains, potentials, D = harmonic(flat_torus(0.3 + 1.1j, 5, 4))
    assert energy_excess(K, cochains, potentials, D).max() < 1e-14
