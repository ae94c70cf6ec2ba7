"""Forms as coefficients of trial functions on their elements."""

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.elements import edge_integrals, high_order_forms
from igl_periods.elements.trial_forms import coefficients, coefficients_on

K = ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.3, 2))


@pytest.fixture(scope="module", params=[1, 4])
def forms(request):
    return high_order_forms(K, ip.cohomology_basis(K), request.param)


def test_potentials_are_0_at_the_apex_and_differ_by_integrals_along_edges(forms):
    L, along = forms.complex, edge_integrals(forms)
    for elements in forms.elements:
        block = np.arange(elements.face.size)
        u = coefficients(forms, elements, block)
        assert np.array_equal(u[0], np.zeros_like(u[0]))
        # Side apex + 2 runs from the apex to corner apex + 1, side apex + 1 back from apex + 2.
        for corner, side, sign in ((1, 2, 1), (2, 1, -1)):
            s = (elements.apex + side) % 3
            values = L.sign[elements.face, s] * along[:, L.edge[elements.face, s]]
            np.testing.assert_allclose(u[corner], sign * values.T, rtol=0, atol=1e-12)


def test_coefficients_need_no_more_than_cochains_and_extensions(forms):
    by_edge = forms.cochains.T.tocsr()
    for elements, extension in zip(forms.elements, forms.extensions, strict=True):
        block = np.arange(min(7, elements.face.size))
        one = coefficients(forms, elements, block)
        assert np.array_equal(one, coefficients_on(forms, by_edge, elements, extension, block))
