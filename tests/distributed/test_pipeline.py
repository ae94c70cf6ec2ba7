"""One surface on several ranks: the same matrix, with its bound, as on one machine."""

import numpy as np
import pytest
from support.distributed_runs import SURFACES
from support.mpi_processes import OneRank
from support.random_surfaces import OMEGA_1, OMEGA_2

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.distributed import period_matrix
from igl_periods.symplectic.canonical_basis import standard_form

# ---- Solution and bound ----


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize("how", ["tight", "no flips"])
@pytest.mark.parametrize("name", SURFACES)
def test_the_same_as_on_one_machine(runs, alone, name, how, n):
    pm, expected = runs(n)[0][name, how], alone[name, how]
    scale = np.sqrt(np.diag(expected.dirichlet))
    error = np.abs(pm.dirichlet - expected.dirichlet) / np.outer(scale, scale)
    assert error.max(initial=0.0) < 1e-12
    assert (pm.cocycles != expected.cocycles).nnz == 0
    assert pm.bound == pytest.approx(expected.bound, rel=1e-9, abs=1e-14)
    assert pm.rounding == pytest.approx(expected.rounding, rel=1e-6)
    assert pm.certified


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize(("name", "exact"), [("L", OMEGA_1), ("Bolza", OMEGA_2)])
@pytest.mark.parametrize("how", ["tight", "loose", "unsolved"])
def test_the_exact_matrix_is_within_the_bound(runs, alone, name, exact, how, n):
    fine = ip.period_matrix(SURFACES[name], degree=8)
    gamma = ip.symplectic_isomorphisms(exact, fine, tolerance=1e-5, limit=1)[0]
    exact = ip.siegel_transform(gamma, exact)
    pm = runs(n)[0][name, how]
    Y = pm.matrix.imag
    root = np.linalg.inv(np.linalg.cholesky(Y))
    assert np.linalg.norm(root @ (exact - pm.matrix) @ root.T, 2) <= pm.bound
    assert (np.abs(exact - pm.matrix) <= pm.entry_bounds).all()
    # The bracket J D⁻¹ Jᵀ ≤ D_exact ≤ D of the theorem itself.
    X, Y = exact.real, exact.imag
    inverse = np.linalg.inv(Y)
    D_exact = np.block([[Y + X @ inverse @ X, -X @ inverse], [-inverse @ X, inverse]])
    J = standard_form(len(Y))
    assert np.linalg.eigvalsh(pm.dirichlet - D_exact).min() > -1e-12
    lower = J @ np.linalg.inv(pm.dirichlet) @ J.T
    assert np.linalg.eigvalsh(D_exact - lower).min() > -1e-12
    if how != "tight":
        assert pm.bound > 1.001 * alone[name, "tight"].bound


def test_unmet_tolerances_are_a_warning_on_rank_0(runs):
    root, other = runs(2)
    assert not other["warnings"]
    categories, messages = zip(*root["warnings"])
    assert set(categories) == {ip.ToleranceWarning}
    assert all("forms are not harmonic to rtol = 1e-08 after 1 iter" in text for text in messages)


def test_surfaces_cover_what_is_awkward():
    K = SURFACES["coarse torus"]
    flipped, _ = intrinsic_delaunay(K, ip.cohomology_basis(K))
    ends = np.sort(np.stack(edge_ends(flipped)), axis=0)
    assert np.unique(ends, axis=1).shape[1] < K.n_edges, "flips made edges with the same ends"
    assert (np.diff(np.stack(edge_ends(SURFACES["random"])), axis=0) == 0).any(), "loops"
    assert SURFACES["more ranks than faces"].n_faces < 3
    assert SURFACES["more ranks than vertices"].n_vertices == 2
    assert SURFACES["random"].genus > 5


# ---- Failures and options ----


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rtol": 0.0}, "rtol = 0.0: residuals fall by a factor"),
        ({"rtol": 1.0}, "rtol = 1.0"),
        ({"rtol": float("nan")}, "rtol = nan"),
        ({"max_iterations": 0}, "max_iterations = 0: one iteration"),
    ],
)
def test_options_without_meaning_are_refused(options, message):
    with pytest.raises(ValueError, match=message):
        period_matrix(SURFACES["L"], comm=OneRank(), **options)
