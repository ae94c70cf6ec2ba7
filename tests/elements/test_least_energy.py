"""Elements of high degree: exact values inside the certificate, rates, invariance, rounding."""

from functools import cache
from itertools import pairwise, product

import numpy as np
import pytest
import scipy.linalg
from support.cone_surfaces import ORIGAMIS, bound_of, forms_of, random_cone_surface, rectangular_L
from support.extended_precision import Extended, gram_matrix
from support.random_surfaces import random_gluing, random_lengths

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.elements.least_energy import (
    dirichlet_matrix,
    energy_excess,
    high_order_forms,
    rounding_allowance,
)
from igl_periods.elements.reference_elements import conical_element, flat_element
from igl_periods.elements.trial_forms import coefficients
from igl_periods.harmonic.energies import dirichlet_matrix as p1_dirichlet_matrix
from igl_periods.periods.rounding import congruence
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.surfaces.regular_maps import regular_map_period_matrix, regular_map_surface
from igl_periods.surfaces.square_tiled import square_tiled_period_matrix, square_tiled_surface
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.symplectic.williamson_form import (
    cholesky_factor,
    energy_matrix,
    siegel_point,
    williamson,
    williamson_basis,
)


@pytest.mark.parametrize("degree", [1, 3, 6, 11])
def test_shares_of_faces_add_up_to_the_excess(degree):
    rng = np.random.default_rng(2)
    twin = random_gluing(8, rng)
    K = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()[0]
    forms = high_order_forms(K, ip.cohomology_basis(K), degree)
    D = dirichlet_matrix(forms)
    shares = energy_excess(forms, williamson_basis(cholesky_factor(D)))
    assert shares.shape == (K.genus, forms.complex.n_faces)
    assert shares.min() >= 0.0
    assert np.allclose(shares.sum(axis=1), williamson(D)[0] - 1, rtol=1e-4, atol=1e-14)


SMALL = 1e-13


def relative_eigenvalues(A, D):
    return scipy.linalg.eigvalsh(A, D)


# The surfaces whose period matrix is known.
@cache
def exact_energies(name, degree=12):
    """The Dirichlet matrix of a surface by its known period matrix, in the marking of KNOWN.

    The marking is found by searching integer vectors of the right energies and pairings, in
    Siegel-reduced bases, for one symplectic basis that matches.
    """
    K, exact = KNOWN[name]
    g = len(exact)
    _, G = williamson(dirichlet_matrix(forms_of(K, degree)))
    here, there = siegel_reduce(siegel_point(G)), siegel_reduce(exact)
    D1, D2, J = energy_matrix(there.matrix), energy_matrix(here.matrix), standard_form(g)
    vectors = np.array(list(product((-2, -1, 0, 1, 2), repeat=2 * g)))
    energies = np.einsum("ni,ij,nj->n", vectors, D1, vectors)
    vectors = vectors[energies < D2.diagonal().max() + 1e-6]
    products, pairings = vectors @ D1 @ vectors.T, vectors @ J @ vectors.T
    rows = _matching_rows(products, pairings, D2, J, [])
    assert rows is not None, "the period matrix is not the known one"
    U = vectors[rows]
    back = np.diag([1] * g + [-1] * g)
    V = back @ np.round(np.linalg.inv(here.gamma)).astype(int) @ back
    assert np.array_equal(V @ J @ V.T, J)
    return V @ U @ D1 @ U.T @ V.T


def _matching_rows(products, pairings, D, J, rows):
    i = len(rows)
    if i == len(D):
        return rows
    fits = np.abs(np.diag(products) - D[i, i]) < 1e-6
    for k, row in enumerate(rows):
        fits &= (pairings[:, row] == J[i, k]) & (np.abs(products[:, row] - D[i, k]) < 1e-6)
    found = (_matching_rows(products, pairings, D, J, [*rows, row]) for row in np.flatnonzero(fits))
    return next((complete for complete in found if complete is not None), None)


KNOWN = {
    **{n: (square_tiled_surface(n), square_tiled_period_matrix(n))
       for n in ("omega_1", "omega_2", "omega_3")},
    **{n: (regular_map_surface(n), regular_map_period_matrix(n)) for n in ("schwarz_p", "bring")},
}  # fmt: skip


@pytest.mark.parametrize("name", KNOWN)
def test_exact_value_is_in_the_bracket_at_every_degree(name):
    K, Pi = KNOWN[name]
    exact, J = exact_energies(name), standard_form(len(Pi))
    whitening = np.linalg.inv(np.linalg.cholesky(siegel_point(exact).imag))
    for degree in (1, 2, 3, 5, 8, 12, 18):
        D = dirichlet_matrix(forms_of(K, degree))
        assert relative_eigenvalues(D - exact, exact)[0] > -SMALL
        assert relative_eigenvalues(exact - J @ np.linalg.inv(D) @ J.T, exact)[0] > -SMALL
        d, G = williamson(D)
        error = whitening @ (siegel_point(G) - siegel_point(exact)) @ whitening.T
        assert np.linalg.norm(error, 2) <= d[0] - 1 + SMALL
    assert d[0] - 1 < SMALL


