"""The forms whose energies make a period matrix."""

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import DeltaComplex
from igl_periods.periods.solved_forms import recomputed_forms, solve_forms
from igl_periods.topology import mark

K = DeltaComplex.from_mesh(*noisy_torus(7, 6, 0.15, 2))


@pytest.mark.parametrize(("degree", "parts"), [(1, 1), (3, 4)])
def test_energies_are_those_of_the_matrix(degree, parts):
    """Neighbouring cone points: from degree 2 on every face is divided into four."""
    given = mark(K)
    forms, raw, _ = solve_forms(given, degree=degree)
    assert forms.parts == parts
    D = ip.period_matrix(K, degree=degree).dirichlet
    assert np.allclose(given.basis @ raw @ given.basis.T, D, rtol=1e-12)


def test_the_basis_goes_along():
    forms, _, _ = solve_forms(mark(K))
    U = np.array([[2, 1], [3, 2]])
    dl = np.random.default_rng(0).normal(size=(1, K.n_edges))
    moved = forms.in_basis(U).energy_derivatives(K, dl)
    assert np.allclose(moved, U @ forms.energy_derivatives(K, dl) @ U.T, rtol=1e-12)


def test_forms_are_found_again_with_or_without_flips():
    for delaunay in (True, False):
        pm = ip.period_matrix(K, delaunay=delaunay)
        forms = recomputed_forms(K, pm.cocycles, pm.dirichlet)
        assert bool(forms.moves) == delaunay
