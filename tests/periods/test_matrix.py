"""The result: its estimates, changes of basis, reduction, balls, what it refuses."""

import pickle
from types import SimpleNamespace

import numpy as np
import pytest
from support.brute_force_equivalence import mobius

import igl_periods as ip
from igl_periods.periods.matrix import siegel_reduced
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.symplectic.williamson_form import energy_matrix
from igl_periods.topology.cohomology import pairing


# Estimates and changes of basis
def test_estimates_are_those_of_the_definitions(computed):
    pm = computed("eight.off")
    g, D = pm.genus, pm.dirichlet
    inverse = np.linalg.inv(D[g:, g:])
    np.testing.assert_allclose(pm.primal, -D[:g, g:] @ inverse + 1j * inverse, rtol=1e-12)
    np.testing.assert_allclose(pm.mean, 0.5 * (pm.primal + pm.dual), rtol=1e-15)
    np.testing.assert_allclose(pm.mean, pm.mean.T, rtol=0, atol=1e-12)
    np.testing.assert_allclose(pm.primal.real, pm.dual.real.T, rtol=0, atol=1e-12)
    J = standard_form(g)
    lower = J @ np.linalg.inv(D) @ J.T
    # The dual estimate is the primal one of J D⁻¹ Jᵀ up to the order of indices.
    np.testing.assert_allclose(np.linalg.inv(lower[g:, g:]), pm.dual.imag, rtol=1e-10)


def test_symplectic_mean_is_symplectic(computed):
    for name in ("eight.off", "scaffolding.ply"):
        Pi = computed(name).matrix
        G, J = energy_matrix(Pi), standard_form(len(Pi))
        np.testing.assert_allclose(G @ J @ G, J, rtol=0, atol=1e-9 * np.abs(G).max())


def test_change_of_basis_is_the_moebius_action(computed):
    pm = computed("eight.off")
    gamma = ip.siegel_reduce(pm).gamma
    reduced = pm.reduced()
    np.testing.assert_allclose(reduced.matrix, mobius(gamma, pm.matrix), rtol=0, atol=1e-11)
    basis = reduced.cocycles
    assert np.array_equal(pairing(pm.complex, basis, basis), standard_form(2))
    np.testing.assert_allclose(
        reduced.symplectic_eigenvalues, pm.symplectic_eigenvalues, rtol=0, atol=1e-13
    )
    back = reduced.change_basis(np.rint(np.linalg.inv(gamma)).astype(int))
    assert (back.cocycles != pm.cocycles).nnz == 0
    np.testing.assert_allclose(back.matrix, pm.matrix, rtol=0, atol=1e-11)
    assert reduced.rounding > pm.rounding


@pytest.mark.parametrize("name", ["eight.off", "scaffolding.ply", "buckyball.obj"])
def test_reduced_is_one_change_of_basis(computed, name):
    pm = computed(name)
    reduced, gamma = siegel_reduced(pm)
    once = pm.change_basis(gamma)
    assert np.array_equal(reduced.dirichlet, once.dirichlet)
    assert reduced.rounding == once.rounding
    assert (reduced.cocycles != once.cocycles).nnz == 0
    basis = reduced.cocycles
    assert np.array_equal(pairing(pm.complex, basis, basis), standard_form(pm.genus))
    # The matrix is that of the mesh, moved; rounding is nothing beside the bound.
    moved = ip.siegel_transform(gamma, pm.matrix)
    assert ip.siegel_distance(moved, reduced.matrix) < 1e-10
    assert abs(reduced.bound - pm.bound) < 1e-9
    assert reduced.rounding_allowance < 1e-6 * reduced.bound
    assert np.abs(np.diag(reduced.matrix)).min() >= 1 - 1e-12
    assert np.abs(reduced.matrix.real).max() <= 0.5 + 1e-12


