"""Integer symplectic bases, and the action of the group on them."""

import numpy as np
import pytest
from support.random_surfaces import (
    random_gluing,
    random_lengths,
)

import igl_periods as ip
from igl_periods.symplectic.canonical_basis import (
    form_action,
    integer_symplectic_basis,
    is_symplectic,
    standard_form,
)
from igl_periods.symplectic.williamson_form import energy_matrix
from igl_periods.topology.cohomology import cotree_cochains, pairing
from igl_periods.topology.spanning_trees import tree_cotree


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


def test_symplectic_matrices_of_any_size():
    # Sums that do not fit into 64 bits, right and wrong by a little.
    k = 2**40
    shear = np.array([[1, k], [0, 1]])
    big = np.array([[1 + k * k // 2**20, k // 2**20], [k, 1]])
    assert is_symplectic(shear)
    assert is_symplectic(big)
    assert not is_symplectic(big + np.array([[0, 0], [0, 1]]))
    assert is_symplectic(shear, standard_form(1))
    huge = np.array([[2**62, 2**62 - 1], [1, 1]])
    assert is_symplectic(huge)
    assert not is_symplectic(huge + np.array([[0, 0], [1, 0]]))


def random_period_matrix(g, rng):
    A, B = rng.normal(size=(2, g, g))
    return A + A.T + 1j * (B @ B.T + 0.3 * np.eye(g))


@pytest.mark.parametrize("g", [1, 2, 4])
def test_energies_and_period_matrices_transform_together(g):
    rng = np.random.default_rng(g)
    Pi = random_period_matrix(g, rng)
    S = rng.integers(-2, 3, (g, g))
    shift = np.block([[np.eye(g), S + S.T], [np.zeros((g, g)), np.eye(g)]]).astype(int)
    for gamma in (shift, standard_form(g), shift @ standard_form(g) @ shift):
        U = form_action(gamma)
        assert is_symplectic(U)
        moved = ip.siegel_transform(gamma, Pi)
        expected = U @ energy_matrix(Pi) @ U.T
        np.testing.assert_allclose(
            energy_matrix(moved), expected, atol=1e-9 * np.abs(expected).max()
        )


@pytest.mark.parametrize("entry", [1, 2**40, 2**62 + 1])
def test_shears_with_large_entries(entry):
    shear = np.eye(4, dtype=np.int64)
    shear[0, 3] = shear[1, 2] = entry
    assert is_symplectic(shear)
    shear[1, 2] = entry - 1
    assert not is_symplectic(shear)
