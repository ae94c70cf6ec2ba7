"""Energies of many harmonic forms: portions change nothing but the memory that they take."""

import itertools
import tracemalloc
from fractions import Fraction

import numpy as np
import pytest
from random_surfaces import BOLZA, noisy_torus, random_gluing, random_lengths

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.weights import cotan_weights
from igl_periods.harmonic import energies as harmonic_energies
from igl_periods.harmonic import linear_forms
from igl_periods.harmonic.energies import dirichlet_matrix, harmonic_problem, linear_energies
from igl_periods.harmonic.linear_forms import Jumps, LinearForms, WeightedFaces, mutual_energies
from igl_periods.harmonic.potentials import factored, harmonic_potentials
from igl_periods.harmonic.rounding import geometric_allowance
from igl_periods.surfaces import thickened_lattice
from igl_periods.topology.cohomology import cochains_and_basis


def lattice(shape):
    """An irregular surface of high genus, with thin triangles: one vertex in six is moved far."""
    V, F = thickened_lattice(shape, 1, aspect=2, jitter=0.15)
    moved = np.random.default_rng(1).uniform(size=len(V)) < 1 / 6
    V[moved] *= 1 + 1e-3
    return ip.DeltaComplex.from_mesh(V, F)


def test_panels_give_the_same_energies(monkeypatch):
    K = lattice((4, 4, 3))
    cochains, _ = cochains_and_basis(K)
    whole, allowance = linear_energies(K, cochains)
    scale = np.sqrt(np.diag(whole))
    columns = []
    solutions = harmonic_energies.solutions
    monkeypatch.setattr(
        harmonic_energies,
        "solutions",
        lambda factor, sources: columns.append(sources.shape[1]) or solutions(factor, sources),
    )
    for memory in (0.0, 16.0 * K.n_vertices * 50):
        columns.clear()
        parts, rounding = linear_energies(K, cochains, memory)
        assert np.array_equal(parts, parts.T)
        assert np.abs(parts - whole).max() <= 1e-13 * np.outer(scale, scale).max()
        assert (np.abs(parts - whole) <= 1e-13 * np.outer(scale, scale)).all()
        assert rounding == pytest.approx(allowance, rel=1e-9)
        width = 32 if memory == 0.0 else 50
        panels = -(-len(whole) // width)
        assert len(columns) == panels * (panels + 1) // 2
        assert max(columns) == width


def test_panels_hold_no_more_than_they_may():
    K = ip.DeltaComplex.from_mesh(*thickened_lattice((4, 4, 4), 4, jitter=0.1))
    cochains, _ = cochains_and_basis(K)
    laplacian, problem = harmonic_problem(K, cochains)
    factor = factored(laplacian)

    def peak(memory):
        tracemalloc.start()
        harmonic_energies.harmonic_energies(problem, factor, memory)
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most

    n, k = problem.sources.shape
    functions = 8 * n * k
    saved = peak(None) - peak(functions / 3)
    # All functions against two panels that together take a third.
    assert 0.55 * functions < saved < 0.75 * functions


@pytest.mark.parametrize(
    "K",
    [
        ip.DeltaComplex.from_squares(BOLZA, 3),
        ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.2, 4)),
        lattice((2, 2, 2)),
    ],
)
def test_energies_and_allowance_are_those_of_the_potentials(K):
    cochains, _ = cochains_and_basis(K)
    L, carried = intrinsic_delaunay(K, cochains)
    potentials = harmonic_potentials(L, cotan_weights(L), carried)
    expected = dirichlet_matrix(L, carried, potentials)
    D, allowance = linear_energies(L, carried)
    np.testing.assert_allclose(D, expected, rtol=1e-12, atol=1e-13)
    assert allowance == pytest.approx(
        geometric_allowance(
            L, D, lambda weights: dirichlet_matrix(L, carried, potentials, weights)
        ),
        rel=1e-9,
    )


def test_energies_on_a_surface_with_one_vertex():
    rng = np.random.default_rng(11)
    gluings = (random_gluing(6, rng) for _ in itertools.count())
    surfaces = (ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin) for twin in gluings)
    K = next(K for K in surfaces if K.n_vertices == 1)
    cochains, _ = cochains_and_basis(K)
    D, _ = linear_energies(K, cochains)
    expected = dirichlet_matrix(K, cochains, np.zeros((1, 2 * K.genus)))
    assert np.array_equal(D, expected)


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


def test_blocks_of_harmonic_forms_are_their_rows():
    K = lattice((3, 2, 2))
    whole = ip.harmonic_forms(K)
    blocks = list(ip.harmonic_form_blocks(K, rows=3))
    assert [len(block) for block in blocks[:-1]] == [3] * (len(blocks) - 1)
    np.testing.assert_allclose(np.concatenate(blocks), whole, rtol=0, atol=1e-12)
    with pytest.raises(ValueError, match="rows = 0: a block has 1 row at least"):
        ip.harmonic_form_blocks(K, rows=0)


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
