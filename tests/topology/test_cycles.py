"""Cycles dual to the cohomology basis, as closed walks."""

import numpy as np
import pytest
from support.homology_surfaces import SURFACES

import igl_periods as ip
from igl_periods.complexes.cochains import walk_cochain
from igl_periods.symplectic.canonical_basis import (
    standard_form,
)
from igl_periods.topology.cohomology import pairing


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


def test_sphere_has_no_homology():
    tetrahedron = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    K = ip.DeltaComplex.from_lengths(np.ones((4, 3)), tetrahedron)
    assert K.genus == 0
    assert ip.cohomology_basis(K).shape == (0, 6)
    assert ip.homology_basis(K) == []
