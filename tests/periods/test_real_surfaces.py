"""Doubles: known moduli inside the certificate, and the real structure."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.flat_surfaces import flat_strip, grid
from support.surfaces_with_holes import annulus_pair, square_with_holes, tau_inside_certificate

import igl_periods as ip
from igl_periods.complexes.doubling import double
from igl_periods.complexes.surface_checks import is_orientable
from igl_periods.elements.least_energy import dirichlet_matrix, high_order_forms
from igl_periods.moduli.equivalence import symplectic_isomorphisms
from igl_periods.periods.matrix import PeriodMatrix
from igl_periods.periods.real_surfaces import real_structure
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.cohomology import cochains_and_basis


@pytest.mark.parametrize("pieces", [(5, 3), (4, 7)])
def test_flat_cylinder(pieces):
    # Glued from two cylinders of circumference a and height b: 2b high, so τ = 2ib/a.
    K = flat_strip(1.7, 0.9, *pieces, glue_x="straight")
    pm = ip.period_matrix(double(K))
    assert pm.bound < 1e-11
    assert tau_inside_certificate(pm, 2j * 0.9 / 1.7)
    assert not tau_inside_certificate(pm, 2.001j * 0.9 / 1.7)


@pytest.mark.parametrize("pieces", [(5, 3), (6, 4)])
def test_flat_moebius_band(pieces):
    # The band is [0, w] × [0, h] with (0, y) ~ (w, h − y); its orientation cover is a cylinder of
    # circumference 2w, whose boundary points (x, 0) and (x + w, h) are the same in the double.
    K = flat_strip(1.3, 0.8, *pieces, glue_x="turned")
    assert not is_orientable(K)
    pm = ip.period_matrix(double(K))
    assert pm.bound < 1e-11
    assert tau_inside_certificate(pm, 0.5 + 0.8j / 2.6)
    assert not tau_inside_certificate(pm, 0.8j / 2.6)


def test_flat_klein_bottle():
    # The orientation cover of the a × b Klein bottle is the 2a × b torus.
    K = flat_strip(1.3, 0.9, 5, 4, glue_x="turned", glue_y="straight")
    assert K.n_boundary_edges == 0
    pm = ip.period_matrix(double(K))
    assert pm.bound < 1e-11
    assert tau_inside_certificate(pm, 0.9j / 2.6)


def annulus(r, n):
    """Concentric regular n-gons with the radii of a geometric progression from r to 1."""
    rows = n // 5
    radius = r ** (np.arange(rows + 1) / rows)
    angle = 2 * np.pi * (np.arange(n)[:, None] + 0.5 * np.arange(rows + 1)) / n
    V = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1).reshape(-1, 2)
    F = grid(n, rows)
    return V, F % len(V)


def test_round_annulus_converges_with_order_two():
    r = 0.3
    tau = 1j * np.log(1 / r) / np.pi
    errors = []
    for n in (20, 40, 80):
        pm = ip.period_matrix(double(ip.DeltaComplex.from_mesh(*annulus(r, n)))).reduced()
        # Im τ < 1, so that the reduced matrix is (−1/τ).
        errors.append(abs(pm.matrix[0, 0] + 1 / tau))
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 2e-3
    assert np.all(np.abs(rates - 2) < 0.15)


def high_order(K, degree):
    cochains, T = cochains_and_basis(K)
    D = dirichlet_matrix(high_order_forms(K, cochains, degree))
    return PeriodMatrix(T @ D @ T.T, True, csr_array(csr_array(T) @ cochains), K)


def test_square_with_two_holes_agrees_with_a_finer_mesh():
    holes = ((1, 2), (4, 3))
    coarse, fine = (ip.period_matrix(double(square_with_holes(n, holes))) for n in (2, 4))
    assert coarse.genus == fine.genus == 2
    # At the corners of the holes the angle of the double is 3π: P1 converges with h^(4/3).
    assert 1.2 < np.log2(coarse.bound / fine.bound) < 1.5
    assert fine.bound < 0.031
    # The two certificates are about the same surface, and say so; another pair of holes is
    # another surface, and they prove it.
    assert symplectic_isomorphisms(coarse, fine, limit=1)
    accurate = [high_order(double(square_with_holes(1, h)), 7) for h in (holes, ((1, 2), (4, 2)))]
    assert max(pm.bound for pm in accurate) < 2e-6
    assert symplectic_isomorphisms(fine, accurate[0], limit=1)
    different = symplectic_isomorphisms(*accurate)
    assert not different
    assert different.certified
    assert different.complete


def test_square_with_two_holes_in_the_same_marking():
    K = double(square_with_holes(1, ((1, 2), (4, 3))))
    coarse, accurate = ip.period_matrix(K), high_order(K, 7)
    excess = np.abs(accurate.matrix - coarse.matrix) - coarse.entry_bounds - accurate.entry_bounds
    assert np.all(excess < 0)


def moebius_with_hole():
    K = flat_strip(2.0, 1.0, 8, 5, glue_x="turned", seed=4)
    keep = np.ones(K.n_faces, dtype=bool)
    keep[[24, 25]] = False
    return ip.DeltaComplex.from_lengths(K.lengths[keep], K.corner_vertex[keep])


SURFACES = {
    "square with two holes": (annulus_pair, 3),
    "cylinder": (lambda: flat_strip(1.7, 0.9, 5, 3, "straight"), 2),
    "Moebius band": (lambda: flat_strip(1.3, 0.8, 5, 3, "turned"), 1),
    "Moebius band with a hole": (moebius_with_hole, 2),
    "Klein bottle": (lambda: flat_strip(1.3, 0.9, 5, 4, "turned", "straight"), 0),
}


@pytest.mark.parametrize("name", SURFACES)
def test_real_structure(name):
    surface, n_ovals = SURFACES[name]
    pm = ip.period_matrix(double(surface()))
    gamma, g = real_structure(pm), pm.genus
    J = standard_form(g)
    assert np.array_equal(gamma @ J @ gamma.T, -J)
    assert np.array_equal(gamma @ gamma, np.eye(2 * g))
    a, b, c, d = gamma[:g, :g], gamma[:g, g:], gamma[g:, :g], gamma[g:, g:]
    conjugate = pm.matrix.conj()
    moved = (a @ conjugate + b) @ np.linalg.inv(c @ conjugate + d)
    assert np.abs(moved - pm.matrix).max() < 1e-13
    # Gross, Harris (1981): in a suitable canonical basis the action of σ is
    # [[1, H], [0, −1]] with H of rank g + 1 − (number of ovals) mod 2, if there are ovals.
    if n_ovals:
        assert rank_mod_2(gamma + np.eye(2 * g, dtype=int)) == g + 1 - n_ovals


def rank_mod_2(matrix):
    rows = [int("".join(map(str, row)), 2) for row in matrix % 2]
    rank = 0
    while rows:
        pivot = rows.pop()
        if pivot:
            rank += 1
            low = pivot & -pivot
            rows = [row ^ pivot if row & low else row for row in rows]
    return rank


def test_real_structure_in_another_marking():
    pm = ip.period_matrix(double(annulus_pair())).reduced()
    gamma, g = real_structure(pm), pm.genus
    a, b, c, d = gamma[:g, :g], gamma[:g, g:], gamma[g:, :g], gamma[g:, g:]
    moved = (a @ pm.matrix.conj() + b) @ np.linalg.inv(c @ pm.matrix.conj() + d)
    assert np.abs(moved - pm.matrix).max() < 1e-13
    # It is found among all orientation-reversing automorphisms, too.
    found = symplectic_isomorphisms(pm, pm, reversing=True)
    assert any(np.array_equal(gamma, other) for other in found)


def test_moebius_band_and_torus_with_a_hole_made_by_others(mesh):
    for name, genus in (("moebius.obj", 1), ("punctured-torus.obj", 2)):
        pm = ip.period_matrix(double(ip.DeltaComplex.from_mesh(*mesh(name))))
        assert pm.genus == genus
        gamma, J = real_structure(pm), standard_form(genus)
        assert np.array_equal(gamma @ J @ gamma.T, -J)
