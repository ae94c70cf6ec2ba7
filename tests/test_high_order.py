"""Elements of high degree: exact values inside the certificate, rates, invariance, rounding."""

from dataclasses import replace
from functools import cache
from itertools import pairwise, product

import numpy as np
import pytest
import scipy.linalg
from extended_precision import Extended, gram_matrix
from random_surfaces import BOLZA, HEXAGON, L_SHAPE, random_gluing, random_lengths
from scipy.integrate import quad

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.triangles import angles
from igl_periods.complexes.weights import cone_angles
from igl_periods.elements import trace_system as assembly
from igl_periods.elements.condensation import condense_block, scaled_gradients, stiffness
from igl_periods.elements.least_energy import (
    coefficients,
    dirichlet_matrix,
    high_order_forms,
    rounding_allowance,
)
from igl_periods.elements.placement import choose_elements, is_cone, separate_cones, shaped_elements
from igl_periods.elements.point_values import edge_integrals, gradients, potentials
from igl_periods.elements.reference_elements import conical_element, flat_element
from igl_periods.harmonic.energies import dirichlet_matrix as p1_dirichlet_matrix
from igl_periods.periods.rounding import congruence
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.surfaces.regular_maps import regular_map_period_matrix, regular_map_surface
from igl_periods.surfaces.square_tiled import (
    glued_rectangles,
    origami,
    square_tiled_period_matrix,
    square_tiled_surface,
)
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.symplectic.williamson_form import energy_matrix, siegel_point, williamson

SMALL = 1e-13


def forms_of(K, degree):
    return high_order_forms(K, ip.cohomology_basis(K), degree)


def bound_of(K, degree):
    return williamson(dirichlet_matrix(forms_of(K, degree)))[0][0] - 1.0


def relative_eigenvalues(A, D):
    return scipy.linalg.eigvalsh(A, D)


def rectangular_L(a, b, c, d):
    """The L-shape glued from rectangles of widths a, b and heights c, d."""
    return glued_rectangles([(a, c), (b, c), (a, d)], L_SHAPE)


RNG = np.random.default_rng(3)


def random_origami(n_squares):
    while True:
        try:
            K = origami(RNG.permutation(n_squares), RNG.permutation(n_squares))
        except ip.ComplexError:
            continue
        if K.genus >= 2:
            return K


def random_cone_surface(n_faces, seed):
    rng = np.random.default_rng(seed)
    while True:
        twin = random_gluing(n_faces, rng)
        K = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin)
        if len(K.components()) == 1 and K.genus:
            return K


ORIGAMIS = [random_origami(n) for n in (5, 6, 7, 8)]


# The reference elements.


@pytest.mark.parametrize("degree", [1, 2, 5, 9])
def test_flat_element_spans_the_polynomials(degree):
    rng = np.random.default_rng(0)
    s, t = rng.uniform(size=(2, 300))
    values, by_t, by_s = flat_element(degree).tabulate(s, t)
    assert values.shape[1] == (degree + 1) * (degree + 2) // 2
    x, y = t * (1 - s), t * s
    monomials = np.stack([x**i * y**j for i in range(degree + 1) for j in range(degree + 1 - i)], 1)
    solution, *_ = np.linalg.lstsq(values, monomials, rcond=None)
    assert np.abs(values @ solution - monomials).max() < 1e-11
    # The derivatives belong to the values: u_t and u_s / t of every monomial.
    assert np.abs(by_t @ solution * t[:, None] - (x * (d := _slopes(degree, x, y))[0].T
                  + y * d[1].T).T).max() < 1e-10  # fmt: skip
    assert np.abs(by_s @ solution - (d[1] - d[0])).max() < 1e-10


def _slopes(degree, x, y):
    powers = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    by_x = np.stack([i * x ** max(i - 1, 0) * y**j for i, j in powers], axis=1)
    by_y = np.stack([j * x**i * y ** max(j - 1, 0) for i, j in powers], axis=1)
    return by_x, by_y


