"""Values at points: continuity, gradients, harmonicity."""

import numpy as np
import pytest
from support.cone_surfaces import forms_of, rectangular_L, surface_with_cone

from igl_periods.complexes.triangles import angles
from igl_periods.complexes.weights import cone_angles
from igl_periods.elements.placement import is_cone
from igl_periods.elements.point_values import edge_integrals, gradients, potentials
from igl_periods.elements.reference_elements import flat_element


# Forms at points.
@pytest.fixture(scope="module")
def sampled():
    K = rectangular_L(1.0, 1.3, 0.8, 1.1)
    forms = forms_of(K, 8)
    rng = np.random.default_rng(1)
    face = rng.integers(0, forms.complex.n_faces, 400)
    return forms, face, rng.dirichlet([2, 2, 2], 400)


def test_potentials_are_continuous_across_edges(sampled):
    forms, _, _ = sampled
    K = forms.complex
    face, side = np.divmod(np.arange(3 * K.n_faces), 3)
    other, other_side = np.divmod(K.twin.ravel(), 3)
    row = np.arange(face.size)

    def along(f, s, x):
        weights = np.zeros((f.size, 3))
        weights[row, (s + 1) % 3], weights[row, (s + 2) % 3] = 1 - x, x
        return potentials(forms, f, weights)

    for x in (0.2, 0.5, 0.83):
        here = along(face, side, x) - along(face, side, 0.0)
        there = along(other, other_side, 1 - x) - along(other, other_side, 1.0)
        assert np.abs(here - there).max() < 1e-13
    whole = along(face, side, 1.0) - along(face, side, 0.0)
    expected = K.sign.ravel() * edge_integrals(forms)[:, K.edge.ravel()]
    assert np.abs(whole - expected.T).max() < 1e-13


def test_gradients_are_derivatives_of_potentials(sampled):
    forms, face, weights = sampled
    lengths = forms.complex.lengths[face]
    corner_1, corner_2 = lengths[:, 2], lengths[:, 1] * np.exp(1j * angles(lengths)[:, 0])
    slopes = gradients(forms, face, weights)
    for direction in (1.0, 1j):
        step = 1e-5 * direction
        second = step.imag / corner_2.imag
        first = (step - second * corner_2).real / corner_1
        change = np.stack([-first - second, first, second], axis=1)
        difference = potentials(forms, face, weights + change) - potentials(
            forms, face, weights - change
        )
        assert np.abs(difference / 2e-5 - (np.conj(slopes) * direction).real).max() < 1e-5


def test_gradients_at_cone_points():
    K = surface_with_cone(np.radians(60.0), 4)
    forms = forms_of(K, 4)
    L = forms.complex
    for vertex in np.flatnonzero(is_cone(L)):
        face, corner = np.argwhere(L.corner_vertex == vertex)[0]
        there = np.abs(gradients(forms, [face], np.eye(3)[[corner]]))
        if cone_angles(L)[vertex] > 2 * np.pi:
            assert not np.isfinite(there).any()
        else:
            assert not there.any()


def test_forms_are_harmonic(sampled):
    # ω + i *ω = conj(gradient) dz is holomorphic: compare the integral of *ω
    # around faces, which vanishes, with the size of the gradients.
    forms, _, _ = sampled
    x, w = np.polynomial.legendre.leggauss(24)
    x, w = 0.5 * (x + 1), 0.5 * w
    flat = (
        forms.elements[0].face[:20]
        if forms.elements[0].reference is flat_element(forms.degree)
        else []
    )
    K = forms.complex
    for face in flat:
        lengths = K.lengths[face]
        corners = np.array([0, lengths[2], lengths[1] * np.exp(1j * angles(lengths[None])[0, 0])])
        flux, size = 0.0, 0.0
        for s in range(3):
            weights = np.zeros((x.size, 3))
            weights[:, (s + 1) % 3], weights[:, (s + 2) % 3] = 1 - x, x
            step = corners[(s + 2) % 3] - corners[(s + 1) % 3]
            values = gradients(forms, np.full(x.size, face), weights)
            flux = flux + (w @ np.conj(values) * step).imag
            size = size + np.abs(w @ np.conj(values) * step)
        assert np.abs(flux).max() < 1e-4 * size.max()
    assert len(flat)


@pytest.mark.parametrize(
    ("face", "weights", "message"),
    [
        ([0], [[0.5, 0.6, -0.1]], "1 points are outside of their faces"),
        ([0], [[0.5, 0.6, 0.1]], "must be ≥ 0 and add up to 1"),
        ([-1], [[1, 0, 0]], "faces -1 … -1 are out of range"),
        ([0, 1], [[1, 0, 0]], r"not arrays of shapes \(2,\) and \(1, 3\)"),
    ],
)
def test_points_outside_are_refused(sampled, face, weights, message):
    for evaluate in (potentials, gradients):
        with pytest.raises(ValueError, match=message):
            evaluate(sampled[0], face, weights)
