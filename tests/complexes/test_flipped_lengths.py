"""How lengths after Delaunay flips depend on those before."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import (
    Barycentres,
    delaunay_flips,
    edge_lengths,
    flip_derivatives,
    insert_barycentres,
    pull_back,
    push_forward,
    with_edge_lengths,
)


@pytest.fixture(scope="module")
def flipped():
    """A surface on which edges are flipped in several rounds, some of them twice."""
    K = ip.DeltaComplex.from_mesh(*noisy_torus(9, 7, 0.25, 2))
    L, rounds = delaunay_flips(K)
    assert len(rounds) >= 3
    return K, L, rounds


def test_derivatives_are_limits_of_differences(flipped):
    K, _, rounds = flipped
    lengths, dl = edge_lengths(K), np.random.default_rng(0).normal(size=K.n_edges)
    h = 1e-7

    def after(t):
        L, others = delaunay_flips(with_edge_lengths(K, lengths + t * dl))
        assert [a.edge.tolist() for a in others] == [b.edge.tolist() for b in rounds]
        return edge_lengths(L)

    forward = push_forward(flip_derivatives(K, rounds), dl)
    assert np.allclose((after(h) - after(-h)) / (2 * h), forward, rtol=0, atol=1e-6 * abs(dl).max())


def test_lengths_are_homogeneous_of_degree_one(flipped):
    K, L, rounds = flipped
    forward = push_forward(flip_derivatives(K, rounds), edge_lengths(K))
    assert np.allclose(forward, edge_lengths(L), rtol=1e-10)


def test_backward_is_the_transpose_of_forward(flipped):
    K, _, rounds = flipped
    rng = np.random.default_rng(1)
    dl, g = rng.normal(size=(2, 3, K.n_edges))
    steps = flip_derivatives(K, rounds)
    there, back = np.sum(push_forward(steps, dl) * g), np.sum(pull_back(steps, g, K.n_edges) * dl)
    assert there == pytest.approx(back, rel=1e-12)


def test_barycentres_between_flips(flipped):
    """Homogeneous of degree 1, transposes of each other, and limits of differences."""
    K, L, rounds = flipped
    faces, none = np.array([0, 3, 17]), csr_array((0, K.n_edges), dtype=np.int64)
    finer, _ = insert_barycentres(L, none, faces)
    moves = [*rounds, Barycentres.of(L, faces), *delaunay_flips(finer)[1]]
    steps, lengths = flip_derivatives(K, moves), edge_lengths(K)
    end = edge_lengths(delaunay_flips(finer)[0])
    assert np.allclose(push_forward(steps, lengths), end, rtol=1e-9)
    rng = np.random.default_rng(2)
    dl, g = rng.normal(size=(3, K.n_edges)), rng.normal(size=(3, K.n_edges + 9))
    there, back = np.sum(push_forward(steps, dl) * g), np.sum(pull_back(steps, g, K.n_edges) * dl)
    assert there == pytest.approx(back, rel=1e-11)

    def divided(t):
        moved, _ = delaunay_flips(with_edge_lengths(K, lengths + t * dl[0]))
        return edge_lengths(insert_barycentres(moved, none, faces)[0])

    h = 1e-7
    difference = (divided(h) - divided(-h)) / (2 * h)
    found = push_forward(flip_derivatives(K, moves[: len(rounds) + 1]), dl[0])
    assert np.allclose(found, difference, rtol=0, atol=1e-6 * abs(dl).max())


def test_derivatives_pass_through_when_nothing_is_flipped():
    K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=2)
    dl = np.arange(K.n_edges, dtype=float)
    assert np.array_equal(push_forward(flip_derivatives(K, []), dl), dl)
