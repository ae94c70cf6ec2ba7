"""Gradients of forms of high degree in the charts of faces."""

import numpy as np
import pytest
from support.random_surfaces import L_SHAPE, noisy_torus

from igl_periods.complexes import DeltaComplex
from igl_periods.elements import (
    HighOrderGradients,
    dirichlet_matrix,
    gradients,
    high_order_forms,
)
from igl_periods.harmonic import moments
from igl_periods.topology import cohomology_basis

SURFACES = [
    DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 1)),
    DeltaComplex.from_squares(L_SHAPE, 2),
]


@pytest.mark.parametrize("K", SURFACES)
def test_energies_are_sums_of_their_squares(K):
    forms = high_order_forms(K, cohomology_basis(K), 4)
    D = 0.0
    for _, G in HighOrderGradients(forms).gradient_blocks():
        D = D + np.einsum("qfi,qfj->ij", G.conj(), G).real
    assert np.allclose(D, dirichlet_matrix(forms), rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("K", SURFACES)
def test_moments_are_integrals_of_squares_in_the_chart(K):
    """Against many points: an independent way to the gradients, and to their directions."""
    forms = high_order_forms(K, cohomology_basis(K), 3)
    n, k = forms.complex.n_faces, forms.cochains.shape[0]
    S = np.eye(k)[None]
    found = moments(HighOrderGradients(forms), S, n)[0]
    size = 40
    i, j = np.meshgrid(np.arange(size), np.arange(size), indexing="ij")
    inside = i + j < size
    points = np.stack([i[inside] + 1 / 3, j[inside] + 1 / 3], axis=1) / size
    barycentric = np.column_stack([1 - points.sum(axis=1), points])
    flat = forms.elements[0].face[:6] if len(forms.elements) > 1 else np.arange(6)
    for face in flat:
        G = gradients(forms, np.full(len(barycentric), face), barycentric)
        sides = forms.complex.lengths[face]
        s = sides.sum() / 2
        area = np.sqrt(s * np.prod(s - sides))
        mean = np.sum(G**2, axis=1).mean()
        assert abs(found[face] - area * mean) < 0.05 * area * np.sum(np.abs(G) ** 2, axis=1).mean()
