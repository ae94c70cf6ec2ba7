"""The Hodge decomposition, against dense projections too."""

import numpy as np
import pytest
import scipy.linalg
from support.delaunay_surfaces import distorted, marked
from support.discrete_forms import close_after_solving
from support.random_surfaces import L_SHAPE

from igl_periods.forms.calculus import (
    adjoint_d0,
    d0,
    d1,
    dirichlet_energy,
    hodge_star,
    scalar_product,
)
from igl_periods.forms.hodge import hodge_decomposition
from igl_periods.forms.holomorphic import holomorphic_forms, periods


# Hodge decomposition.
def test_hodge_decomposition(surface, rng):
    graph, g = surface.graph, surface.pm.genus
    K = graph.complex
    alpha = rng.normal(size=(2, 3, 2, graph.n_edges)) + 1j * rng.normal(
        size=(2, 3, 2, graph.n_edges)
    )
    parts = hodge_decomposition(graph, alpha)
    exact, coexact, harmonic = parts
    assert close_after_solving(exact + coexact + harmonic, alpha)
    assert close_after_solving(d1(graph, exact), 0)
    assert close_after_solving(adjoint_d0(graph, coexact), 0)
    assert close_after_solving(d1(graph, harmonic), 0)
    assert close_after_solving(adjoint_d0(graph, harmonic), 0)
    for one, other in ((exact, coexact), (exact, harmonic), (coexact, harmonic)):
        norms = dirichlet_energy(graph, one) * dirichlet_energy(graph, other)
        assert (np.abs(scalar_product(graph, one, other)) < 1e-12 * np.sqrt(norms) + 1e-14).all()
    # The exact part is one: it has no periods; the star of the co-exact part neither.
    for form in (exact, hodge_star(graph, coexact)):
        full = np.zeros((2, 3, 2, K.n_edges), dtype=complex)
        full[..., 1, graph.edges] = form[..., 1, :]
        full[..., 0, :] = extended(graph, form[..., 0, :])
        assert close_after_solving(periods(K, full), 0)
    assert harmonic.any() == (g > 0)


def extended(graph, closed):
    """A closed form on Γ, on all edges of the triangulation: each face of Γ is a disc."""
    K = graph.complex
    values = np.full((*closed.shape[:-1], K.n_edges), np.nan, dtype=complex)
    values[..., graph.edges] = closed
    while np.isnan(values).any():
        sides = K.sign * values[..., K.edge]
        for s in range(3):
            missing = np.isnan(sides[..., s]) & ~np.isnan(sides[..., s - 1] + sides[..., s - 2])
            faces = np.flatnonzero(missing.reshape(-1, K.n_faces)[0])
            values[..., K.edge[faces, s]] = -K.sign[faces, s] * (
                sides[..., faces, s - 1] + sides[..., faces, s - 2]
            )
    return values


def test_hodge_decomposition_against_dense_projections(surface, rng):
    # Second route: orthogonal projections on the images of d and of *d, with the Laplacians of
    # both graphs, nothing harmonic computed.
    graph = surface.graph
    alpha = rng.normal(size=(2, graph.n_edges))
    root = np.sqrt(np.stack([graph.rho, 1 / graph.rho])).ravel()
    gradients = d0(graph, np.eye(graph.n_vertices))
    exact, coexact, _ = hodge_decomposition(graph, alpha)
    for part, images in ((exact, gradients), (coexact, hodge_star(graph, gradients))):
        Q = scipy.linalg.orth((images.reshape(graph.n_vertices, -1) * root).T, rcond=1e-10)
        projected = Q @ (Q.T @ (root * alpha.ravel())) / root
        assert close_after_solving(part.ravel(), projected)


def test_hodge_decomposition_commutes_with_the_star(surface, rng):
    graph = surface.graph
    alpha = rng.normal(size=(2, graph.n_edges))
    parts = hodge_decomposition(graph, alpha)
    star = hodge_decomposition(graph, hodge_star(graph, alpha))
    assert close_after_solving(star.exact, hodge_star(graph, parts.coexact))
    assert close_after_solving(star.coexact, hodge_star(graph, parts.exact))
    assert close_after_solving(star.harmonic, hodge_star(graph, parts.harmonic))


@pytest.mark.parametrize("noise", [1e-6, 1e-9, 1e-11])
def test_nearly_cocircular_edges_cost_no_accuracy(noise, rng):
    # Squares up to noise: the diagonals are edges of Γ, with dual weights up to 1e13.
    surface = marked(distorted(L_SHAPE, 3, noise, 0))
    graph = surface.graph
    assert graph.n_edges == graph.complex.n_edges
    assert graph.rho.min() < noise
    alpha = rng.normal(size=(2, graph.n_edges))
    exact, coexact, harmonic = hodge_decomposition(graph, alpha)
    for closed in (d1(graph, exact), d1(graph, harmonic)):
        assert close_after_solving(closed, 0, 1e-13)
    for coclosed in (adjoint_d0(graph, coexact), adjoint_d0(graph, harmonic)):
        assert close_after_solving(coclosed, 0, 1e-13)
    both = periods(graph.complex, holomorphic_forms(graph, surface.cocycles), surface.cocycles)
    assert close_after_solving(both[:, 0, 2:], surface.pm.primal, 1e-13)
    assert close_after_solving(both[:, 1, 2:], surface.pm.dual, 1e-13)


def test_real_forms_have_real_parts(surface, rng):
    parts = hodge_decomposition(surface.graph, rng.normal(size=(2, surface.graph.n_edges)))
    assert all(part.dtype == np.float64 for part in parts)
