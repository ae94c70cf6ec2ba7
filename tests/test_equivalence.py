"""Equivalence under Sp(2g, Z), automorphism groups, distance in moduli space."""

import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matching import isomorphisms
from modular_words import random_point, random_word
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.complexes.midpoint_subdivision import split
from igl_periods.errors import EnumerationLimitError, NotASiegelPointError
from igl_periods.moduli import lattice_isometries as isometries
from igl_periods.moduli.automorphisms import symplectic_automorphism_group
from igl_periods.moduli.equivalence import moduli_distance, symplectic_isomorphisms
from igl_periods.siegel.half_space import siegel_distance, siegel_transform
from igl_periods.surfaces import (
    cyclic_cover,
    flat_torus,
    lawson_period_matrix,
    regular_map_period_matrix,
    regular_map_surface,
    square_tiled_period_matrix,
    square_tiled_surface,
)
from igl_periods.surfaces.named_surfaces import binomial_period_matrix
from igl_periods.symplectic.canonical_basis import standard_form

cases = st.tuples(st.integers(1, 6), st.integers(0, 2**32 - 1), st.integers(0, 30))

# |Aut X| of the surface and whether Π decides that it is hyperelliptic.
SYMMETRIC = {
    "Omega_1": (square_tiled_period_matrix("omega_1"), 8, (8,)),
    "Bolza": (square_tiled_period_matrix("omega_2"), 48, (48,)),
    "Omega_3": (square_tiled_period_matrix("omega_3"), 24, (24,)),
    "y^2 = x^5 - 1": (binomial_period_matrix(5), 10, (10,)),
    "Klein": (regular_map_period_matrix("klein"), 336, (168,)),
    "Fermat": (regular_map_period_matrix("fermat"), 192, (96,)),
    "Schwarz P": (regular_map_period_matrix("schwarz_p"), 48, (48,)),
    "Lawson 3,1": (lawson_period_matrix(3, 1), 32, (32,)),
    "Lawson 4,1": (lawson_period_matrix(4, 1), 40, (20, 40)),
    "Bring": (regular_map_period_matrix("bring"), 240, (120, 240)),
}


def keys(matrices) -> set:
    return {gamma.tobytes() for gamma in matrices}


def reflected(gamma: np.ndarray, Pi: np.ndarray) -> np.ndarray:
    """(aΠ̄ + b)(cΠ̄ + d)⁻¹."""
    (a, b), (c, d) = (np.hsplit(half, 2) for half in np.vsplit(gamma, 2))
    return (a @ Pi.conj() + b) @ np.linalg.inv(c @ Pi.conj() + d)


# --- automorphism groups -----------------------------------------------------------------------


@pytest.mark.parametrize("name", SYMMETRIC)
def test_automorphism_groups_of_named_surfaces(name):
    Pi, order, surface_orders = SYMMETRIC[name]
    g = len(Pi)
    group = symplectic_automorphism_group(Pi)
    assert group.order == len(group) == order
    assert group.surface_orders == surface_orders
    J = standard_form(g)
    assert all(np.array_equal(gamma @ J @ gamma.T, J) for gamma in group)
    assert max(siegel_distance(siegel_transform(gamma, Pi), Pi) for gamma in group) < 1e-10
    # A group: the identity comes first, −1 is there, and it is closed; its generators generate it.
    assert np.array_equal(group[0], np.eye(2 * g, dtype=np.int64))
    members = keys(group)
    assert (-group[0]).tobytes() in members
    assert keys(gamma @ generator for gamma in group for generator in group.generators) == members
    assert len(group.generators) <= 4
    reached = [group[0]]
    for gamma in reached:
        for generator in group.generators:
            if (gamma @ generator).tobytes() not in keys(reached):
                reached.append(gamma @ generator)
    assert keys(reached) == members


