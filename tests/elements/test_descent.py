"""Descent: derivatives are those of the energy, and no energy rises."""

import dataclasses

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes import intrinsic_delaunay
from igl_periods.elements import dirichlet_matrix, high_order_forms
from igl_periods.elements.condensation import scaled_gradients, transposed_gradients
from igl_periods.elements.descent import _energy_and_slope, descended
from igl_periods.elements.placement import choose_elements, is_cone, separate_cones
from igl_periods.elements.trace_system import condensed_system, factored_system, least_traces
from igl_periods.elements.trial_forms import HighOrderForms
from igl_periods.topology import cochains_and_basis


def torus_with_needle(distance, seed=0):
    """A coarse torus in space with a vertex in a face, at a corner; (K, cochains), flipped."""
    rng = np.random.default_rng(seed)
    a, b = np.meshgrid(2 * np.pi * np.arange(4) / 4, 2 * np.pi * np.arange(3) / 3, indexing="ij")
    V = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], -1)
    V = V.reshape(-1, 3) + 0.1 * rng.normal(size=(12, 3))
    corner = np.arange(12).reshape(4, 3)
    right, up = np.roll(corner, -1, 0), np.roll(corner, -1, 1)
    both = np.roll(right, -1, 1)
    F = np.stack([corner, right, both, corner, both, up], axis=-1).reshape(-1, 3)
    a, b, c = F[0]
    point = V[a] + distance * (0.6 * (V[b] - V[a]) + 0.3 * (V[c] - V[a]))
    F = np.vstack([F[1:], [[a, b, 12], [b, c, 12], [c, a, 12]]])
    K = ip.DeltaComplex.from_mesh(np.vstack([V, point]), F)
    return intrinsic_delaunay(K, cochains_and_basis(K)[0])


def solved(K, cochains, degree):
    """The solution of the system as it is, and the factor."""
    K, cochains = separate_cones(K, cochains)
    elements = choose_elements(K, degree)
    system = condensed_system(K, cochains, elements)
    factor = factored_system(system)
    traces = least_traces(system, factor)
    return HighOrderForms(K, cochains, degree, elements, system.extensions, traces), factor


@pytest.mark.parametrize("degree", [1, 3, 6])
def test_transposed_gradients_are_the_transpose(degree):
    K, cochains = torus_with_needle(0.1)
    rng = np.random.default_rng(degree)
    for elements in choose_elements(separate_cones(K, cochains)[0], degree):
        block = np.arange(min(5, elements.face.size))
        u = rng.normal(size=(elements.reference.n_functions, block.size, 2))
        q = elements.reference.quadrature.nodes.size
        X = rng.normal(size=(2, q, block.size, 2))
        there = sum(np.sum(x * y) for x, y in zip(scaled_gradients(elements, block, u), X))
        back = np.sum(u * transposed_gradients(elements, block, *X))
        assert there == pytest.approx(back, rel=1e-12)


@pytest.mark.parametrize("degree", [2, 5])
def test_the_slope_is_half_the_derivative_of_the_energy(degree):
    forms, _ = solved(*torus_with_needle(0.1), degree)
    rng = np.random.default_rng(1)
    forms = dataclasses.replace(forms, traces=forms.traces + rng.normal(size=forms.traces.shape))
    energy, slope = _energy_and_slope(forms)
    np.testing.assert_allclose(energy, np.diag(dirichlet_matrix(forms)), rtol=1e-12)
    # The energy is quadratic: central differences are exact.
    step = rng.normal(size=forms.traces.shape)
    up, down = (
        _energy_and_slope(dataclasses.replace(forms, traces=forms.traces + s * step))[0]
        for s in (1, -1)
    )
    np.testing.assert_allclose((up - down) / 4, np.sum(slope * step, axis=0), rtol=1e-9)


def test_nothing_is_done_where_triangles_are_not_thin():
    forms, factor = solved(*torus_with_needle(0.1), 3)
    assert descended(forms, factor) is forms


@pytest.mark.parametrize("distance", [1e-8, 1e-10, 1e-12])
@pytest.mark.parametrize("degree", [2, 4, 8])
def test_no_energy_rises(degree, distance):
    forms, factor = solved(*torus_with_needle(distance), degree)
    lower = descended(forms, factor)
    before, after = (np.diag(dirichlet_matrix(f)) for f in (forms, lower))
    assert np.all(after <= before * (1 + 1e-13))


def test_a_wrong_solution_comes_down_to_the_least_energy():
    K, cochains = torus_with_needle(1e-9)
    forms, factor = solved(K, cochains, 4)
    rng = np.random.default_rng(0)
    # Off by something that costs a lot on the needle and nothing elsewhere would stay unnoticed.
    lost = dataclasses.replace(forms, traces=forms.traces + 1e-3 * rng.normal(size=(1, 2)))
    lost.traces[1:] *= 1 + 1e-4 * rng.normal(size=(len(lost.traces) - 1, 1))
    least = np.diag(dirichlet_matrix(high_order_forms(K, cochains, 4)))
    assert np.all(np.diag(dirichlet_matrix(lost)) > 1.001 * least)
    np.testing.assert_allclose(
        np.diag(dirichlet_matrix(descended(lost, factor))), least, rtol=1e-10
    )


@pytest.mark.parametrize("distance", [1e-10, 1e-12])
def test_the_new_vertex_on_a_face_is_flat_up_to_rounding(distance):
    # Its angle differs from 2π by more than 1e-9, and by less than what the lengths know.
    K, _ = torus_with_needle(distance)
    assert not is_cone(K)[12]
