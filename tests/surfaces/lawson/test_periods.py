"""Exact period matrices of Lawson's surfaces, by second routes."""

import numpy as np
import pytest
from support.brute_force_equivalence import isomorphisms
from support.lazy_equivalence import in_basis_of
from support.quadrature_periods import period_matrix as by_quadrature

import igl_periods as ip
from igl_periods.surfaces import (
    lawson_period_matrix,
    lawson_period_matrix_in,
    lawson_surface,
    square_tiled_period_matrix,
)
from igl_periods.topology.cohomology import pairing

ORDERS = [(1, 1), (2, 1), (1, 2), (3, 1), (2, 2), (3, 2), (3, 3), (4, 3)]


def unity(n):
    return np.exp(2j * np.pi * np.arange(n) / n)


# --- exact period matrices
@pytest.mark.parametrize(("m", "k"), [*ORDERS, (6, 1), (1, 5)])
def test_exact_matrices_are_siegel_points(m, k):
    Pi = lawson_period_matrix(m, k)
    assert Pi.shape == (m * k, m * k)
    assert np.abs(Pi - Pi.T).max() < 1e-13
    assert np.linalg.eigvalsh(Pi.imag).min() > 0.01


def test_clifford_torus_is_square():
    assert np.abs(lawson_period_matrix(1, 1) - 1j).max() < 1e-14


def test_genus_two_surface_is_the_third_square_tiled_one():
    exact = square_tiled_period_matrix("omega_3")
    assert len(isomorphisms(lawson_period_matrix(2, 1), exact, 1e-12, size=4)) == 24


@pytest.mark.parametrize(
    ("m", "k", "size"), [(2, 1, 2), (3, 1, 1), (4, 1, 1), (2, 2, 1), (1, 3, 1)]
)
def test_exact_matrices_are_the_periods_of_the_curves(m, k, size):
    # yⁿ = (x^M − 1)/(x^M + 1), M = m + 1, n = k + 1.
    M, n = m + 1, k + 1
    points = np.concatenate([unity(M), unity(M) * np.exp(1j * np.pi / M)])
    curve = by_quadrature(n, points, [1] * M + [n - 1] * M)
    exact = lawson_period_matrix(m, k)
    assert np.abs(in_basis_of(exact, curve, 1e-9, size) - exact).max() < 1e-12


def test_exact_matrix_follows_the_marking():
    # Another root of the tree gives another basis; both are the same point of moduli space.
    V, F = lawson_surface(3, 2, 2)
    K = ip.DeltaComplex.from_mesh(V, F)
    Pi = [
        lawson_period_matrix_in(K, ip.cohomology_basis(K, root), 3, 2, segments=4)
        for root in (0, 100)
    ]
    assert np.abs(Pi[0] - Pi[1]).max() > 0.1
    alpha, beta = (ip.cohomology_basis(K, root) for root in (0, 100))
    U = pairing(K, beta, alpha) @ np.kron([[0, -1], [1, 0]], np.eye(6, dtype=int))
    assert np.array_equal((U @ alpha.toarray()).shape, beta.shape)
    assert np.abs(change(U, Pi[0]) - Pi[1]).max() < 1e-11


def change(U, Pi):
    """The period matrix for the forms U (α, β), by the Möbius action of K U K."""
    g = len(Pi)
    K = np.diag([1] * g + [-1] * g)
    gamma = K @ U @ K
    a, b, c, d = gamma[:g, :g], gamma[:g, g:], gamma[g:, :g], gamma[g:, g:]
    return (a @ Pi + b) @ np.linalg.inv(c @ Pi + d)


def test_meshes_without_the_sides_are_refused():
    V, F = lawson_surface(2, 1, 4)
    pm = ip.period_matrix(V, F)
    with pytest.raises(ip.ComplexError, match="has 190 vertices, and its sides would need"):
        lawson_period_matrix_in(pm.complex, pm.cocycles, 2, 1, segments=20)
    with pytest.raises(ip.ComplexError, match="no edges along the sides"):
        lawson_period_matrix_in(pm.complex, pm.cocycles, 2, 1, segments=3)