@pytest.mark.parametrize("name", ["omega_1", "omega_2", "omega_3"])
def test_eleven_digits_from_the_coarsest_gluing(name):
    K, Pi = KNOWN[name]
    exact = siegel_point(exact_energies(name))
    D = dirichlet_matrix(forms_of(K, 14))
    assert williamson(D)[0][0] - 1 < 1e-11
    g = len(Pi)
    primal = np.linalg.inv(D[g:, g:]) * 1j - D[:g, g:] @ np.linalg.inv(D[g:, g:])
    assert np.abs(primal - exact).max() < 1e-11


def test_published_error_of_the_prototype():
    # The L-shaped origami on 24 triangles: d_max - 1 at degree 4, 6, 8, 10, 12.
    expected = [1.6e-4, 5.5e-6, 8.4e-8, 1.6e-9, 4.8e-11]
    measured = [bound_of(KNOWN["omega_1"][0], degree) for degree in (4, 6, 8, 10, 12)]
    assert forms_of(KNOWN["omega_1"][0], 4).complex.n_faces == 24
    assert np.allclose(measured, expected, rtol=0.06)


@pytest.mark.parametrize("name", KNOWN)
def test_error_decreases_exponentially(name):
    degrees = np.arange(4, 13)
    logs = np.log10([bound_of(KNOWN[name][0], int(degree)) for degree in degrees])
    slope, intercept = np.polyfit(degrees, logs, 1)
    assert slope < -0.7
    assert np.abs(logs - slope * degrees - intercept).max() < 0.35


# Asymmetric surfaces, where no symmetry can hide an error.
@pytest.mark.parametrize(
    "K", [*ORIGAMIS, rectangular_L(1.0, np.sqrt(2.0), np.pi / 3, np.e / 2)],
    ids=["5 squares", "6 squares", "7 squares", "8 squares", "irrational L"],
)  # fmt: skip
def test_asymmetric_flat_surfaces(K):
    degrees = (10, 14, 18)
    results = [williamson(dirichlet_matrix(forms_of(K, degree))) for degree in degrees]
    bounds = [d[0] - 1 + SMALL for d, _ in results]
    assert bounds[-1] < 1e-10
    finest = siegel_point(results[-1][1])
    scale = np.sqrt(np.outer(finest.imag.diagonal(), finest.imag.diagonal()))
    for bound, (_, G) in zip(bounds, results, strict=True):
        assert np.all(np.abs(siegel_point(G) - finest) <= (bound + bounds[-1]) * scale)


@pytest.mark.parametrize("seed", range(4))
def test_cone_surfaces_with_faces_glued_to_themselves(seed):
    K = random_cone_surface(4 if seed % 2 else 6, seed)
    matrices = [dirichlet_matrix(forms_of(K, degree)) for degree in (3, 6, 9, 12)]
    for coarse, fine in pairwise(matrices):
        # Trial spaces are nested.
        assert relative_eigenvalues(coarse - fine, fine)[0] > -SMALL
    bounds = [williamson(D)[0][0] - 1 for D in matrices]
    assert bounds[-1] < 1e-7
    assert bounds[-1] < 0.02 * bounds[-2] < 4e-4 * bounds[-3]


@pytest.mark.parametrize("K", [ORIGAMIS[1], random_cone_surface(8, 7)])
def test_numbering_and_scale_do_not_matter(K):
    basis = ip.cohomology_basis(K)
    D = dirichlet_matrix(high_order_forms(K, basis, 5))
    rng = np.random.default_rng(0)
    order, turn = rng.permutation(K.n_faces), rng.integers(0, 3, K.n_faces)
    # Face f becomes row place[f], its side s becomes side s - turn.
    place = np.argsort(order)
    half_edge = 3 * place[:, None] + (np.arange(3) - turn[:, None]) % 3
    twin, lengths = np.empty(3 * K.n_faces, dtype=int), np.empty(3 * K.n_faces)
    twin[half_edge.ravel()] = half_edge.ravel()[K.twin.ravel()]
    lengths[half_edge.ravel()] = 17.0 * K.lengths.ravel()
    L = ip.DeltaComplex.from_gluing(lengths.reshape(-1, 3), twin.reshape(-1, 3))
    values = np.zeros((basis.shape[0], L.n_edges), dtype=int)
    along = K.sign.ravel() * basis.toarray()[:, K.edge.ravel()]
    values[:, L.edge.ravel()[half_edge.ravel()]] = along * L.sign.ravel()[half_edge.ravel()]
    changed = dirichlet_matrix(high_order_forms(L, type(basis)(values), 5))
    assert np.allclose(changed, D, rtol=0, atol=1e-12 * np.abs(D).max())


