"""Pairwise reduction: exactly symplectic, never longer, and no elementary move left to make."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.modular_words import random_point, random_word

from igl_periods.siegel.half_space import siegel_transform
from igl_periods.siegel.reducing_pairs import pairwise_reduction
from igl_periods.symplectic.canonical_basis import form_action, standard_form
from igl_periods.symplectic.williamson_form import energy_matrix


def scrambled_energies(g, seed, length):
    rng = np.random.default_rng(seed)
    return energy_matrix(siegel_transform(random_word(g, length, rng, 300), random_point(g, rng)))


def elementary_moves(g, k):
    """All moves v_i += k v_j, completed to symplectic ones through their Lie algebra."""
    J = standard_form(g)
    for i, j in itertools.permutations(range(2 * g), 2):
        N = np.zeros((2 * g, 2 * g), dtype=np.int64)
        N[i, j] = k
        # 1 + N + N' with (N + N') J = ((N + N') J)ᵀ, the symmetric part of N J taken twice.
        H = N @ J
        H = H if np.array_equal(H, H.T) else H + H.T
        yield np.eye(2 * g, dtype=np.int64) - H @ J


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 4), st.integers(0, 2**32 - 1), st.integers(0, 40))
def test_no_elementary_move_shortens_the_result(g, seed, length):
    D, J = scrambled_energies(g, seed, length), standard_form(g)
    U = pairwise_reduction(D)
    assert U.dtype == np.int64
    assert np.array_equal(U @ J @ U.T, J)
    reduced = U @ D @ U.T
    least = np.trace(reduced)
    assert least <= np.trace(D)
    for k in (-2, -1, 1, 2):
        for E in elementary_moves(g, k):
            assert np.array_equal(E @ J @ E.T, J)
            assert np.trace(E @ reduced @ E.T) > least * (1 - 1e-6)


@pytest.mark.parametrize(("g", "length"), [(20, 100), (70, 300)])
def test_high_genus(g, length):
    D, J = scrambled_energies(g, g, length), standard_form(g)
    U = pairwise_reduction(D)
    assert np.array_equal(U @ J @ U.T, J)
    reduced = U @ D @ U.T
    assert np.trace(reduced) < 0.5 * np.trace(D)
    # |N| ≤ S/2 for all pairs; conjugation with J takes D_ij to σ_i σ_j D_{i*j*}.
    conjugate = J @ reduced @ J.T
    N = reduced - conjugate
    S = np.diag(reduced)[None, :] + np.diag(conjugate)[:, None]
    off = ~np.eye(2 * g, dtype=bool)
    assert np.all(np.abs(N[off]) <= 0.5 * S[off] * (1 + 1e-6))


def test_a_known_basis_is_found_again():
    # One long transvection of the square torus times another torus: the least trace is known.
    D = energy_matrix(np.diag([1j, 1j]))
    U = form_action(np.array([[1, 7, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, -7, 1]]))
    longer = U @ D @ U.T
    assert np.trace(longer) == 102
    back = pairwise_reduction(longer)
    np.testing.assert_array_equal(back @ longer @ back.T, D)


def test_reduced_bases_are_left_alone():
    D = scrambled_energies(25, 3, 200)
    U = pairwise_reduction(D)
    again = pairwise_reduction(U @ D @ U.T)
    assert np.array_equal(again, np.eye(50, dtype=np.int64))


def test_large_multiples_are_taken_in_parts():
    D = np.array([[1.0 + 4e12, 2e6], [2e6, 1.0]])
    before = D.copy()
    U = pairwise_reduction(D)
    assert U.tolist() == [[1, -(2 * 10**6)], [0, 1]]
    assert np.array_equal(D, before)


def test_energies_beyond_double_precision_end_it():
    # Of this D nothing but rounding would be left.
    D = np.array([[1.0 + 4e18, 2e9], [2e9, 1.0]])
    U = pairwise_reduction(D)
    assert np.array_equal(U @ standard_form(1) @ U.T, standard_form(1))


def test_empty():
    assert pairwise_reduction(np.zeros((0, 0))).shape == (0, 0)
