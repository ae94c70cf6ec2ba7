"""Harmonic and holomorphic forms on Λ: their periods and energies, and the period matrix."""

import numpy as np
import pytest
import scipy.linalg
from delaunay_surfaces import SURFACES, distorted, flat_torus, marked
from random_surfaces import BOLZA, L_SHAPE
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.complexes.cochains import walk_cochain
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.complexes.weights import cotan_weights
from igl_periods.forms.calculus import (
    adjoint_d0,
    area,
    conformal_energy,
    d0,
    d1,
    dirichlet_energy,
    hodge_star,
    is_holomorphic_form,
    laplacian_1,
    scalar_product,
    type_01,
    wedge,
)
from igl_periods.forms.graph import double_graph
from igl_periods.forms.hodge import hodge_decomposition
from igl_periods.forms.holomorphic import holomorphic_forms, periods, symplectic_mean_forms
from igl_periods.harmonic.harmonic_cochains import harmonic_forms
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.dual_cycles import crossing_cochain, dual_homology_basis


@pytest.fixture(params=SURFACES)
def surface(request):
    return SURFACES[request.param]


@pytest.fixture
def rng():
    return np.random.default_rng(0)


def close(one, other, tolerance=1e-11):
    one, other = np.broadcast_arrays(one, other)
    size = max(np.abs(one).max(initial=0), np.abs(other).max(initial=0), 1.0)
    return np.abs(one - other).max(initial=0) < tolerance * size


def on_lambda(surface, forms):
    return forms[..., surface.graph.edges]


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
    assert close(d @ np.linalg.lstsq(d, exact, rcond=None)[0], exact)
    assert close(d.T @ (rho[:, None] * omega.T), 0)
    assert close((omega * rho) @ omega.T, surface.pm.dirichlet)


def test_harmonic_forms_need_no_delaunay_triangulation():
    K = distorted(L_SHAPE, 3, 0.15, 0)
    assert cotan_weights(K).min() < 0
    pm = ip.period_matrix(K, delaunay=False)
    omega = harmonic_forms(K)
    assert close((omega * cotan_weights(K)) @ omega.T, pm.dirichlet)


def test_harmonic_forms_are_dual_to_the_canonical_cycles():
    K = distorted(BOLZA, 3, 0.15, 0)
    cycles = np.array([walk_cochain(K, walk) for walk in ip.homology_basis(K)])
    assert close(harmonic_forms(K) @ cycles.T, np.eye(4))


# Periods.


def test_periods_are_integrals_along_canonical_cycles(surface, rng):
    # Second route: along walks of edges, and along walks of faces.  The canonical basis of the
    # flipped complex itself has cycles there.
    K = surface.graph.complex
    forms = random_closed_forms(surface, rng, 3)
    cycles = np.array([walk_cochain(K, walk) for walk in ip.homology_basis(K)])
    crossings = np.array([crossing_cochain(K, walk) for walk in dual_homology_basis(K)])
    expected = np.stack([forms[:, 0] @ cycles.T, -forms[:, 1] @ crossings.T], axis=1)
    assert close(periods(K, forms), expected)


def test_riemann_bilinear_relation(surface, rng):
    # ∬ α ∧ β = ½ Σ (a(α) b*(β) − b(α) a*(β) + a*(α) b(β) − b*(α) a(β)).
    alpha, beta = random_closed_forms(surface, rng, 2)
    g = surface.pm.genus
    J = standard_form(g)
    (p, p_dual), (q, q_dual) = periods(
        surface.graph.complex, np.stack([alpha, beta]), surface.cocycles
    )
    integral = wedge(on_lambda(surface, alpha), on_lambda(surface, beta)).sum()
    assert close(integral, 0.5 * (p @ J @ q_dual + p_dual @ J @ q))


# Holomorphic forms.


def test_holomorphic_forms_are_closed_and_of_type_10(surface):
    graph, K = surface.graph, surface.graph.complex
    zeta = holomorphic_forms(K, surface.cocycles)
    assert zeta.shape == (surface.pm.genus, 2, K.n_edges)
    restricted = on_lambda(surface, zeta)
    assert close(hodge_star(graph, restricted), -1j * restricted)
    assert close(d1(graph, restricted), 0)
    assert close(laplacian_1(graph, restricted), 0)
    assert is_holomorphic_form(graph, restricted).all()
    # On Γ they are closed on the triangles too, across edges that Γ does not have.
    assert close((K.sign * zeta[:, 0][:, K.edge]).sum(axis=2), 0)
    contracted = np.setdiff1d(np.arange(K.n_edges), graph.edges)
    assert not zeta[:, 1, contracted].any()


