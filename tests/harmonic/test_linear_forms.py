"""Energies of linear forms: blocks of the Gram matrix, sums without loss."""

from fractions import Fraction

import numpy as np
from support.jittered_lattice import lattice

from igl_periods.harmonic import linear_forms
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.linear_forms import Jumps, LinearForms, WeightedFaces, mutual_energies
from igl_periods.topology.cohomology import cochains_and_basis


def test_mutual_energies_are_blocks_of_the_gram_matrix():
    # With weights on the faces, some of them 0, and arbitrary potentials.
    K = lattice((2, 2, 2))
    cochains, _ = cochains_and_basis(K)
    k = cochains.shape[0]
    rng = np.random.default_rng(0)
    potentials = rng.normal(size=(K.n_vertices, k))
    weights = rng.uniform(size=K.n_faces) * (rng.uniform(size=K.n_faces) < 0.7)
    D = dirichlet_matrix(K, cochains, potentials, weights)
    faces, jumps = WeightedFaces.of(K, weights), Jumps.of(K, cochains, weights)
    one, two = slice(0, 3), slice(3, k)
    forms = [
        LinearForms(faces, jumps.of_cochains(part), potentials[:, part]) for part in (one, two)
    ]
    np.testing.assert_allclose(mutual_energies(*forms), D[one, two], rtol=1e-12, atol=1e-13)


def test_sums_over_many_blocks_lose_few_digits():
    # Equal terms, whose sum one after the other errs in one direction; against fractions.
    n_blocks, ulp = 10_000, np.finfo(float).eps / 2
    n_faces = 512 * n_blocks
    terms = np.array([[0.1, 1 / 3], [0.7, 1e-5 / 3]])
    total = linear_forms._summed(lambda block: terms, np.zeros((2, 2)), n_faces, 1_000_000)
    exact = [n_blocks * Fraction(value) for value in terms.ravel().tolist()]

    def error(sums):
        return max(abs(Fraction(float(t)) / e - 1) for t, e in zip(sums.ravel(), exact))

    assert error(total) < 2 * n_blocks**0.5 * ulp < error(sum([terms] * n_blocks))
