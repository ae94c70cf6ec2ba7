"""Coefficients on a face: counted from the apex, linear in the functions, with the right jumps."""

import dataclasses

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes import along_sides
from igl_periods.elements import high_order_forms
from igl_periods.elements.trial_forms import coefficients, function_coefficients
from igl_periods.topology import cochains_and_basis

L_SHAPE = [((0, 1), (1, 3)), ((1, 1), (0, 3)), ((0, 2), (2, 0)),
           ((2, 2), (0, 0)), ((1, 2), (1, 0)), ((2, 1), (2, 3))]  # fmt: skip


@pytest.fixture(scope="module", params=[1, 2, 5])
def forms(request):
    K = ip.DeltaComplex.from_squares(L_SHAPE, 2)
    return high_order_forms(K, cochains_and_basis(K)[0], request.param)


def all_blocks(forms):
    for elements, extension in zip(forms.elements, forms.extensions, strict=True):
        yield elements, extension, np.arange(elements.face.size)


def test_without_functions_the_corners_have_the_values_of_the_cochains(forms):
    bare = dataclasses.replace(forms, traces=np.zeros_like(forms.traces))
    sides = along_sides(forms.complex, forms.cochains.toarray())
    for elements, _, block in all_blocks(forms):
        u = coefficients(bare, elements, block)
        assert np.all(u[0] == 0)
        # From the apex to corner a along side apex + 2, from b to the apex along side apex + 1.
        to_a = sides[:, elements.face, (elements.apex + 2) % 3].T
        from_b = sides[:, elements.face, (elements.apex + 1) % 3].T
        assert np.array_equal(u[1], to_a)
        assert np.array_equal(u[2], -from_b)


def test_coefficients_are_affine_in_the_functions(forms):
    g = np.random.default_rng(0).normal(size=forms.traces.shape)
    moved = dataclasses.replace(forms, traces=forms.traces + g)
    for elements, extension, block in all_blocks(forms):
        change = coefficients(moved, elements, block) - coefficients(forms, elements, block)
        linear = function_coefficients(forms, g, elements, extension, block)
        np.testing.assert_allclose(change, linear, atol=1e-12)


def test_constants_have_no_coefficients(forms):
    constant = np.zeros_like(forms.traces)
    constant[: forms.complex.n_vertices] = 3.0
    for elements, extension, block in all_blocks(forms):
        assert not function_coefficients(forms, constant, elements, extension, block).any()
