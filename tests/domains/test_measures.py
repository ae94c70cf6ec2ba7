"""Harmonic measures: known functions, the maximum principle, their energies."""

import numpy as np
import pytest
from support.flat_surfaces import flat_strip
from support.random_domains import circle, random_domain
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.domains.capacities import capacity_matrix
from igl_periods.domains.measures import harmonic_measures
from igl_periods.surfaces import planar_domain


def test_linear_on_cylinders():
    K = flat_strip(1.7, 0.9, 6, 5, glue_x="straight", seed=2)
    u = harmonic_measures(K, degree=1)
    start = np.zeros(K.n_vertices, dtype=bool)
    start[ip.domains.boundary_loops(K)[0].vertices] = True
    assert np.allclose(u[0, start], 1, atol=1e-13)
    # Every value occurs as a height, in rows that were displaced: the energy decides.
    assert np.allclose(u.sum(axis=0), 1, atol=1e-13)
    rho = ip.complexes.cotan_weights(K)
    tail, head = ip.complexes.edge_ends(K)
    assert rho @ (u[0, head] - u[0, tail]) ** 2 == pytest.approx(1.7 / 0.9, rel=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_values_on_loops_and_between(seed):
    V, F = planar_domain(*random_domain(np.random.default_rng(seed)), area=2.0)
    C = capacity_matrix(V, F, degree=3)
    u = C.harmonic_measures(degree=3)
    for i, loop in enumerate(C.loops):
        assert np.allclose(u[:, loop.vertices], np.eye(len(C.loops))[:, [i]], atol=1e-12)
    # The maximum principle, up to the error of the trial functions.
    assert u.min() > -1e-3
    assert u.max() < 1 + 1e-3
    assert np.allclose(u.sum(axis=0), 1)


def test_energies_of_linear_functions_are_above_the_capacities():
    outer, holes = random_domain(np.random.default_rng(1))
    excesses = []
    for area in (1.0, 0.1):
        C = capacity_matrix(planar_domain(outer, holes, area=area), degree=4)
        K, u = C.complex, C.harmonic_measures()
        tail, head = ip.complexes.edge_ends(K)
        du = u[:, head] - u[:, tail]
        energies = (du * ip.complexes.cotan_weights(K)) @ du.T
        excesses.append(np.linalg.eigvalsh((energies - C.bounds.lower)[1:, 1:]))
    assert min(excesses[0].min(), excesses[1].min()) > 0
    # At corners of 270° the order in the size of the triangles is 4/3: 10^(2/3) = 4.6.
    assert excesses[0].max() / excesses[1].max() == pytest.approx(10 ** (2 / 3), rel=0.1)


def test_logarithm_on_a_round_annulus():
    n = 96
    V, F = planar_domain(circle(n), [circle(n, 0.4)], area=0.02)
    u = harmonic_measures(V, F)
    r = np.linalg.norm(V, axis=1)
    assert np.abs(u[1] - np.log(r) / np.log(0.4)).max() < 2e-3


def test_closed_surfaces_are_refused():
    with pytest.raises(ip.ComplexError, match="nothing to measure"):
        harmonic_measures(*noisy_torus(5, 5, 0.1, 1))
    with pytest.raises(ValueError, match="degree = 0"):
        harmonic_measures(planar_domain(circle(5)), degree=0)
