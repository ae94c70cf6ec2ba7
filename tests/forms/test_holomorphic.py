"""Holomorphic forms on Λ: type, periods, energies, and the period matrix."""

import numpy as np
import pytest
import scipy.linalg
from scipy.sparse import csr_array
from support.delaunay_surfaces import distorted, flat_torus, marked
from support.discrete_forms import close_after_solving, on_lambda
from support.random_surfaces import BOLZA, L_SHAPE

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.weights import cotan_weights
from igl_periods.forms.calculus import (
    adjoint_d0,
    area,
    conformal_energy,
    d1,
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


# Holomorphic forms.
def test_holomorphic_forms_are_closed_and_of_type_10(surface):
    graph, K = surface.graph, surface.graph.complex
    zeta = holomorphic_forms(K, surface.cocycles)
    assert zeta.shape == (surface.pm.genus, 2, K.n_edges)
    restricted = on_lambda(surface, zeta)
    assert close_after_solving(hodge_star(graph, restricted), -1j * restricted)
    assert close_after_solving(d1(graph, restricted), 0)
    assert close_after_solving(laplacian_1(graph, restricted), 0)
    assert is_holomorphic_form(graph, restricted).all()
    # On Γ they are closed on the triangles too, across edges that Γ does not have.
    assert close_after_solving((K.sign * zeta[:, 0][:, K.edge]).sum(axis=2), 0)
    contracted = np.setdiff1d(np.arange(K.n_edges), graph.edges)
    assert not zeta[:, 1, contracted].any()


def test_periods_of_holomorphic_forms_are_the_primal_and_the_dual_estimate(surface):
    # The a-periods are δ on both graphs; the b-periods on Γ are Π_primal, those on Γ* Π_dual,
    # the period matrix of the paper, and their mean is the paper's Ω_D.
    pm, g = surface.pm, surface.pm.genus
    zeta = holomorphic_forms(surface.graph.complex, surface.cocycles)
    on_gamma, on_dual = np.moveaxis(periods(surface.graph.complex, zeta, surface.cocycles), 1, 0)
    assert close_after_solving(on_gamma[:, :g], np.eye(g))
    assert close_after_solving(on_dual[:, :g], np.eye(g))
    assert close_after_solving(on_gamma[:, g:], pm.primal)
    assert close_after_solving(on_dual[:, g:], pm.dual)
    assert close_after_solving(0.5 * (on_gamma + on_dual)[:, g:], pm.mean)


def test_products_of_holomorphic_forms_are_imaginary_parts_of_periods(surface):
    # i ∬ ζ_k ∧ ζ̄_l = (ζ_k, ζ_l) = 2 Im Π_kl for a Riemann surface.  Here, by the bilinear relation,
    # Π is the mean; real parts cancel, since those of primal and dual are transposed.
    graph, pm = surface.graph, surface.pm
    zeta = on_lambda(surface, holomorphic_forms(graph, surface.cocycles))
    product = scalar_product(graph, zeta[:, None], zeta[None])
    assert close_after_solving(product, 1j * wedge(zeta[:, None], zeta.conj()[None]).sum(axis=-1))
    assert close_after_solving(product, 2 * pm.mean.imag)
    assert close_after_solving(conformal_energy(graph, zeta), 0)
    assert close_after_solving(area(zeta), np.diag(pm.mean.imag))


def test_the_default_marking_is_that_of_the_period_matrix():
    K, _ = intrinsic_delaunay(distorted(L_SHAPE, 3, 0.15, 7), csr_array((0, 81), dtype=np.int64))
    pm = ip.period_matrix(K)
    assert np.abs(pm.primal - pm.primal.T).max() > 0.01
    both = periods(K, holomorphic_forms(K))
    assert close_after_solving(both[:, 0, 2:], pm.primal)
    assert close_after_solving(both[:, 1, 2:], pm.dual)


def test_holomorphic_forms_of_abstract_weights(rng):
    K = ip.DeltaComplex.from_squares(BOLZA, 2)
    weights = rng.uniform(0.2, 3.0, K.n_edges)
    pm = ip.period_matrix_from_weights(weights[K.edge], K.twin)
    graph = double_graph(K, weights)
    both = periods(K, holomorphic_forms(graph))
    assert close_after_solving(both[:, 0, 2:], pm.primal)
    assert close_after_solving(both[:, 1, 2:], pm.dual)
    mean = periods(K, symplectic_mean_forms(graph))
    assert close_after_solving(mean[:, :, 2:], pm.matrix[:, None])


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
        assert close_after_solving(a, a_dual)
        assert close_after_solving(np.einsum("k,kse->se", a, holomorphic_forms(K)), dz)


def test_flat_torus_has_its_exact_form():
    # ζ = dz / a on Γ with the displacements of the edges; on Γ* by a quarter turn, times ρ.
    K, _ = flat_torus(7, 6, 0.12, 1)
    pm = ip.period_matrix(K)
    flipped, cocycles = intrinsic_delaunay(K, pm.cocycles)
    zeta = holomorphic_forms(flipped, cocycles)[0]
    length = np.empty(flipped.n_edges)
    length[flipped.edge] = flipped.lengths
    ratio = np.abs(zeta[0]) / length
    assert close_after_solving(ratio, ratio.mean())
    assert close_after_solving(np.abs(zeta[1]), ratio.mean() * cotan_weights(flipped) * length)
    # Area 1.1 in the metric: Im τ = area / |a|².
    assert close_after_solving(pm.matrix[0, 0].imag, 1.1 * ratio.mean() ** 2)
    assert close_after_solving(pm.primal, pm.dual)


# The forms of the symplectic mean.
def test_forms_of_the_symplectic_mean(surface):
    graph, pm, g = surface.graph, surface.pm, surface.pm.genus
    forms = symplectic_mean_forms(graph, surface.cocycles)
    both = periods(graph.complex, forms, surface.cocycles)
    assert close_after_solving(both[:, :, :g], np.eye(g)[:, None])
    assert close_after_solving(both[:, :, g:], pm.matrix[:, None])
    restricted = on_lambda(surface, forms)
    assert close_after_solving(d1(graph, restricted), 0)
    assert close_after_solving(adjoint_d0(graph, restricted), 0)
    assert close_after_solving(area(restricted), np.diag(pm.matrix.imag))


def test_conformal_energies_of_the_symplectic_mean_are_its_symplectic_eigenvalues(surface):
    graph, pm = surface.graph, surface.pm
    defect = type_01(graph, on_lambda(surface, symplectic_mean_forms(graph, surface.cocycles)))
    energies = 2 * scalar_product(graph, defect[:, None], defect[None])
    relative = scipy.linalg.eigvalsh(energies, pm.matrix.imag)[::-1]
    d = pm.symplectic_eigenvalues
    assert close_after_solving(relative, (np.sqrt(d) - 1 / np.sqrt(d)) ** 2)


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
    assert close_after_solving(least, np.sum(d + 1 / d - 2))
    for size in (1e-4, 1e-2, 0.1):
        A, B = rng.normal(size=(2, g, g))
        step = A + A.T + 1j * (B + B.T)
        other = pm.matrix + size * step * np.linalg.eigvalsh(pm.matrix.imag)[0] / (4 * g)
        assert energy(other) > least


def test_type_is_exact_where_the_symplectic_eigenvalues_are_1():
    graph = double_graph(intrinsic_delaunay(flat_torus(7, 6, 0.12, 1)[0], csr_array((0, 126)))[0])
    forms = symplectic_mean_forms(graph)[..., graph.edges]
    assert is_holomorphic_form(graph, forms, 1e-11).all()
    assert close_after_solving(forms, holomorphic_forms(graph)[..., graph.edges])


def test_a_sphere_has_no_harmonic_forms(rng):
    K = ip.DeltaComplex.from_lengths(np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])
    graph = double_graph(K)
    assert harmonic_forms(K).shape == (0, 6)
    assert holomorphic_forms(K).shape == (0, 2, 6)
    assert symplectic_mean_forms(K).shape == (0, 2, 6)
    alpha = rng.normal(size=(2, 6))
    parts = hodge_decomposition(graph, alpha)
    assert not parts.harmonic.any()
    assert close_after_solving(parts.exact + parts.coexact, alpha)
    assert close_after_solving(d1(graph, parts.exact), 0)
    assert close_after_solving(adjoint_d0(graph, parts.coexact), 0)


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
    assert close_after_solving(both[:, 0, g:], surface.pm.primal)
    assert close_after_solving(both[:, 1, g:], surface.pm.dual)