def test_cochains_of_one_class_have_one_form():
    K = ORIGAMIS[2]
    basis = ip.cohomology_basis(K)
    shift = np.random.default_rng(0).integers(-3, 4, (basis.shape[0], K.n_vertices))
    tail, head = np.empty((2, K.n_edges), dtype=int)
    forward = np.flatnonzero(K.sign.ravel() > 0)
    tail[K.edge.ravel()[forward]] = np.roll(K.corner_vertex, -1, 1).ravel()[forward]
    head[K.edge.ravel()[forward]] = np.roll(K.corner_vertex, 1, 1).ravel()[forward]
    moved = type(basis)(basis.toarray() + shift[:, head] - shift[:, tail])
    D, E = (dirichlet_matrix(high_order_forms(K, c, 6)) for c in (basis, moved))
    assert np.allclose(D, E, rtol=0, atol=1e-12 * np.abs(D).max())


def test_flat_torus_is_exact_at_every_degree():
    # One vertex, two triangles, no cone: constant forms are in every trial space.
    tau = 0.3 + 1.1j
    lengths = [abs(tau), abs(1 + tau), 1.0]
    K = ip.DeltaComplex.from_gluing(
        [lengths, [1.0, abs(tau), abs(1 + tau)]], [[4, 5, 3], [2, 0, 1]]
    )
    assert (K.n_vertices, K.genus) == (1, 1)
    for degree in (1, 2, 3, 7, 12):
        forms = forms_of(K, degree)
        assert forms.complex is K
        d, G = williamson(dirichlet_matrix(forms))
        assert abs(d[0] - 1) < 1e-14
        reduced = siegel_reduce(siegel_point(G)).matrix[0, 0]
        assert abs(reduced.imag - tau.imag) < 1e-14
        assert abs(abs(reduced.real) - tau.real) < 1e-14


def test_degree_one_without_cones_is_cotangent():
    K = square_tiled_surface("omega_2", 3)
    basis = ip.cohomology_basis(K)
    forms = high_order_forms(K, basis, 1)
    assert forms.complex is K
    flat, conical = forms.elements
    assert (flat.reference, conical.reference) == (flat_element(1), conical_element(1))
    # On the flat faces the energy of these forms is that of linear functions on them.
    weights = np.zeros(K.n_faces)
    weights[flat.face] = 1.0
    ours = dirichlet_matrix(forms, weights)
    theirs = p1_dirichlet_matrix(K, basis, forms.traces, weights)
    assert np.allclose(ours, theirs, rtol=0, atol=1e-13 * np.abs(theirs).max())


def test_degree_zero_is_refused():
    with pytest.raises(ValueError, match="degree = 0: trial functions have degree 1 at least"):
        forms_of(ORIGAMIS[0], 0)


# Rounding.
@pytest.mark.skipif(np.finfo(Extended).eps > 1e-18, reason="no extended precision on this machine")
@pytest.mark.parametrize("degree", [2, 7, 12, pytest.param(18, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", ["omega_1", "cones", "needles"])
def test_rounding_stays_within_its_allowance(name, degree):
    K = {
        "omega_1": square_tiled_surface("omega_1"),
        "cones": random_cone_surface(4, 1),
        "needles": rectangular_L(1.0, 1.3, 1e-3, 2e-3),
    }[name]
    forms = forms_of(K, degree)
    D = dirichlet_matrix(forms)
    exact = gram_matrix(forms, lambda elements, block: coefficients(forms, elements, block))
    error = np.abs(relative_eigenvalues((D - exact).astype(float), D)).max()
    allowance = rounding_allowance(forms, D)
    _, loss = congruence(np.eye(len(D), dtype=int), D)
    assert error < allowance + loss
    if name != "needles":
        assert error < 1e-14 < allowance < 1e-13


def test_allowance_grows_with_thin_triangles():
    allowances = []
    for width in (1.0, 1e-3, 1e-6):
        forms = forms_of(rectangular_L(1.0, 1.3, width, 2 * width), 4)
        allowances.append(rounding_allowance(forms, dirichlet_matrix(forms)))
    assert allowances[0] < 1e-13
    assert 1e-12 < allowances[1] < 1e-11
    assert 1e-9 < allowances[2] < 1e-8


# Real meshes.
def test_prototype_numbers_on_a_real_mesh(mesh):
    K = ip.DeltaComplex.from_mesh(*mesh("eight.off"))
    K, cochains = intrinsic_delaunay(K, ip.cohomology_basis(K))
    expected = {2: 1.5e-6, 3: 5.0e-8, 4: 2.9e-9}
    for degree, bound in expected.items():
        d, _ = williamson(dirichlet_matrix(high_order_forms(K, cochains, degree)))
        assert np.isclose(d[0] - 1, bound, rtol=0.03)