def test_several_reductions_are_one_product(computed, monkeypatch):
    # As if the first reduction had left something to do.
    pm = computed("eight.off")
    T, J = np.eye(4, dtype=int) + np.diag([1, 1], 2), standard_form(2)
    gammas = iter([T, J, np.eye(4, dtype=int)])
    monkeypatch.setattr(
        "igl_periods.periods.matrix.siegel_reduce",
        lambda _, **__: SimpleNamespace(gamma=next(gammas)),
    )
    reduced, total = siegel_reduced(pm)
    assert np.array_equal(total, J @ T)
    moved = ip.siegel_transform(J, ip.siegel_transform(T, pm.matrix))
    np.testing.assert_allclose(reduced.matrix, moved, rtol=0, atol=1e-11)
    # Rounding is counted once.
    once = pm.change_basis(total)
    assert np.array_equal(reduced.dirichlet, once.dirichlet)
    assert reduced.rounding == once.rounding < pm.change_basis(T).change_basis(J).rounding


def test_reduction_has_a_limit(computed):
    pm = computed("eight.off")
    with pytest.raises(ValueError, match=r"up to genus 1 unless .* genus 2: .* max_genus=2 does"):
        pm.reduced(max_genus=1)
    assert np.array_equal(pm.reduced(max_genus=2).matrix, pm.reduced().matrix)


@pytest.mark.parametrize(
    ("gamma", "message"),
    [
        (np.eye(2, dtype=int), r"shape \(4, 4\)"),
        (0.5 * np.eye(4), "integer entries"),
        (2 * np.eye(4, dtype=int), "not symplectic"),
        (np.eye(4, dtype=int) + 10**9 * np.eye(4, k=2, dtype=int), "entries up to 1000000000"),
    ],
)
def test_changes_of_basis_that_are_none(computed, gamma, message):
    with pytest.raises(ValueError, match=message):
        computed("eight.off").change_basis(gamma)


def test_result_is_an_array_is_frozen_and_pickles(computed):
    pm = computed("eight.off")
    assert np.array_equal(np.asarray(pm), pm.matrix)
    assert np.array_equal(np.array(pm, dtype=np.complex64), pm.matrix.astype(np.complex64))
    assert pm.riemann_matrix is pm.matrix
    for array in (pm.matrix, pm.dirichlet, pm.primal, pm.entry_bounds, pm.symplectic_eigenvalues):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    copy = pickle.loads(pickle.dumps(pm))
    assert not copy.dirichlet.flags.writeable
    assert np.array_equal(copy.matrix, pm.matrix)
    assert copy.bound == pm.bound
    assert "genus 2, bound 0.0064\n" in repr(pm)  # upwards


@pytest.mark.parametrize(
    ("D", "message"),
    [
        (np.ones((2, 3)), r"shape \(2g, 2g\)"),
        (np.full((2, 2), np.nan), "not finite"),
        (-np.eye(2), "not positive definite"),
        (np.array([[1.0, 5.0], [0.0, 1.0]]), "is symmetric"),
        (np.eye(4), "cocycles have shape"),
    ],
)
def test_dirichlet_matrices_that_are_none(computed, D, message):
    pm = computed("bob_small.ply")
    with pytest.raises(ip.ComplexError, match=message):
        ip.PeriodMatrix(D, True, pm.cocycles, pm.complex)


def test_balls_of_flint_contain_the_bound(computed):
    pm = computed("eight.off")
    for i in range(2):
        for j in range(2):
            ball = pm.to_flint()[i, j]
            assert complex(ball.mid()) == pm.matrix[i, j]
            assert float(ball.real.rad()) >= pm.entry_bounds[i, j]
            assert float(ball.imag.rad()) >= pm.entry_bounds[i, j]


def test_the_bound_takes_rounding_and_discretisation_together():
    # D may be too small by 1 + r: of all surfaces with D_exact ≤ (1 + r) D the one with the
    # largest error has d (1 + r) where D has d.
    d, r = 3.0, 0.05
    K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))])
    pm = ip.PeriodMatrix(d * np.eye(2), True, ip.cohomology_basis(K), K, r)
    exact = np.diag([d * (1 + r), 1 / (d * (1 + r))])
    Pi = 1j / exact[1, 1]
    error = abs(Pi - pm.matrix[0, 0]) / pm.matrix[0, 0].imag
    assert error <= pm.bound <= error * (1 + 1e-12)
