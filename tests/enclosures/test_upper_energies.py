"""Upper bounds of energies in a canonical basis, without the loss of entries in balls."""

import flint
import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.enclosures.exact_lengths import distances
from igl_periods.enclosures.siegel_point import cholesky
from igl_periods.enclosures.upper_energies import (
    canonical_in_forms,
    linear_upper_energies,
    upper_energies,
)
from igl_periods.topology import mark


def symmetric_balls(rng, n, radius):
    A = rng.normal(size=(n, n))
    E = np.eye(n) + 0.1 * (A + A.T)
    radii = radius * rng.uniform(size=(n, n))
    balls = [[flint.arb(m, r) for m, r in zip(*row)] for row in zip(E.tolist(), radii.tolist())]
    return E, radii, flint.arb_mat(balls)


@pytest.mark.parametrize("seed", range(20))
def test_every_symmetric_matrix_in_the_balls_is_below(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 6))
    E, radii, balls = symmetric_balls(rng, n, 1e-3)
    basis = flint.arb_mat(rng.integers(-3, 4, size=(n, n)).tolist()) + 7 * flint.arb_mat(
        np.eye(n, dtype=int).tolist()
    )
    upper = upper_energies(balls, basis)
    # A number that both of its balls contain: the extreme ones, with any signs.
    shift = np.minimum(radii, radii.T) * np.sign(rng.normal(size=(n, n)))
    inside = E + np.triu(shift) + np.triu(shift, 1).T
    exact = basis * flint.arb_mat(inside.tolist()) * basis.transpose()
    tiny = flint.arb_mat((1e-30 * np.eye(n)).tolist())
    assert cholesky(upper - exact + tiny) is not None


def test_a_basis_in_terms_of_forms():
    W = np.array([[0.5, 0.0], [0.25, 2.0]])
    basis = np.array([[1, 2], [0, 1]])
    product = canonical_in_forms(basis, W) * flint.arb_mat(W.tolist())
    assert product.contains(flint.arb_mat(basis.tolist()))


def test_linear_forms_are_above_what_series_prove():
    V, F = noisy_torus(4, 3, 0.2, 1)
    K = ip.DeltaComplex.from_mesh(V, F)
    marked = mark(K)
    linear = linear_upper_energies(marked, distances(V, K))
    proved = ip.enclose(V, F, digits=8)
    assert cholesky(linear - proved.dirichlet) is not None
