"""Energies of high degree in balls: recomputed in 300 bits from polynomials, without quadrature."""

import dataclasses

import numpy as np
import pytest
from flint import arb, arb_mat
from scipy.sparse import csr_array
from support.delaunay_surfaces import distorted
from support.energies_in_300_bits import contains, flipped_surface, polynomial_energies
from support.extreme_surfaces import capped_torus, spiked_torus
from support.random_surfaces import L_SHAPE, needle_gluing, noisy_torus

import igl_periods as ip
from igl_periods.complexes.delaunay import delaunay_flips
from igl_periods.elements import dirichlet_matrix, high_order_forms
from igl_periods.elements.least_energy import least_energy_forms
from igl_periods.elements.placement import Elements, flat_elements
from igl_periods.elements.reference_elements import conical_element, flat_element
from igl_periods.proofs.length_balls import after_midpoints
from igl_periods.proofs.midpoint_radius import Balls
from igl_periods.proofs.polynomial_energies import enclosed_energies, enclosed_reference
from igl_periods.proofs.proved_energies import orthonormal_combination
from igl_periods.proofs.surface_proofs import EnclosedTriangulation
from igl_periods.topology import cochains_and_basis, mark


def surfaces():
    rng = np.random.default_rng(7)
    yield "L", ip.DeltaComplex.from_squares(L_SHAPE, 1)
    yield "distorted L", distorted(L_SHAPE, 1, 0.15, 0)
    yield "torus", ip.DeltaComplex.from_mesh(*noisy_torus(4, 5, 0.05, 1))
    yield "needles", ip.DeltaComplex.from_gluing(*needle_gluing(6, 4, rng))
    yield "caps", capped_torus(1e-4, 3)
    yield "spike", spiked_torus(1e6, 2)


SURFACES = {
    name: max((part for part in K.components()), key=lambda part: part.genus)
    for name, K in surfaces()
}
ORDINARY = ("L", "distorted L", "torus")


def exact_coefficients(forms):
    """The coefficients that the stored numbers stand for: differences and jumps are not rounded."""
    K, cochains = forms.complex, forms.cochains.toarray()
    p = forms.degree

    def on_face(elements, m):
        face, apex = int(elements.face[m]), int(elements.apex[m])
        corner = [(apex + i) % 3 for i in range(3)]
        f = forms.traces[K.corner_vertex[face, corner]]
        values = [c * s for c, s in zip(cochains[:, K.edge[face]].T, K.sign[face], strict=True)]
        jumps = values[corner[2]], -values[corner[1]]
        rows = [[arb(0)] * len(cochains)]
        for i, jump in enumerate(jumps, start=1):
            rows.append(
                [arb(float(y)) - arb(float(x)) + arb(float(z)) for x, y, z in zip(f[0], f[i], jump)]
            )
        stored = [np.zeros_like(f[0]), f[1] - f[0] + jumps[0], f[2] - f[0] + jumps[1]]
        for side in corner:
            for k in range(p - 1):
                unknown = K.n_vertices + (p - 1) * K.edge[face, side] + k
                sign = K.sign[face, side] if k % 2 else 1
                stored.append(sign * forms.traces[unknown])
        # Coefficients of bubbles are whatever the extension makes of the rounded ones.
        extension = forms.extensions[forms.elements.index(elements)][m]
        bubbles = (extension[None] @ np.array(stored)[None])[0]
        rows += [[arb(float(x)) for x in row] for row in (*stored[3:], *bubbles)]
        return arb_mat(rows)

    return on_face


