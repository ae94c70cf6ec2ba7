"""Integer homology: closed cochains, unimodular pairing, dual cycles.  All exact."""

import numpy as np
import pytest
from random_surfaces import BOLZA, HEXAGON, L_SHAPE, noisy_torus, random_gluing, random_lengths
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.complexes.cochains import walk_cochain
from igl_periods.symplectic.canonical_basis import (
    integer_symplectic_basis,
    is_symplectic,
    standard_form,
)
from igl_periods.topology.cohomology import cochains_and_basis, cotree_cochains, pairing
from igl_periods.topology.spanning_trees import tree_cotree


def _surfaces():
    for gluing in (L_SHAPE, BOLZA, HEXAGON):
        for n in (1, 2, 3):
            yield ip.DeltaComplex.from_squares(gluing, n)
    yield ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0))
    rng = np.random.default_rng(1)
    for n_faces in (2, 4, 6, 8, 10, 20, 60, 200):
        twin = random_gluing(n_faces, rng)
        yield from ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()


SURFACES = list(_surfaces())


def boundary_values(K, cochain):
    """Sum of a cochain around every face."""
    return (K.sign * cochain[K.edge]).sum(axis=1)


@pytest.mark.parametrize("K", SURFACES)
def test_canonical_basis_and_its_dual_cycles(K):
    g = K.genus
    basis = ip.cohomology_basis(K)
    assert basis.shape == (2 * g, K.n_edges)
    assert np.issubdtype(basis.dtype, np.integer)
    cochains = basis.toarray()
    for cochain in cochains:
        assert not boundary_values(K, cochain).any()
    assert np.array_equal(pairing(K, basis, basis), standard_form(g))
    cycles = ip.homology_basis(K)
    values = np.array(
        [[cochain @ walk_cochain(K, walk) for walk in cycles] for cochain in cochains]
    )
    assert np.array_equal(values.reshape(2 * g, 2 * g), np.eye(2 * g))


@pytest.mark.parametrize("K", SURFACES)
def test_cycles_are_closed_walks_without_passages_to_and_fro(K):
    start, end = np.roll(K.corner_vertex, -1, 1).ravel(), np.roll(K.corner_vertex, 1, 1).ravel()
    for walk in ip.homology_basis(K):
        assert walk.size
        assert np.array_equal(end[walk], start[np.roll(walk, -1)])
        assert not np.any(K.twin.ravel()[walk] == np.roll(walk, -1)) or walk.size == 1


@pytest.mark.parametrize("K", SURFACES)
def test_tree_and_cotree_span_and_do_not_cross(K):
    trees = tree_cotree(K, root=K.n_vertices - 1)
    edge = K.edge.ravel()
    in_tree = edge[trees.vertex_parent[trees.vertex_parent >= 0]]
    in_cotree = edge[trees.face_parent[trees.face_parent >= 0]]
    both = np.concatenate([in_tree, in_cotree, edge[trees.generators]])
    assert (in_tree.size, in_cotree.size) == (K.n_vertices - 1, K.n_faces - 1)
    assert np.array_equal(np.sort(both), np.arange(K.n_edges))


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
    with pytest.raises(ValueError, match=f"root = {root} is no vertex"):
        ip.cohomology_basis(ip.DeltaComplex.from_squares(BOLZA, 2), root=root)


def test_sphere_has_no_homology():
    tetrahedron = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    K = ip.DeltaComplex.from_lengths(np.ones((4, 3)), tetrahedron)
    assert K.genus == 0
    assert ip.cohomology_basis(K).shape == (0, 6)
    assert ip.homology_basis(K) == []


def test_every_basis_function_refuses_what_is_no_closed_surface():
    K = ip.DeltaComplex.from_lengths(np.ones((1, 3)), [[0, 1, 2]])
    for function in (ip.cohomology_basis, ip.homology_basis):
        with pytest.raises(ip.ComplexError, match="not closed"):
            function(K)


def test_symplectic_basis_refuses_other_matrices():
    with pytest.raises(ValueError, match="degenerate"):
        integer_symplectic_basis(np.zeros((2, 2), dtype=int))
    with pytest.raises(ValueError, match="pivot 3"):
        integer_symplectic_basis(np.array([[0, 3], [-3, 0]]))


def test_high_genus_is_exact_and_sparse():
    rng = np.random.default_rng(7)
    twin = random_gluing(300, rng)
    K = max(
        ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components(),
        key=lambda part: part.n_faces,
    )
    assert K.genus > 60
    cochains = cotree_cochains(K, tree_cotree(K))
    M = pairing(K, cochains, cochains)
    assert is_symplectic(integer_symplectic_basis(M), M)
