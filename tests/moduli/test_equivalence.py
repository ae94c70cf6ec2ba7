"""Equivalence under Sp(2g, Z), and distance in moduli space."""

import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array
from support.modular_words import random_point, random_word
from support.symmetric_matrices import SYMMETRIC, keys, reflected

import igl_periods as ip
from igl_periods.complexes.midpoint_subdivision import split
from igl_periods.errors import EnumerationLimitError, NotASiegelPointError
from igl_periods.moduli.automorphisms import symplectic_automorphism_group
from igl_periods.moduli.equivalence import moduli_distance, symplectic_isomorphisms
from igl_periods.siegel.half_space import siegel_distance, siegel_transform
from igl_periods.surfaces import (
    cyclic_cover,
    flat_torus,
    regular_map_surface,
    square_tiled_surface,
)
from igl_periods.symplectic.canonical_basis import standard_form

cases = st.tuples(st.integers(1, 6), st.integers(0, 2**32 - 1), st.integers(0, 30))


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
    one = symplectic_isomorphisms(Pi, Pi, limit=1)
    assert one.verdict == "1 transformation within 2e-08, and there may be more"
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
