"""Harmonic cochains on Λ: their classes, least energy, periods."""

import numpy as np
import pytest
from support.delaunay_surfaces import SURFACES, distorted
from support.discrete_forms import close_after_solving, on_lambda
from support.jittered_lattice import lattice
from support.random_surfaces import BOLZA, L_SHAPE

import igl_periods as ip
from igl_periods.complexes.cochains import walk_cochain
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.complexes.weights import cotan_weights
from igl_periods.forms.calculus import d0, wedge
from igl_periods.forms.holomorphic import periods
from igl_periods.harmonic.harmonic_cochains import harmonic_forms
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.dual_cycles import crossing_cochain, dual_homology_basis


def test_blocks_of_harmonic_forms_are_their_rows():
    K = lattice((3, 2, 2))
    whole = ip.harmonic_forms(K)
    blocks = list(ip.harmonic_form_blocks(K, rows=3))
    assert [len(block) for block in blocks[:-1]] == [3] * (len(blocks) - 1)
    np.testing.assert_allclose(np.concatenate(blocks), whole, rtol=0, atol=1e-12)
    with pytest.raises(ValueError, match="rows = 0: a block has 1 row at least"):
        ip.harmonic_form_blocks(K, rows=0)


@pytest.fixture(params=SURFACES)
def surface(request):
    return SURFACES[request.param]


@pytest.fixture
def rng():
    return np.random.default_rng(0)


def random_closed_forms(surface, rng, k):
    """Closed forms on Λ with random periods, different on Γ and on Γ*, on all edges of K."""
    graph = surface.graph
    K, g = graph.complex, surface.pm.genus
    omega = harmonic_forms(K, surface.cocycles)
    tail, head = edge_ends(K)
    f = rng.normal(size=(k, K.n_vertices))
    on_gamma = rng.normal(size=(k, 2 * g)) @ omega + f[:, head] - f[:, tail]
    on_dual = graph.weights * (rng.normal(size=(k, 2 * g)) @ omega)
    on_dual[:, graph.edges] += d0(graph, rng.normal(size=(k, graph.n_vertices)))[:, 1]
    return np.stack([on_gamma, on_dual], axis=1)


# Harmonic forms.
def test_harmonic_forms_have_the_classes_and_the_least_energy(surface, rng):
    K, cocycles = surface.graph.complex, surface.cocycles
    omega, rho = harmonic_forms(K, cocycles), cotan_weights(K)
    assert omega.shape == (2 * surface.pm.genus, K.n_edges)
    # ω − c is the differential of a function: that of a least-squares solution.
    tail, head = edge_ends(K)
    d = np.zeros((K.n_edges, K.n_vertices))
    np.add.at(d, (np.arange(K.n_edges), head), 1.0)
    np.add.at(d, (np.arange(K.n_edges), tail), -1.0)
    exact = (omega - cocycles.toarray()).T
    assert close_after_solving(d @ np.linalg.lstsq(d, exact, rcond=None)[0], exact)
    assert close_after_solving(d.T @ (rho[:, None] * omega.T), 0)
    assert close_after_solving((omega * rho) @ omega.T, surface.pm.dirichlet)


def test_harmonic_forms_need_no_delaunay_triangulation():
    K = distorted(L_SHAPE, 3, 0.15, 0)
    assert cotan_weights(K).min() < 0
    pm = ip.period_matrix(K, delaunay=False)
    omega = harmonic_forms(K)
    assert close_after_solving((omega * cotan_weights(K)) @ omega.T, pm.dirichlet)


def test_harmonic_forms_are_dual_to_the_canonical_cycles():
    K = distorted(BOLZA, 3, 0.15, 0)
    cycles = np.array([walk_cochain(K, walk) for walk in ip.homology_basis(K)])
    assert close_after_solving(harmonic_forms(K) @ cycles.T, np.eye(4))


# Periods.
def test_periods_are_integrals_along_canonical_cycles(surface, rng):
    # Second route: along walks of edges, and along walks of faces.  The canonical basis of the
    # flipped complex itself has cycles there.
    K = surface.graph.complex
    forms = random_closed_forms(surface, rng, 3)
    cycles = np.array([walk_cochain(K, walk) for walk in ip.homology_basis(K)])
    crossings = np.array([crossing_cochain(K, walk) for walk in dual_homology_basis(K)])
    expected = np.stack([forms[:, 0] @ cycles.T, -forms[:, 1] @ crossings.T], axis=1)
    assert close_after_solving(periods(K, forms), expected)


def test_riemann_bilinear_relation(surface, rng):
    # ∬ α ∧ β = ½ Σ (a(α) b*(β) − b(α) a*(β) + a*(α) b(β) − b*(α) a(β)).
    alpha, beta = random_closed_forms(surface, rng, 2)
    g = surface.pm.genus
    J = standard_form(g)
    (p, p_dual), (q, q_dual) = periods(
        surface.graph.complex, np.stack([alpha, beta]), surface.cocycles
    )
    integral = wedge(on_lambda(surface, alpha), on_lambda(surface, beta)).sum()
    assert close_after_solving(integral, 0.5 * (p @ J @ q_dual + p_dual @ J @ q))


# Harmonic forms on Γ*.
def test_stars_of_harmonic_forms_solve_the_laplace_equation_of_the_dual_graph(surface):
    # Second route: least energy with weights 1/ρ on Γ*, by dense linear algebra.
    graph, g = surface.graph, surface.pm.genus
    n = graph.complex.n_vertices
    d = np.zeros((graph.n_edges, graph.n_vertices - n))
    np.add.at(d, (np.arange(graph.n_edges), graph.head[1] - n), 1.0)
    np.add.at(d, (np.arange(graph.n_edges), graph.tail[1] - n), -1.0)
    # Another closed form in the class of the star of ω, and its representative of least energy.
    omega = harmonic_forms(graph.complex, surface.cocycles)[:, graph.edges]
    start = (graph.rho * omega).T + d @ np.random.default_rng(0).normal(size=(d.shape[1], 2 * g))
    # Γ* is connected, so f is determined but for a constant: it is 0 at the first dual vertex, and
    # the equations at the others have one solution.
    delta = d[:, 1:]
    f = np.zeros((d.shape[1], 2 * g))
    f[1:] = np.linalg.solve(
        delta.T @ (delta / graph.rho[:, None]), -delta.T @ (start / graph.rho[:, None])
    )
    assert close_after_solving(start + d @ f, (graph.rho * omega).T)
    dual = -standard_form(g) @ np.linalg.solve(surface.pm.dirichlet, omega * graph.rho)
    energies = (dual / graph.rho) @ dual.T
    J = standard_form(g)
    assert close_after_solving(energies, J @ np.linalg.inv(surface.pm.dirichlet) @ J.T)
    full = np.zeros((2 * g, 2, graph.complex.n_edges))
    full[:, 1, graph.edges] = dual
    assert close_after_solving(periods(graph.complex, full, surface.cocycles)[:, 1], np.eye(2 * g))
