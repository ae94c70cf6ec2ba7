"""Proved energies: exact combinations of cochains, changes of basis that lose nothing."""

import dataclasses
import pickle
from fractions import Fraction

import flint
import numpy as np
import pytest
from flint import arb, arb_mat
from scipy.sparse import csr_array
from support.delaunay_surfaces import distorted
from support.enclosed_forms import enclosed
from support.modular_words import random_word
from support.random_surfaces import BOLZA, L_SHAPE

import igl_periods as ip
from igl_periods.harmonic.linear_forms import Jumps
from igl_periods.periods.matrix import siegel_point
from igl_periods.proofs.proved_energies import (
    CombinedJumps,
    ProvedEnergies,
    orthonormal_combination,
    rounded_rows,
)
from igl_periods.symplectic import williamson
from igl_periods.topology import cochains_and_basis


def proved(K):
    """Energies with their proof, and in 300 bits in the canonical basis."""
    forms, energies, exact = enclosed(K)
    _, T = cochains_and_basis(K)
    W = forms.jumps.combination
    energies = ProvedEnergies(energies.mid, energies.rad, W, T.astype(np.int64))
    change = arb_mat(T.astype(int).tolist()) * arb_mat(W.tolist()).inv()
    return energies, change * exact * change.transpose()


SURFACES = {
    "L": proved(distorted(L_SHAPE, 2, 0.1, 0)),
    "Bolza": proved(distorted(BOLZA, 1, 0.15, 1)),
}


def symplectic_energies(Pi):
    """The Dirichlet matrix of Π in balls."""
    X, Y = arb_mat(Pi.real.tolist()), arb_mat(Pi.imag.tolist())
    inverse = Y.inv()
    XY = X * inverse
    blocks = [[Y + XY * X, XY * arb(-1)], [XY.transpose() * arb(-1), inverse]]
    return arb_mat([a + b for row in blocks for a, b in zip(*(M.table() for M in row))])


def is_definite(A):
    """Whether all leading minors are positive."""
    table = A.table()
    return all(arb_mat([row[:n] for row in table[:n]]).det() > 0 for n in range(1, len(table) + 1))


@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("seed", range(4))
def test_the_bound_is_that_of_the_energies_in_300_bits(name, seed):
    # (1 + b) G(Π) − D is positive definite, and with a slightly smaller b it is not.
    energies, exact = SURFACES[name]
    g = len(energies.basis) // 2
    if seed:
        U = random_word(g, seed, np.random.default_rng(seed))
        energies = energies.in_basis(U)
        exact = arb_mat(U.tolist()) * exact * arb_mat(U.T.tolist())
    Pi = siegel_point(williamson(energies.dirichlet())[1])
    bound = energies.relative_radius(Pi)
    with flint.ctx.workprec(300):
        G = symplectic_energies(Pi)
        assert is_definite(G * (1 + arb(bound)) - exact)
        assert not is_definite(G * (1 + arb(bound) - arb("1e-11")) - exact)


@pytest.mark.parametrize("name", SURFACES)
def test_energies_in_the_canonical_basis_are_the_exact_ones_to_rounding(name):
    energies, exact = SURFACES[name]
    D = energies.dirichlet()
    assert np.array_equal(D, D.T)
    floats = np.array([[float(x) for x in row] for row in exact.table()])
    assert np.abs(D - floats).max() < 1e-15 * np.abs(D).max() * len(D)


@pytest.mark.parametrize("name", SURFACES)
def test_changes_of_basis_lose_nothing(name):
    energies, _ = SURFACES[name]
    g = len(energies.basis) // 2
    U = random_word(g, 12, np.random.default_rng(0))
    inverse = np.rint(np.linalg.inv(U.astype(float))).astype(np.int64)
    assert np.array_equal(U @ inverse, np.eye(2 * g))
    there_and_back = energies.in_basis(U).in_basis(inverse)
    assert np.array_equal(there_and_back.basis, energies.basis)
    assert np.array_equal(there_and_back.rad, energies.rad)
    assert np.array_equal(there_and_back.dirichlet(), energies.dirichlet())


def test_changes_of_basis_that_do_not_fit_are_refused():
    energies, _ = SURFACES["L"]
    huge = np.eye(4, dtype=np.int64)
    huge[0, 2] = 2**62
    with pytest.raises(OverflowError):
        energies.in_basis(huge).in_basis(huge).in_basis(huge).in_basis(huge)


def test_combinations_that_are_singular_prove_nothing():
    energies, _ = SURFACES["L"]
    singular = dataclasses.replace(energies, combination=np.ones((4, 4)))
    with pytest.raises(ip.ComplexError, match="singular in double precision"):
        singular.dirichlet()


def test_proofs_are_pickled_without_what_is_derived():
    energies, _ = SURFACES["L"]
    energies.dirichlet()
    copy = pickle.loads(pickle.dumps(energies))
    assert set(vars(copy)) == {"mid", "rad", "combination", "basis"}
    assert np.array_equal(copy.dirichlet(), energies.dirichlet())


@pytest.mark.parametrize("multiples", [1, 4, 1000, 10**6])
def test_sums_of_rounded_rows_are_exact(multiples):
    rng = np.random.default_rng(multiples)
    W = rng.normal(size=(5, 8)) * 10.0 ** rng.uniform(-8, 8, (5, 8)) * 10.0 ** rng.uniform(-9, 9)
    rounded = rounded_rows(W, multiples)
    largest = np.abs(W).max(axis=1, keepdims=True)
    assert np.all(np.abs(rounded - W) <= largest * multiples * 2.0**-49)
    factors = rng.integers(-(multiples // 8 + 1), multiples // 8 + 2, (8, 50))
    factors[:, np.abs(factors).sum(axis=0) > multiples] = 0
    sums = rounded @ factors.astype(float)
    exact = [
        [sum(Fraction(w) * int(f) for w, f in zip(row, column)) for column in factors.T]
        for row in rounded.tolist()
    ]
    assert [[Fraction(x) for x in row] for row in sums.tolist()] == exact


def test_combinations_make_forms_orthonormal():
    rng = np.random.default_rng(1)
    A = rng.normal(size=(6, 6)) * 10.0 ** rng.uniform(-3, 3, (6, 1))
    cochains = csr_array(rng.integers(-5, 6, (6, 40)))
    W = orthonormal_combination(A @ A.T, cochains)
    assert np.abs(W @ A @ A.T @ W.T - np.eye(6)).max() < 1e-6
    with pytest.raises(ip.ComplexError, match="not positive definite"):
        orthonormal_combination(-np.eye(6), cochains)


def test_combined_jumps_are_those_of_combined_cochains():
    K = distorted(L_SHAPE, 2, 0.1, 0)
    cochains, _ = cochains_and_basis(K)
    rng = np.random.default_rng(2)
    W = rounded_rows(rng.normal(size=(4, 4)), 4)
    combined = CombinedJumps(Jumps.of(K, cochains), W)
    direct = Jumps.of(K, csr_array(csr_array(W) @ cochains))
    for start in (0, 5):
        for side in range(3):
            one, other = rng.normal(size=(2, K.n_faces - start, 4))
            other[:] = one
            combined.add_to(one, start, side, -1)
            direct.add_to(other, start, side, -1)
            assert np.array_equal(one, other)