@pytest.mark.parametrize("name", SYMMETRIC)
def test_reversing_symmetries_are_the_other_coset(name):
    Pi, order, _ = SYMMETRIC[name]
    group = symplectic_automorphism_group(Pi)
    assert len(group.reversing) == order  # all these surfaces have real structures
    J = standard_form(len(Pi))
    assert all(np.array_equal(sigma @ J @ sigma.T, -J) for sigma in group.reversing)
    assert max(siegel_distance(reflected(s, Pi), Pi) for s in group.reversing) < 1e-10
    assert keys(group.reversing[0] @ gamma for gamma in group) == keys(group.reversing)
    structures = group.real_structures
    assert structures
    assert all(np.array_equal(s @ s, np.eye(2 * len(Pi), dtype=np.int64)) for s in structures)
    assert keys(structures) == keys(-sigma for sigma in structures)


def test_real_structures_of_klein_and_bring():
    # Those of Klein's quartic are the 28 outer involutions of PGL(2, 7); those of Bring's curve
    # conjugation after one of the 1 + 10 + 15 permutations of order at most 2 of 5 coordinates.
    assert len(symplectic_automorphism_group(SYMMETRIC["Klein"][0]).real_structures) == 2 * 28
    assert len(symplectic_automorphism_group(SYMMETRIC["Bring"][0]).real_structures) == 2 * 26


@pytest.mark.parametrize(
    ("tau", "order", "n_reversing"),
    [
        (1j, 4, 4),
        (np.exp(1j * np.pi / 3), 6, 6),
        (2j, 2, 2),
        (np.exp(1.3j), 2, 2),
        (0.2 + 1.3j, 2, 0),
    ],
)
def test_symmetries_of_tori(tau, order, n_reversing):
    group = symplectic_automorphism_group([[tau]])
    assert group.order == order
    assert len(group.reversing) == n_reversing
    assert group.surface_orders == (order,)


@pytest.mark.parametrize("g", [2, 3, 5, 8])
def test_generic_surfaces_have_no_symmetry(g):
    Pi = random_point(g, np.random.default_rng(g))
    group = symplectic_automorphism_group(Pi)
    assert keys(group) == keys([np.eye(2 * g, dtype=np.int64), -np.eye(2 * g, dtype=np.int64)])
    assert len(group.reversing) == 0
    assert group.real_structures == []


def test_the_search_agrees_with_brute_force():
    for name in ("Omega_1", "Bolza", "Omega_3", "y^2 = x^5 - 1"):
        Pi = SYMMETRIC[name][0]
        found = symplectic_isomorphisms(Pi, Pi)
        assert max(np.abs(gamma).max() for gamma in found) <= 2
        assert keys(found) == keys(isomorphisms(Pi, Pi, 1e-8))


def test_near_symmetries_need_not_form_a_group():
    # Two rotations of nearly square and nearly hexagonal lattices do not compose.
    Pi = [[0.25 + 0.97j]]
    group = symplectic_automorphism_group(Pi, tolerance=0.6)
    assert group.order > 2
    with pytest.raises(ValueError, match="do not form a group"):
        _ = group.generators


# --- isomorphisms ------------------------------------------------------------------------------