def recomputed(K, make_forms):
    """Forms near orthonormal, their energies in balls, and in 300 bits."""
    where = EnclosedTriangulation.of(mark(K)).flipped()
    forms = make_forms(where.complex, where.cochains)
    W = orthonormal_combination(dirichlet_matrix(forms), forms.cochains)
    forms = dataclasses.replace(
        forms, cochains=csr_array(csr_array(W) @ forms.cochains), traces=forms.traces @ W.T
    )
    surface = flipped_surface(K, mark(K).cochains, delaunay_flips(K)[1])
    divided = forms.complex is not where.complex
    balls = after_midpoints(where.complex, where.lengths) if divided else where.lengths
    energies = enclosed_energies(forms, balls[forms.complex.edge])

    def lengths(face):
        parent, factor = (face // 4, 2) if divided else (face, 1)
        return [surface.lengths[edge] / factor for edge in where.complex.edge[parent].tolist()]

    return energies, polynomial_energies(forms, exact_coefficients(forms), lengths)


@pytest.mark.parametrize("degree", [2, 3, 5])
@pytest.mark.parametrize("name", SURFACES)
def test_energies_contain_those_in_300_bits(name, degree):
    energies, exact = recomputed(SURFACES[name], lambda *K: high_order_forms(*K, degree))
    assert contains(energies, exact)
    if name in ORDINARY:
        assert energies.rad.max() < 1e-13


@pytest.mark.slow
@pytest.mark.parametrize("degree", [4, 6, 7, 8, 9, 10, 11, 12, 13, 14])
@pytest.mark.parametrize("name", SURFACES)
def test_energies_of_higher_degree_contain_those_in_300_bits(name, degree):
    energies, exact = recomputed(SURFACES[name], lambda *K: high_order_forms(*K, degree))
    assert contains(energies, exact)
    if name in ORDINARY:
        assert energies.rad.max() < 1e-13


@pytest.mark.parametrize("degree", [1, 2, 4])
def test_flat_elements_everywhere_are_enclosed_as_well(degree):
    def flat_forms(K, cochains):
        return least_energy_forms(K, cochains, (flat_elements(K, degree, np.arange(K.n_faces)),))

    energies, exact = recomputed(SURFACES["distorted L"], flat_forms)
    assert contains(energies, exact)


@pytest.mark.parametrize("factor", [0.5, 1.7])
def test_exponents_need_not_be_those_of_the_cones(factor):
    # Functions of t^κ agree across edges for any κ: larger energies, of forms in the same classes.
    def other_exponents(K, cochains):
        forms = high_order_forms(K, cochains, 3)
        elements = tuple(
            dataclasses.replace(part, kappa=part.kappa * factor)
            if part.reference is conical_element(3)
            else part
            for part in forms.elements
        )
        return least_energy_forms(forms.complex, forms.cochains, elements)

    energies, exact = recomputed(SURFACES["distorted L"], other_exponents)
    assert contains(energies, exact)


@pytest.mark.parametrize("seed", range(4))
def test_bad_solutions_stay_enclosed(seed):
    rng = np.random.default_rng(seed)

    def noisy(K, cochains):
        forms = high_order_forms(K, cochains, 4)
        noise = 10.0 ** rng.uniform(-10, 2) * rng.normal(size=forms.traces.shape)
        return dataclasses.replace(forms, traces=forms.traces + noise)

    energies, exact = recomputed(SURFACES["distorted L"], noisy)
    assert contains(energies, exact)


@pytest.mark.parametrize("element", [flat_element, conical_element])
@pytest.mark.parametrize("degree", [1, 2, 7, 14])
def test_tables_are_those_of_the_elements(degree, element):
    reference = element(degree)
    enclosed, quadrature = enclosed_reference(reference), reference.quadrature
    assert np.array_equal(
        np.sort(np.concatenate(enclosed.groups)), np.arange(reference.n_functions)
    )
    assert np.abs(enclosed.nodes.mid - quadrature.nodes).max() < 1e-15
    for tables, floats in ((enclosed.by_tau, quadrature.by_tau), (enclosed.by_s, quadrature.by_s)):
        for group, table in zip(enclosed.groups, tables, strict=True):
            assert np.allclose(table.mid, floats[:, group], rtol=0, atol=2e-13)
            size = np.linalg.norm(np.abs(table.mid), 2)
            assert size <= table.size < 1.05 * size + 1e-100
            assert table.error < 1e-14 * size + 1e-100


def test_lengths_that_are_not_known_leave_energies_unknown():
    K = SURFACES["distorted L"]
    cochains, _ = cochains_and_basis(K)
    forms = high_order_forms(K, cochains, 2)
    lengths = forms.complex.lengths
    with pytest.raises(ip.ComplexError, match="nothing can be proved about"):
        enclosed_energies(forms, Balls(lengths, 0.3 * lengths))


def test_elements_are_kept_as_they_are():
    # The proof reads the exponents of the elements, and nothing else of their shapes.
    K = SURFACES["L"]
    cochains, _ = cochains_and_basis(K)
    forms = high_order_forms(K, cochains, 3)
    spoilt = dataclasses.replace(
        forms,
        elements=tuple(
            Elements(e.reference, e.face, e.apex, np.nan * e.aspect, np.nan * e.foot, e.kappa)
            for e in forms.elements
        ),
    )
    lengths = Balls.exact(forms.complex.lengths)
    one, other = enclosed_energies(forms, lengths), enclosed_energies(spoilt, lengths)
    assert np.array_equal(one.mid, other.mid)
    assert np.array_equal(one.rad, other.rad)