def test_periods_of_holomorphic_forms_are_the_primal_and_the_dual_estimate(surface):
    # The a-periods are δ on both graphs; the b-periods on Γ are Π_primal, those on Γ* Π_dual,
    # the period matrix of the paper, and their mean is the paper's Ω_D.
    pm, g = surface.pm, surface.pm.genus
    zeta = holomorphic_forms(surface.graph.complex, surface.cocycles)
    on_gamma, on_dual = np.moveaxis(periods(surface.graph.complex, zeta, surface.cocycles), 1, 0)
    assert close(on_gamma[:, :g], np.eye(g))
    assert close(on_dual[:, :g], np.eye(g))
    assert close(on_gamma[:, g:], pm.primal)
    assert close(on_dual[:, g:], pm.dual)
    assert close(0.5 * (on_gamma + on_dual)[:, g:], pm.mean)


def test_products_of_holomorphic_forms_are_imaginary_parts_of_periods(surface):
    # i ∬ ζ_k ∧ ζ̄_l = (ζ_k, ζ_l) = 2 Im Π_kl for a Riemann surface.  Here, by the bilinear relation,
    # Π is the mean; real parts cancel, since those of primal and dual are transposed.
    graph, pm = surface.graph, surface.pm
    zeta = on_lambda(surface, holomorphic_forms(graph, surface.cocycles))
    product = scalar_product(graph, zeta[:, None], zeta[None])
    assert close(product, 1j * wedge(zeta[:, None], zeta.conj()[None]).sum(axis=-1))
    assert close(product, 2 * pm.mean.imag)
    assert close(conformal_energy(graph, zeta), 0)
    assert close(area(zeta), np.diag(pm.mean.imag))


def test_the_default_marking_is_that_of_the_period_matrix():
    K, _ = intrinsic_delaunay(distorted(L_SHAPE, 3, 0.15, 7), csr_array((0, 81), dtype=np.int64))
    pm = ip.period_matrix(K)
    assert np.abs(pm.primal - pm.primal.T).max() > 0.01
    both = periods(K, holomorphic_forms(K))
    assert close(both[:, 0, 2:], pm.primal)
    assert close(both[:, 1, 2:], pm.dual)


def test_holomorphic_forms_of_abstract_weights(rng):
    K = ip.DeltaComplex.from_squares(BOLZA, 2)
    weights = rng.uniform(0.2, 3.0, K.n_edges)
    pm = ip.period_matrix_from_weights(weights[K.edge], K.twin)
    graph = double_graph(K, weights)
    both = periods(K, holomorphic_forms(graph))
    assert close(both[:, 0, 2:], pm.primal)
    assert close(both[:, 1, 2:], pm.dual)
    mean = periods(K, symplectic_mean_forms(graph))
    assert close(mean[:, :, 2:], pm.matrix[:, None])


def test_the_form_dz_of_a_translation_surface_is_holomorphic():
    # On the L of three squares dz is a combination of ζ_1, ζ_2, on both graphs, at every n: its
    # a-periods are the coefficients.
    for n in (1, 2, 4):
        K = ip.DeltaComplex.from_squares(L_SHAPE, n)
        graph = double_graph(K)
        dz = np.zeros((2, K.n_edges), dtype=complex)
        for side, step in ((2, 1.0), (0, 1j), (1, -1 - 1j)):
            dz[0, K.edge[0::2, side]] = K.sign[0::2, side] * step
        dz[1] = 1j * graph.weights * dz[0]
        (a, a_dual) = periods(K, dz)[:, :2]
        assert close(a, a_dual)
        assert close(np.einsum("k,kse->se", a, holomorphic_forms(K)), dz)


def test_flat_torus_has_its_exact_form():
    # ζ = dz / a on Γ with the displacements of the edges; on Γ* by a quarter turn, times ρ.
    K, _ = flat_torus(7, 6, 0.12, 1)
    pm = ip.period_matrix(K)
    flipped, cocycles = intrinsic_delaunay(K, pm.cocycles)
    zeta = holomorphic_forms(flipped, cocycles)[0]
    length = np.empty(flipped.n_edges)
    length[flipped.edge] = flipped.lengths
    ratio = np.abs(zeta[0]) / length
    assert close(ratio, ratio.mean())
    assert close(np.abs(zeta[1]), ratio.mean() * cotan_weights(flipped) * length)
    # Area 1.1 in the metric: Im τ = area / |a|².
    assert close(pm.matrix[0, 0].imag, 1.1 * ratio.mean() ** 2)
    assert close(pm.primal, pm.dual)


