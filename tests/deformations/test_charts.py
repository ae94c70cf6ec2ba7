"""Coordinates of surfaces near a given one, and their norms."""

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import DeltaComplex, edge_lengths
from igl_periods.deformations.charts import (
    LengthChart,
    VertexChart,
    displacement_norm,
    strain_norm,
)

K = DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.05, 1))
PM = ip.period_matrix(K, keep_forms=True)
RNG = np.random.default_rng(0)
CHARTS = {
    "vertices": VertexChart.of(K, None, 0.7),
    "basis": VertexChart.of(K, RNG.normal(size=(K.n_vertices, 5)), 0.7),
    "lengths": LengthChart(K),
}


@pytest.mark.parametrize("name", CHARTS)
def test_rows_are_derivatives_along_the_chart(name):
    chart = CHARTS[name]
    dx = 0.02 * RNG.normal(size=chart.start().size)
    W = np.array([[[1.0]], [[1j]]])
    found = chart.rows(K, PM.gradient(W)) @ dx
    h = 1e-4
    ahead, back = (ip.period_matrix(chart.surface(t * dx)).matrix[0, 0] for t in (h, -h))
    difference = (ahead - back) / (2 * h)
    assert np.allclose(found, [difference.real, difference.imag], rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("name", CHARTS)
def test_raised_rows_are_duals(name):
    """N⁻¹ is symmetric and positive definite."""
    chart = CHARTS[name]
    rows = RNG.normal(size=(4, chart.start().size))
    gram = rows @ chart.raised(K, rows).T
    assert np.allclose(gram, gram.T, rtol=1e-9) and np.linalg.eigvalsh(gram)[0] > 0


def test_norm_of_displacements():
    """Translations cost their mass, which is 1 in all."""
    norm = displacement_norm(K, 0.7)
    ones = np.ones(K.n_vertices)
    assert ones @ (norm @ ones) == pytest.approx(1.0, rel=1e-12)


def test_strain_of_a_similarity():
    """All lengths by the same factor: ε is the metric, tr ε² = 2, and its eigenvalues are 1."""
    ones = np.ones(K.n_edges)
    assert ones @ (strain_norm(K) @ ones) == pytest.approx(2.0, rel=1e-10)
    assert CHARTS["lengths"].strain(K, ones) == pytest.approx(1.0, rel=1e-9)


def test_given_surfaces_are_at_zero():
    for chart in CHARTS.values():
        assert np.allclose(edge_lengths(chart.surface(chart.start())), edge_lengths(K), rtol=1e-14)
