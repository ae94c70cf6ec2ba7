"""Energies from residuals: against Gram matrices of the same forms, whatever the solver did."""

import itertools

import numpy as np
import pytest
import scipy.linalg
from flint import arb_mat, ctx
from support.energies_in_300_bits import flipped_surface
from support.energies_in_300_bits import linear_energies as energies_in_300_bits
from support.jittered_lattice import lattice
from support.random_surfaces import noisy_torus, random_gluing, random_lengths

import igl_periods as ip
from igl_periods.harmonic import residual_energies
from igl_periods.harmonic.energies import dirichlet_matrix, harmonic_problem, linear_energies
from igl_periods.harmonic.potentials import factored
from igl_periods.harmonic.residual_energies import energies_from_residuals, residual_problem
from igl_periods.harmonic.rounding import TRIANGLE_ERROR
from igl_periods.topology.cohomology import cochains_and_basis


def problem_of(K, cochains):
    laplacian, problem = harmonic_problem(K, cochains)
    residuals = residual_problem(
        K, cochains, problem.sources, problem.extreme, problem.extreme_jumps
    )
    return residuals, factored(laplacian)


def relative(E, D):
    """The least and the largest ξᵀ E ξ / ξᵀ D ξ."""
    values = scipy.linalg.eigh(E, D, eigvals_only=True)
    return values[0], values[-1]


def solutions_with(monkeypatch, change):
    """Solutions of the equations, changed; what was taken is kept and returned."""
    taken = []
    solved_panels = residual_energies.solved_panels

    def changed(*arguments, **options):
        for columns, part, solution in solved_panels(*arguments, **options):
            taken.append(change(solution))
            yield columns, part, taken[-1]

    monkeypatch.setattr(residual_energies, "solved_panels", changed)
    return taken


SURFACES = [
    lattice((3, 3, 2)),
    ip.DeltaComplex.from_mesh(*noisy_torus(8, 7, 0.25, 3)),  # needles, caps, edges not Delaunay
]


@pytest.mark.parametrize("noise", [0.0, 1e-9, 1e-4])
@pytest.mark.parametrize("K", SURFACES)
def test_energies_are_those_of_the_forms_that_were_found(K, noise, monkeypatch):
    cochains, _ = cochains_and_basis(K)
    rng = np.random.default_rng(5)
    taken = solutions_with(monkeypatch, lambda f: f + noise * rng.normal(size=f.shape))
    D, allowance = energies_from_residuals(*problem_of(K, cochains))
    f = np.vstack([np.zeros(cochains.shape[0]), np.hstack(taken)])
    low, high = relative(dirichlet_matrix(K, cochains, f) - D, D)
    assert -allowance <= low and high <= allowance
    # The allowance says how good the solution is.
    assert allowance < 1e-6 if noise == 0.0 else allowance > noise


@pytest.mark.parametrize("noise", [0.0, 1e-10])
@pytest.mark.parametrize("seed", range(4))
def test_the_allowance_covers_all_rounding(seed, noise, monkeypatch):
    K = ip.DeltaComplex.from_mesh(*noisy_torus(5, 4, 0.2 + 0.02 * seed, seed))
    cochains, _ = cochains_and_basis(K)
    rng = np.random.default_rng(seed)
    taken = solutions_with(monkeypatch, lambda f: f + noise * rng.normal(size=f.shape))
    D, allowance = energies_from_residuals(*problem_of(K, cochains))
    f = np.vstack([np.zeros(2), np.hstack(taken)])
    exact = energies_in_300_bits(flipped_surface(K, cochains, []), f, np.eye(2))
    ctx.prec = 300
    error = exact - arb_mat(D.tolist())
    error = np.array([[float(error[i, j].mid()) for j in range(2)] for i in range(2)])
    low, high = relative(error, D)
    assert -allowance <= low and high <= allowance


def test_where_there_is_one_vertex_cochains_are_all_that_there_is():
    rng = np.random.default_rng(1)
    gluings = (random_gluing(10, rng) for _ in itertools.count())
    surfaces = (ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin) for twin in gluings)
    K = next(K for K in surfaces if K.n_vertices == 1)
    cochains, _ = cochains_and_basis(K)
    D, allowance = energies_from_residuals(*problem_of(K, cochains))
    expected = dirichlet_matrix(K, cochains, np.zeros((1, 2 * K.genus)))
    low, high = relative(expected - D, D)
    assert -allowance <= low and high <= allowance


def test_both_ways_to_a_period_matrix_agree(monkeypatch):
    K = lattice((4, 4, 3))
    pm = ip.period_matrix(K)
    assert pm.dirichlet.shape[0] > 64
    monkeypatch.setattr("igl_periods.periods.certificate._NEGLIGIBLE", 0.0)
    grams = ip.period_matrix(K)
    assert grams.rounding < 1e-2 * pm.rounding < 1e-4 * pm.bound
    low, high = relative(pm.dirichlet - grams.dirichlet, grams.dirichlet)
    assert max(-low, high) <= pm.rounding
    assert pm.bound == pytest.approx(grams.bound, rel=1e-4)


def test_faces_of_extreme_sensitivity_count_as_in_gram_matrices():
    V, F = noisy_torus(8, 7, 0.1, 3)
    a, b = F[0, :2]
    V[b] = V[a] + 1e-7 * (V[b] - V[a])  # two needles, and caps beside them
    K = ip.DeltaComplex.from_mesh(V, F)
    cochains, _ = cochains_and_basis(K)
    problem, factor = problem_of(K, cochains)
    assert 0 < len(problem.extreme_vertices) < K.n_vertices
    assert problem.bytes_kept == 16 * len(problem.extreme_vertices)
    D, allowance = energies_from_residuals(problem, factor)
    grams, geometric = linear_energies(K, cochains)
    assert geometric > 100 * TRIANGLE_ERROR and allowance > 2 * geometric
    low, high = relative(grams - D, D)
    assert -allowance <= low and high <= allowance