# The forms of the symplectic mean.


def test_forms_of_the_symplectic_mean(surface):
    graph, pm, g = surface.graph, surface.pm, surface.pm.genus
    forms = symplectic_mean_forms(graph, surface.cocycles)
    both = periods(graph.complex, forms, surface.cocycles)
    assert close(both[:, :, :g], np.eye(g)[:, None])
    assert close(both[:, :, g:], pm.matrix[:, None])
    restricted = on_lambda(surface, forms)
    assert close(d1(graph, restricted), 0)
    assert close(adjoint_d0(graph, restricted), 0)
    assert close(area(restricted), np.diag(pm.matrix.imag))


def test_conformal_energies_of_the_symplectic_mean_are_its_symplectic_eigenvalues(surface):
    graph, pm = surface.graph, surface.pm
    defect = type_01(graph, on_lambda(surface, symplectic_mean_forms(graph, surface.cocycles)))
    energies = 2 * scalar_product(graph, defect[:, None], defect[None])
    relative = scipy.linalg.eigvalsh(energies, pm.matrix.imag)[::-1]
    d = pm.symplectic_eigenvalues
    assert close(relative, (np.sqrt(d) - 1 / np.sqrt(d)) ** 2)


def test_the_symplectic_mean_has_the_least_conformal_energy(surface, rng):
    # Among all Π: trace of the energies of the harmonic forms with periods (1, Π), relative to
    # Im Π.  A stationary point would not do: random matrices near and far.
    graph, pm, g = surface.graph, surface.pm, surface.pm.genus
    omega = harmonic_forms(graph.complex, surface.cocycles)
    dual = -standard_form(g) @ np.linalg.solve(pm.dirichlet, omega * graph.weights)

    def energy(Pi):
        both = [form[:g] + Pi @ form[g:] for form in (omega, dual)]
        forms = on_lambda(surface, np.stack(both, axis=1))
        defect = type_01(graph, forms)
        gram = 2 * scalar_product(graph, defect[:, None], defect[None])
        return np.trace(np.linalg.solve(Pi.imag, gram)).real

    least = energy(pm.matrix)
    d = pm.symplectic_eigenvalues
    assert close(least, np.sum(d + 1 / d - 2))
    for size in (1e-4, 1e-2, 0.1):
        A, B = rng.normal(size=(2, g, g))
        step = A + A.T + 1j * (B + B.T)
        other = pm.matrix + size * step * np.linalg.eigvalsh(pm.matrix.imag)[0] / (4 * g)
        assert energy(other) > least


def test_type_is_exact_where_the_symplectic_eigenvalues_are_1():
    graph = double_graph(intrinsic_delaunay(flat_torus(7, 6, 0.12, 1)[0], csr_array((0, 126)))[0])
    forms = symplectic_mean_forms(graph)[..., graph.edges]
    assert is_holomorphic_form(graph, forms, 1e-11).all()
    assert close(forms, holomorphic_forms(graph)[..., graph.edges])


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
    f = -np.linalg.pinv(d.T @ (d / graph.rho[:, None])) @ d.T @ (start / graph.rho[:, None])
    assert close(start + d @ f, (graph.rho * omega).T)
    dual = -standard_form(g) @ np.linalg.solve(surface.pm.dirichlet, omega * graph.rho)
    energies = (dual / graph.rho) @ dual.T
    J = standard_form(g)
    assert close(energies, J @ np.linalg.inv(surface.pm.dirichlet) @ J.T)
    full = np.zeros((2 * g, 2, graph.complex.n_edges))
    full[:, 1, graph.edges] = dual
    assert close(periods(graph.complex, full, surface.cocycles)[:, 1], np.eye(2 * g))


# Hodge decomposition.


def test_hodge_decomposition(surface, rng):
    graph, g = surface.graph, surface.pm.genus
    K = graph.complex
    alpha = rng.normal(size=(2, 3, 2, graph.n_edges)) + 1j * rng.normal(
        size=(2, 3, 2, graph.n_edges)
    )
    parts = hodge_decomposition(graph, alpha)
    exact, coexact, harmonic = parts
    assert close(exact + coexact + harmonic, alpha)
    assert close(d1(graph, exact), 0)
    assert close(adjoint_d0(graph, coexact), 0)
    assert close(d1(graph, harmonic), 0)
    assert close(adjoint_d0(graph, harmonic), 0)
    for one, other in ((exact, coexact), (exact, harmonic), (coexact, harmonic)):
        norms = dirichlet_energy(graph, one) * dirichlet_energy(graph, other)
        assert (np.abs(scalar_product(graph, one, other)) < 1e-12 * np.sqrt(norms) + 1e-14).all()
    # The exact part is one: it has no periods; the star of the co-exact part neither.
    for form in (exact, hodge_star(graph, coexact)):
        full = np.zeros((2, 3, 2, K.n_edges), dtype=complex)
        full[..., 1, graph.edges] = form[..., 1, :]
        full[..., 0, :] = extended(graph, form[..., 0, :])
        assert close(periods(K, full), 0)
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
        assert close(part.ravel(), projected)


