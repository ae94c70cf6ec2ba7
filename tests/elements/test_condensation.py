"""Stiffness on one triangle: Gram matrices of gradients, the power function on a cone."""

import numpy as np
import pytest
from scipy.integrate import quad
from support.cone_surfaces import ORIGAMIS, random_cone_surface

import igl_periods as ip
from igl_periods.complexes.triangles import angles
from igl_periods.elements.condensation import condense_block, scaled_gradients, stiffness
from igl_periods.elements.placement import choose_elements, separate_cones, shaped_elements
from igl_periods.elements.reference_elements import conical_element


def test_energy_of_the_power_function_on_a_cone():
    # The conical element contains the radial factor of Re z^κ, and approximates the angular one
    # exponentially.
    theta, lengths = 5.0, np.array([[0.9, 1.3, 1.1]])
    kappa = 2 * np.pi / theta
    K = ip.DeltaComplex.from_gluing(lengths, [[-1, -1, -1]])
    a, b = lengths[0, 2] + 0j, lengths[0, 1] * np.exp(1j * angles(lengths)[0, 0])

    def energy(degree):
        reference = conical_element(degree)
        face = shaped_elements(K, reference, np.array([0]), np.array([0]), np.array([kappa]))
        s = 0.5 - 0.5 * np.cos(np.pi * np.arange(40) / 39)
        along = conical_element(degree).tabulate(s, np.ones_like(s))[0][:, 1 : degree + 2]
        wanted = ((a + s * (b - a)) ** kappa).real
        u = np.zeros((reference.n_functions, 1, 1))
        u[1 : degree + 2, 0, 0] = np.linalg.lstsq(along, wanted, rcond=None)[0]
        return sum(np.sum(X**2) for X in scaled_gradients(face, np.array([0]), u))

    def density(s):
        # ∫ |∇ Re z^κ|² t dt = κ² |R|^{2κ-2} / 2κ, times the area element |R × R'|.
        R = a + s * (b - a)
        return 0.5 * kappa * abs(R) ** (2 * kappa - 2) * abs((np.conj(R) * (b - a)).imag)

    exact = quad(density, 0, 1, epsabs=0, epsrel=1e-13)[0]
    errors = [abs(energy(degree) / exact - 1) for degree in (3, 6, 9, 12)]
    assert errors[-1] < 1e-12
    assert errors[0] > 100 * errors[1] > 1e4 * errors[2]


@pytest.mark.parametrize("K", [ORIGAMIS[0], random_cone_surface(6, 0)])
def test_stiffness_is_the_gram_matrix_of_gradients(K):
    K, _ = separate_cones(K, ip.cohomology_basis(K))
    for elements in choose_elements(K, 5):
        block = np.arange(elements.face.size)
        n = elements.reference.n_functions
        identity = np.repeat(np.eye(n)[:, None, :], block.size, axis=1)
        X = np.concatenate(list(scaled_gradients(elements, block, identity)))
        matrices = stiffness(elements, block)
        assert np.allclose(matrices, np.einsum("qbi,qbj->bij", X, X), rtol=1e-12, atol=1e-11)
        S, E = condense_block(elements, block)
        extended = np.concatenate([np.repeat(np.eye(15)[None], block.size, axis=0), E], axis=1)
        assert np.allclose(S, extended.transpose(0, 2, 1) @ matrices @ extended, atol=1e-11)