@pytest.mark.parametrize("degree", [1, 2, 5])
def test_conical_element_spans_degree_p_in_both(degree):
    s, tau = np.random.default_rng(0).uniform(size=(2, 300))
    values, _, _ = conical_element(degree).tabulate(s, tau)
    assert values.shape[1] == degree * (degree + 1) + 1
    products = [tau**i * s**j for i in range(1, degree + 1) for j in range(degree + 1)]
    wanted = np.stack([np.ones_like(s), *products], axis=1)
    solution, *_ = np.linalg.lstsq(values, wanted, rcond=None)
    assert np.abs(values @ solution - wanted).max() < 1e-11


@pytest.mark.parametrize("element", [flat_element, conical_element])
def test_traces_of_both_elements_are_the_same(element):
    degree, x = 6, np.linspace(0.0, 1.0, 23)
    along = conical_element(degree).tabulate(x, np.ones_like(x))[0][
        :, [1, 2, *range(3, degree + 2)]
    ]
    n = 3 * degree
    sides = {  # the side, its coordinates (s, τ) at x, and its functions in the order of ``along``
        0: (x, np.ones_like(x), [1, 2, *range(3, degree + 2)]),
        1: (np.ones_like(x), 1 - x, [2, 0, *range(degree + 2, 2 * degree + 1)]),
        2: (np.zeros_like(x), x, [0, 1, *range(2 * degree + 1, n)]),
    }
    for s, tau, functions in sides.values():
        values = element(degree).tabulate(s, tau)[0]
        assert np.abs(values[:, functions] - along).max() < 1e-14
        others = np.setdiff1d(np.arange(values.shape[1]), functions)
        assert np.abs(values[:, others]).max() < 1e-14


def test_energy_of_the_power_function_on_a_cone():
    # The conical element contains the radial factor of Re z^κ, and approximates the angular one
    # exponentially.
    theta, lengths = 5.0, np.array([[0.9, 1.3, 1.1]])
    kappa = 2 * np.pi / theta
    K = ip.DeltaComplex.from_gluing(lengths, [[-1, -1, -1]])
    a, b = lengths[0, 2] + 0j, lengths[0, 1] * np.exp(1j * angles(lengths)[0, 0])

    def energy(degree):
        reference = conical_element(degree)
        face = shaped_elements(K, reference, np.array([0]), np.array([0]), np.array([kappa]))
        s = 0.5 - 0.5 * np.cos(np.pi * np.arange(40) / 39)
        along = conical_element(degree).tabulate(s, np.ones_like(s))[0][:, 1 : degree + 2]
        wanted = ((a + s * (b - a)) ** kappa).real
        u = np.zeros((reference.n_functions, 1, 1))
        u[1 : degree + 2, 0, 0] = np.linalg.lstsq(along, wanted, rcond=None)[0]
        return sum(np.sum(X**2) for X in scaled_gradients(face, np.array([0]), u))

    def density(s):
        # ∫ |∇ Re z^κ|² t dt = κ² |R|^{2κ-2} / 2κ, times the area element |R × R'|.
        R = a + s * (b - a)
        return 0.5 * kappa * abs(R) ** (2 * kappa - 2) * abs((np.conj(R) * (b - a)).imag)

    exact = quad(density, 0, 1, epsabs=0, epsrel=1e-13)[0]
    errors = [abs(energy(degree) / exact - 1) for degree in (3, 6, 9, 12)]
    assert errors[-1] < 1e-12
    assert errors[0] > 100 * errors[1] > 1e4 * errors[2]