def test_hodge_decomposition_commutes_with_the_star(surface, rng):
    graph = surface.graph
    alpha = rng.normal(size=(2, graph.n_edges))
    parts = hodge_decomposition(graph, alpha)
    star = hodge_decomposition(graph, hodge_star(graph, alpha))
    assert close(star.exact, hodge_star(graph, parts.coexact))
    assert close(star.coexact, hodge_star(graph, parts.exact))
    assert close(star.harmonic, hodge_star(graph, parts.harmonic))


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
        assert close(closed, 0, 1e-13)
    for coclosed in (adjoint_d0(graph, coexact), adjoint_d0(graph, harmonic)):
        assert close(coclosed, 0, 1e-13)
    both = periods(graph.complex, holomorphic_forms(graph, surface.cocycles), surface.cocycles)
    assert close(both[:, 0, 2:], surface.pm.primal, 1e-13)
    assert close(both[:, 1, 2:], surface.pm.dual, 1e-13)


def test_real_forms_have_real_parts(surface, rng):
    parts = hodge_decomposition(surface.graph, rng.normal(size=(2, surface.graph.n_edges)))
    assert all(part.dtype == np.float64 for part in parts)


def test_a_sphere_has_no_harmonic_forms(rng):
    K = ip.DeltaComplex.from_lengths(np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])
    graph = double_graph(K)
    assert harmonic_forms(K).shape == (0, 6)
    assert holomorphic_forms(K).shape == (0, 2, 6)
    assert symplectic_mean_forms(K).shape == (0, 2, 6)
    alpha = rng.normal(size=(2, 6))
    parts = hodge_decomposition(graph, alpha)
    assert not parts.harmonic.any()
    assert close(parts.exact + parts.coexact, alpha)
    assert close(d1(graph, parts.exact), 0)
    assert close(adjoint_d0(graph, parts.coexact), 0)


# What is refused.


def test_a_triangulation_that_is_not_delaunay_is_refused():
    K = distorted(L_SHAPE, 3, 0.15, 0)
    for function in (holomorphic_forms, symplectic_mean_forms):
        with pytest.raises(ip.ComplexError, match="Run Delaunay first"):
            function(K)


def test_surfaces_that_are_not_closed_are_refused():
    K = ip.DeltaComplex.from_lengths(np.ones((1, 3)), [[0, 1, 2]])
    for function in (harmonic_forms, holomorphic_forms, symplectic_mean_forms):
        with pytest.raises(ip.ComplexError, match="not closed"):
            function(K)
    with pytest.raises(ip.ComplexError, match="not closed"):
        periods(K, np.zeros((2, 3)))


def test_cocycles_that_do_not_fit_are_refused():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 2)
    basis = ip.cohomology_basis(K)
    with pytest.raises(ip.ComplexError, match=r"shape \(4, 36\).* not \(3, 36\)"):
        harmonic_forms(K, basis[:3])
    with pytest.raises(ip.ComplexError, match="not closed on the triangles"):
        holomorphic_forms(K, csr_array(np.arange(4 * 36).reshape(4, 36)))
    with pytest.raises(ip.ComplexError, match="their pairing is not J"):
        periods(K, np.zeros((2, 36)), basis[::-1])
    # The cocycles of the surface before the flips are not closed after them.
    before = distorted(L_SHAPE, 3, 0.15, 0)
    after, _ = intrinsic_delaunay(before, csr_array((0, 81), dtype=np.int64))
    with pytest.raises(ip.ComplexError, match="not closed on the triangles"):
        holomorphic_forms(after, ip.cohomology_basis(before))


def test_real_mesh_of_genus_3(mesh):
    K = ip.DeltaComplex.from_mesh(*mesh("3holes.obj"))
    surface = marked(K)
    g = surface.pm.genus
    both = periods(
        surface.graph.complex,
        holomorphic_forms(surface.graph, surface.cocycles),
        surface.cocycles,
    )
    assert g == 3
    assert close(both[:, 0, g:], surface.pm.primal)
    assert close(both[:, 1, g:], surface.pm.dual)
