"""Integer cohomology: closed cochains and their unimodular pairing.  All exact."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.homology_surfaces import SURFACES
from support.random_surfaces import (
    BOLZA,
    L_SHAPE,
    noisy_torus,
)

import igl_periods as ip
from igl_periods.symplectic.canonical_basis import (
    is_symplectic,
    standard_form,
)
from igl_periods.topology.cohomology import cochains_and_basis, pairing


@pytest.mark.parametrize("K", SURFACES)
def test_entries_never_grow(K):
    # The theorem on interlace matrices: cochains, pairing and basis change have entries 0, ±1.
    cochains, T = cochains_and_basis(K)
    M = pairing(K, cochains, cochains)
    for entries in (cochains.data, M, T):
        assert np.isin(entries, (-1, 0, 1)).all()
    assert is_symplectic(T, M)
    if K.genus:
        assert round(np.linalg.det(M)) == 1


def test_pairing_of_a_flat_torus_is_its_area_form():
    # On the unit square α = dx, β = dy: ∫ dx∧dy = 1.
    K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))])
    dx, dy = np.zeros((2, K.n_edges), dtype=np.int64)
    for f, s, along_x, along_y in [(0, 2, 1, 0), (0, 0, 0, 1), (0, 1, -1, -1)]:
        dx[K.edge[f, s]], dy[K.edge[f, s]] = K.sign[f, s] * np.array([along_x, along_y])
    forms = csr_array(np.stack([dx, dy]))
    assert np.array_equal(pairing(K, forms, forms), [[0, 1], [-1, 0]])


def test_pairing_depends_on_classes_only():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 3)
    rng = np.random.default_rng(0)
    basis = ip.cohomology_basis(K)
    start, end = np.roll(K.corner_vertex, -1, 1).ravel(), np.roll(K.corner_vertex, 1, 1).ravel()
    f = rng.integers(-9, 10, (4, K.n_vertices))
    exact = np.zeros((4, K.n_edges), dtype=np.int64)
    forward = np.flatnonzero(K.sign.ravel() > 0)
    exact[:, K.edge.ravel()[forward]] = f[:, end[forward]] - f[:, start[forward]]
    moved = csr_array(basis.toarray() + exact)
    assert np.array_equal(pairing(K, moved, basis), standard_form(2))


def test_pairing_of_cochains_that_are_not_closed_is_refused():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 2)
    rng = np.random.default_rng(0)
    open_cochains = csr_array(rng.integers(-3, 4, (6, K.n_edges)))
    with pytest.raises(ip.ComplexError, match="not closed"):
        pairing(K, open_cochains, open_cochains)


def test_the_same_complex_always_gets_the_same_basis():
    V, F = noisy_torus(8, 6, 0.1, 5)
    one = ip.cohomology_basis(ip.DeltaComplex.from_mesh(V, F)).toarray()
    two = ip.cohomology_basis(ip.DeltaComplex.from_mesh(3.0 * V, F)).toarray()
    assert np.array_equal(one, two)


def test_another_root_gives_another_basis_of_the_same_lattice():
    K = ip.DeltaComplex.from_squares(BOLZA, 4)
    one, other = ip.cohomology_basis(K), ip.cohomology_basis(K, root=K.n_vertices // 2)
    change = pairing(K, one, other)
    assert round(abs(np.linalg.det(change))) == 1
    assert np.array_equal(pairing(K, other, other), standard_form(2))


@pytest.mark.parametrize("root", [-1, 10**6])
def test_roots_that_are_no_vertices(root):
    with pytest.raises(ValueError, match=f"root = {root} is not a vertex"):
        ip.cohomology_basis(ip.DeltaComplex.from_squares(BOLZA, 2), root=root)


def test_every_basis_function_refuses_what_is_no_closed_surface():
    K = ip.DeltaComplex.from_lengths(np.ones((1, 3)), [[0, 1, 2]])
    for function in (ip.cohomology_basis, ip.homology_basis):
        with pytest.raises(ip.ComplexError, match="not closed"):
            function(K)
