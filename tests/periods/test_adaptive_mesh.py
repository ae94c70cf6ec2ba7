"""Refinement at the places where the bound comes from."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.random_surfaces import (
    L_SHAPE,
    noisy_torus,
)
from support.surfaces_with_bounds import random_genus_two

import igl_periods as ip
from igl_periods.complexes.barycentre_insertion import insert_barycentres
from igl_periods.elements.least_energy import dirichlet_matrix as high_order_matrix
from igl_periods.elements.least_energy import high_order_forms
from igl_periods.periods.adaptive_mesh import refined_period_matrix
from igl_periods.periods.matrix import PeriodMatrix
from igl_periods.periods.quality import mesh_quality
from igl_periods.surfaces import flat_torus


def test_local_refinement_restores_the_order_of_convergence():
    # One vertex of total angle 6π: with N faces the bound falls like N^(−1/3) if all triangles
    # are divided, and like N^(−1) if those are that hold half of it.
    K = ip.DeltaComplex.from_squares(L_SHAPE, 2)
    slopes, results = [], []
    for local in (True, False):
        refined = refined_period_matrix(K, 1e-9, largest=6000, local=local)
        n, bound = np.array(refined.steps[len(refined.steps) // 2 :]).T
        assert np.all(np.diff(bound) < 0)
        slopes.append(np.polyfit(np.log(n), np.log(bound), 1)[0])
        results.append(refined)
    assert abs(slopes[0] + 1) < 0.08
    assert abs(slopes[1] + 1 / 3) < 0.03
    assert results[0].period_matrix.bound < results[1].period_matrix.bound / 15
    assert results[0].complex.n_faces == 6000


@pytest.mark.parametrize("seed", [1, 5])
def test_refined_matrices_are_within_each_others_bounds(seed):
    K = random_genus_two(seed)
    coarse = ip.period_matrix(K)
    refined = refined_period_matrix(K, coarse.bound / 30).period_matrix
    assert refined.bound <= coarse.bound / 30
    assert refined.complex is K
    assert np.array_equal(refined.cocycles.toarray(), coarse.cocycles.toarray())
    # A third route: elements of high degree on the triangulation as it was.
    D = high_order_matrix(high_order_forms(K, coarse.cocycles, 8))
    accurate = PeriodMatrix(D, True, coarse.cocycles, K)
    for one, other in ((coarse, refined), (coarse, accurate), (refined, accurate)):
        excess = np.abs(one.matrix - other.matrix) - one.entry_bounds - other.entry_bounds
        assert excess.max() < 0
    assert accurate.bound < refined.bound


def test_refinement_stops_at_the_size_limit():
    K = ip.DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.15, 2))
    for local in (True, False):
        refined = refined_period_matrix(K, 1e-12, largest=700, local=local)
        assert refined.complex.n_faces <= 700
        assert refined.steps[-1] == (refined.complex.n_faces, refined.period_matrix.bound)


def test_refinement_of_what_is_good_enough_does_nothing():
    K = flat_torus(1j, 3)
    refined = refined_period_matrix(K, 1e-6)
    assert refined.complex is K
    sphere = ip.DeltaComplex.from_lengths(
        np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    )
    assert refined_period_matrix(sphere, 1e-6).period_matrix.genus == 0


def test_refinement_refuses_what_makes_no_sense():
    K = flat_torus(1j, 3)
    with pytest.raises(ValueError, match="must be positive, not 0"):
        refined_period_matrix(K, 0.0)
    with pytest.raises(ip.ComplexError, match="have 2 columns, but the complex has 27 edges"):
        insert_barycentres(K, csr_array((1, 2)), np.array([0]))
    with pytest.raises(ip.ComplexError, match="not closed"):
        mesh_quality(ip.DeltaComplex.from_mesh(np.eye(3), [[0, 1, 2]]))
    with pytest.raises(ip.ComplexError, match="not closed"):
        refined_period_matrix(ip.DeltaComplex.from_mesh(np.eye(3), [[0, 1, 2]]), 1e-3)