@pytest.mark.parametrize("K", [ORIGAMIS[0], random_cone_surface(6, 0)])
def test_stiffness_is_the_gram_matrix_of_gradients(K):
    K, _ = separate_cones(K, ip.cohomology_basis(K))
    for elements in choose_elements(K, 5):
        block = np.arange(elements.face.size)
        n = elements.reference.n_functions
        identity = np.repeat(np.eye(n)[:, None, :], block.size, axis=1)
        X = np.concatenate(list(scaled_gradients(elements, block, identity)))
        matrices = stiffness(elements, block)
        assert np.allclose(matrices, np.einsum("qbi,qbj->bij", X, X), rtol=1e-12, atol=1e-11)
        S, E = condense_block(elements, block)
        extended = np.concatenate([np.repeat(np.eye(15)[None], block.size, axis=0), E], axis=1)
        assert np.allclose(S, extended.transpose(0, 2, 1) @ matrices @ extended, atol=1e-11)


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


# Cone points.


@pytest.mark.parametrize(("theta", "n_faces"), [(8.0, 2), (30.0, 2), (1100.0, 12), (1500.0, 14)])
def test_extreme_cone_angles(theta, n_faces):
    K = surface_with_cone(np.radians(theta), n_faces)
    assert np.isclose(np.degrees(cone_angles(K)), theta, rtol=1e-9).any()
    bounds = [bound_of(K, degree) for degree in (4, 8, 12)]
    assert bounds[2] < 0.05 * bounds[1] < 0.0025 * bounds[0] < 0.0025


def surface_with_cone(theta, n_faces):
    """A fan of triangles around a point of angle θ, with equilateral triangles on its rim.

    The sides of those that remain free are glued in pairs at random.
    """
    rng = np.random.default_rng(n_faces)
    base = 2 * np.sin(0.5 * theta / n_faces)
    lengths = np.full((2 * n_faces, 3), base)
    lengths[:n_faces, 1:] = 1.0
    i = np.arange(n_faces)
    twin = np.empty(6 * n_faces, dtype=int)
    twin[3 * i], twin[3 * (n_faces + i)] = 3 * (n_faces + i), 3 * i
    twin[3 * i + 1], twin[3 * np.roll(i, -1) + 2] = 3 * np.roll(i, -1) + 2, 3 * i + 1
    free = 3 * (n_faces + np.repeat(i, 2)) + np.tile([1, 2], n_faces)
    while True:
        order = rng.permutation(free)
        twin[order[0::2]], twin[order[1::2]] = order[1::2], order[0::2]
        K = ip.DeltaComplex.from_gluing(lengths, twin.reshape(-1, 3))
        if K.genus >= 1:
            return K


def test_cones_are_separated_once_and_only_where_needed():
    K = square_tiled_surface("omega_2")
    assert forms_of(K, 2).complex.n_faces == 4 * K.n_faces
    fine = square_tiled_surface("omega_2", 2)
    assert forms_of(fine, 2).complex is fine
    refined = forms_of(K, 2).complex
    assert np.array_equal(np.flatnonzero(is_cone(refined)), [0, 1])
    assert is_cone(refined)[refined.corner_vertex].sum(axis=1).max() == 1


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


def test_degree_zero_is_refused():
    with pytest.raises(ValueError, match="degree = 0: trial functions have degree 1 at least"):
        forms_of(ORIGAMIS[0], 0)


def test_arithmetic_that_breaks_down_is_reported(monkeypatch):
    K = ORIGAMIS[0]
    system = assembly.condensed_system(K, ip.cohomology_basis(K), choose_elements(K, 2))
    lost = replace(system, matrix=0.0 * system.matrix)
    with pytest.raises(ip.ComplexError, match="some triangles are too thin for elements of high"):
        assembly.least_traces(lost)

    def singular(elements):
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr(assembly, "condense", singular)
    with pytest.raises(ip.ComplexError, match="not positive definite in floating-point arithmetic"):
        forms_of(K, 2)


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


def test_symmetric_forms_of_three_gluings_use_all_elements():
    # n = 2 has flat and conical faces, n = 1 of the L only conical ones after the division.
    kinds = {
        tuple(e.reference for e in forms_of(ip.DeltaComplex.from_squares(g, n), 3).elements)
        for g in (L_SHAPE, BOLZA, HEXAGON)
        for n in (1, 2)
    }
    assert kinds == {(flat_element(3), conical_element(3))}
