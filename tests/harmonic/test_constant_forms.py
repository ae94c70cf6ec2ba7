"""Forms constant on faces: gradients, linear parts."""

import numpy as np
import pytest
from support.surfaces_with_bounds import SURFACES, harmonic

from igl_periods.complexes.half_edges import edge_ends
from igl_periods.harmonic.constant_forms import face_areas, gradients, linear_parts
from igl_periods.symplectic.canonical_basis import standard_form


def forms(K, cochains, potentials):
    tail, head = edge_ends(K)
    return cochains.toarray() + (potentials[head] - potentials[tail]).T


@pytest.mark.parametrize("surface", SURFACES)
def test_gradients_give_the_dirichlet_matrix_and_the_pairing(surface):
    L, cochains, potentials, D = harmonic(surface())
    g, area = gradients(L, forms(L, cochains, potentials)), face_areas(L)
    product = (area * g.conj()) @ g.T
    np.testing.assert_allclose(product.real, D, rtol=0, atol=1e-13 * np.trace(D))
    # ω ∧ η = Im(ḡ h) dA for gradients g and h.
    np.testing.assert_allclose(product.imag, standard_form(len(D) // 2), rtol=0, atol=1e-11)


@pytest.mark.parametrize("surface", SURFACES)
def test_linear_parts_reproduce_the_form(surface):
    L, cochains, potentials, _ = harmonic(surface())
    omega = forms(L, cochains, potentials)
    zeta = omega[0] + 1j * omega[1]
    p, q = linear_parts(L, zeta)
    l0, l1, l2 = L.lengths.T
    corner = np.stack([np.zeros(L.n_faces), l2, (l1**2 + l2**2 - l0**2) / (2 * l2)], axis=1) + 0j
    corner[:, 2] += 2j * face_areas(L) / l2
    side = np.roll(corner, 1, axis=1) - np.roll(corner, -1, axis=1)
    values = p[:, None] * side + q[:, None] * side.conj()
    np.testing.assert_allclose(values, L.sign * zeta[L.edge], rtol=0, atol=1e-12)