@settings(max_examples=60, deadline=None)
@given(cases)
def test_random_words_are_found(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi1, word = random_point(g, rng), random_word(g, length, rng, 20)
    Pi2 = siegel_transform(word, Pi1)
    found = symplectic_isomorphisms(Pi1, Pi2)
    assert {word.tobytes(), (-word).tobytes()} <= keys(found)
    assert max(siegel_distance(siegel_transform(gamma, Pi1), Pi2) for gamma in found) < 1e-8
    # Beyond the tolerance there is nothing.
    D = rng.standard_normal((g, g))
    moved = Pi2 + 1e-3 * (D + D.T) * np.sqrt(np.outer(np.diag(Pi2.imag), np.diag(Pi2.imag)))
    assert symplectic_isomorphisms(Pi1, moved, 1e-6) == []


@settings(max_examples=30, deadline=None)
@given(cases)
def test_orientation_reversal_is_found(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi1 = random_point(g, rng)
    Pi2 = -siegel_transform(random_word(g, length, rng, 20), Pi1).conj()
    found = symplectic_isomorphisms(Pi1, Pi2, reversing=True)
    assert len(found) >= 2
    J = standard_form(g)
    for gamma in found:
        assert np.array_equal(gamma @ J @ gamma.T, -J)
        assert siegel_distance(reflected(gamma, Pi1), Pi2) < 1e-8
    if g > 1:  # a generic torus may be nearly real by chance
        assert symplectic_isomorphisms(Pi1, Pi2) == []


@pytest.mark.parametrize("name", ["Bolza", "Fermat", "Lawson 4,1"])
def test_isomorphisms_are_a_coset_of_the_automorphisms(name):
    Pi, order, _ = SYMMETRIC[name]
    word = random_word(len(Pi), 25, np.random.default_rng(3), 12)
    found = symplectic_isomorphisms(Pi, siegel_transform(word, Pi))
    assert len(found) == order
    assert keys(found) == keys(word @ gamma for gamma in symplectic_isomorphisms(Pi, Pi))


def test_tolerance_bounds_the_eigenvalues():
    # [[τ]] and [[τ e^s]] have λ = e^s: found from t = s on.
    s = 0.02
    for t, n in ((0.0199, 0), (0.0201, 2)):
        assert len(symplectic_isomorphisms([[2j]], [[2j * math.exp(s)]], t)) == n


def test_limit():
    Pi = SYMMETRIC["Bolza"][0]
    first = symplectic_isomorphisms(Pi, Pi, limit=5)
    assert len(first) == 5
    assert not first.complete
    assert first.verdict == "5 transformations within 2e-08, and there may be more"
    everything = symplectic_isomorphisms(Pi, Pi, limit=48)
    assert everything.complete
    assert everything.verdict == "48 transformations within 2e-08"


def test_results_pickle():
    found = symplectic_isomorphisms([[1j]], [[1j]])
    copy = pickle.loads(pickle.dumps(found))
    assert keys(copy) == keys(found)
    assert (copy.tolerance, copy.certified, copy.complete) == (found.tolerance, False, True)
    assert type(copy) is type(found)


def test_genus_zero():
    empty = np.zeros((0, 0))
    assert len(symplectic_isomorphisms(empty, empty)) == 1
    sphere = ip.period_matrix(
        ip.DeltaComplex.from_lengths(np.ones((4, 3)), [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    )
    assert symplectic_automorphism_group(sphere).order == 1


def test_high_genus_is_given_up():
    rng = np.random.default_rng(28)
    Pi = random_point(28, rng)
    found = symplectic_isomorphisms(Pi, Pi)
    assert found == []
    assert not found.complete
    assert found.verdict.startswith("undecided: the search was given up (more than 500000 partial")
    with pytest.raises(EnumerationLimitError, match="more than 500000 partial vectors"):
        moduli_distance(Pi, Pi, 1e-6)
    with pytest.raises(EnumerationLimitError, match="more than 500000 partial vectors"):
        symplectic_automorphism_group(Pi)


def test_backtracking_is_given_up(monkeypatch):
    monkeypatch.setattr(isometries, "SEARCH_LIMIT", 10)
    Pi = SYMMETRIC["Bolza"][0]
    found = symplectic_isomorphisms(Pi, Pi)
    assert found.verdict == "undecided: the search was given up (more than 10 images tried)"


# --- certificates ------------------------------------------------------------------------------


def test_different_polyhedral_surfaces_are_proved_different():
    one = ip.period_matrix(square_tiled_surface("omega_2", 4))
    two = ip.period_matrix(square_tiled_surface("omega_3", 4))
    found = symplectic_isomorphisms(one, two)
    assert found == []
    assert found.certified and found.complete
    assert found.tolerance >= math.log1p(one.bound) + math.log1p(two.bound)
    assert found.verdict == "proved: the two polyhedral surfaces are not conformally equivalent"
    bare = symplectic_isomorphisms(one.matrix, two.matrix)
    assert bare.verdict == "no transformation within 2e-08"


@pytest.mark.parametrize("seed", [1, 2])
def test_subdivisions_of_an_asymmetric_surface_are_never_proved_different(seed):
    # The same polyhedral surface with other triangles: a theorem to the contrary would be wrong.
    rng = np.random.default_rng(seed)
    K = cyclic_cover(2, rng.normal(size=6) + 1j * rng.normal(size=6), size=0.3)
    finer, _ = split(K, csr_array((0, K.n_edges)))
    one, two = ip.period_matrix(K), ip.period_matrix(finer)
    found = symplectic_isomorphisms(one, two)
    assert found.certified
    assert len(found) >= 2
    # And the matrices do differ.
    assert 1e-4 < moduli_distance(one, two, found.tolerance) < math.sqrt(2) * found.tolerance
    assert symplectic_isomorphisms(one.matrix, two.matrix, 1e-4) == []


def test_the_two_subdivisions_of_brings_curve():
    one, two = (ip.period_matrix(regular_map_surface("bring", n)) for n in (1, 2))
    found = symplectic_isomorphisms(one, two)
    assert found.certified
    assert len(found) >= 240
    assert 1e-3 < moduli_distance(one, two, found.tolerance) < math.sqrt(4) * found.tolerance


def test_certified_group_contains_the_symmetries():
    group = symplectic_automorphism_group(ip.period_matrix(square_tiled_surface("omega_3", 4)))
    assert group.elements.certified
    assert group.order == 24


# --- distance in moduli space ------------------------------------------------------------------


@settings(max_examples=30, deadline=None)
@given(cases)
def test_distance_of_nearby_surfaces(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi1 = random_point(g, rng)
    D = rng.standard_normal((g, g))
    Pi2 = Pi1 + 1e-4 * (D + D.T)
    moved = siegel_transform(random_word(g, length, rng, 15), Pi2)
    distance = siegel_distance(Pi1, Pi2)
    assert abs(moduli_distance(Pi1, moved, 0.1) - distance) < 1e-7
    assert abs(moduli_distance(moved, Pi1, 0.1) - distance) < 1e-7


def test_distance_is_the_least():
    # τ and its images: the nearest one counts.
    assert abs(moduli_distance([[3j]], [[1j / 3.03]], 0.1) - math.log(1.01)) < 1e-12
    assert moduli_distance([[3j]], [[4j]], 0.1) == math.inf


# --- refusals ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("tolerance", "message"),
    [
        (0.7, "0.7 is too large to separate anything"),
        (math.inf, "inf is too large to separate anything"),
        (0.0, "positive number, not 0.0"),
        (-1.0, "positive number, not -1.0"),
        (math.nan, "positive number, not nan"),
    ],
)
def test_tolerances_that_make_no_sense(tolerance, message):
    for function in (
        lambda: symplectic_isomorphisms([[1j]], [[1j]], tolerance),
        lambda: symplectic_automorphism_group([[1j]], tolerance),
        lambda: moduli_distance([[1j]], [[1j]], tolerance),
    ):
        with pytest.raises(ValueError, match=message):
            function()


def test_certificates_that_are_too_weak():
    coarse = ip.period_matrix(square_tiled_surface("omega_1", 1))
    assert coarse.bound > 1
    with pytest.raises(ValueError, match="refine the mesh or raise the degree"):
        symplectic_isomorphisms(coarse, coarse)


def test_period_matrix_without_certificate():
    K = flat_torus(0.3 + 1.1j)
    abstract = ip.period_matrix_from_weights(np.ones((K.n_faces, 3)), K.twin)
    assert abstract.bound is None
    with pytest.raises(ValueError, match="without a certificate: state a tolerance"):
        symplectic_isomorphisms(abstract, abstract)
    assert len(symplectic_isomorphisms(abstract, abstract, 1e-6)) >= 2
    assert symplectic_automorphism_group(abstract, 1e-6).order >= 2


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        ([[1j, 0.5], [0.4, 1j]], "not symmetric"),
        ([[1j, 2j], [2j, 1j]], "not positive definite"),
        ([[1j, math.nan], [math.nan, 1j]], "not finite"),
        ([[1j, 0]], "square"),
    ],
)
def test_matrices_that_are_no_siegel_points(matrix, message):
    good = np.diag([1j, 1j])
    for arguments in ((matrix, good), (good, matrix)):
        with pytest.raises(NotASiegelPointError, match=message):
            symplectic_isomorphisms(*arguments)
        with pytest.raises(NotASiegelPointError, match=message):
            moduli_distance(*arguments, 0.1)
    with pytest.raises(NotASiegelPointError, match=message):
        symplectic_automorphism_group(matrix)


def test_different_genus():
    with pytest.raises(ValueError, match="different genus, 1 and 2"):
        symplectic_isomorphisms([[1j]], np.diag([1j, 1j]))
