"""Marked faces: the worst hold the part that is wanted; thin ones are replaced by neighbours."""

import numpy as np
import pytest
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.complexes import insert_barycentres, is_divisible
from igl_periods.periods.marking import marked_faces


def square_torus(n):
    return ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n)


def two_needles(width):
    """A rectangle of this width, opposite sides glued; two needles."""
    diagonal = np.hypot(1.0, width)
    twin = [[3, 4, 5], [0, 1, 2]]
    return ip.DeltaComplex.from_gluing([[width, 1.0, diagonal]] * 2, twin)


def test_the_fewest_faces_that_hold_the_part():
    K = square_torus(3)
    excess = np.random.default_rng(0).uniform(size=K.n_faces)
    marked = marked_faces(K, excess, 0.5)
    assert np.all(np.diff(excess[marked]) <= 0)
    assert excess[marked].sum() >= 0.5 * excess.sum() > excess[marked[:-1]].sum()


@pytest.mark.parametrize(("width", "divisible"), [(1e-3, True), (1e-6, False), (1e-9, False)])
def test_needles_are_divisible_while_their_parts_have_lengths_that_say_something(width, divisible):
    K = two_needles(width)
    assert is_divisible(K.lengths).all() == divisible
    assert marked_faces(K, np.ones(2), 0.9).size == (2 if divisible else 0)


def test_parts_without_area_are_refused():
    K = two_needles(1e-9)
    with pytest.raises(ip.ComplexError, match="2 faces are too thin to be divided at their bary"):
        insert_barycentres(K, csr_array((0, K.n_edges), dtype=np.int64), np.arange(2))


def test_neighbours_stand_in_for_a_needle():
    # A vertex very near a corner of a face of a torus; the needle there has all of the excess.
    n = 4
    a, b = np.meshgrid(*(2 * [2 * np.pi * np.arange(n) / n]), indexing="ij")
    V = np.stack([np.cos(a), np.sin(a), np.cos(b), np.sin(b)], axis=-1).reshape(-1, 4)
    corner = np.arange(n * n).reshape(n, n)
    right, up = np.roll(corner, -1, 0), np.roll(corner, -1, 1)
    both = np.roll(right, -1, 1)
    F = np.stack([corner, right, both, corner, both, up], axis=-1).reshape(-1, 3)
    i, j, k = F[0]
    V = np.vstack([V, V[i] + 1e-9 * (0.5 * V[j] + 0.5 * V[k] - V[i])])
    F = np.vstack([F[1:], [[j, k, n * n], [i, j, n * n], [k, i, n * n]]])
    K = ip.DeltaComplex.from_mesh(V, F)
    thin = K.n_faces - 1
    marked = marked_faces(K, np.eye(K.n_faces)[thin], 0.8)
    assert thin not in marked
    assert marked.size > 0
    assert set(marked) <= set(K.twin[thin] // 3)
    assert is_divisible(K.lengths[marked]).all()


def test_refinement_ends_where_all_that_could_be_divided_is_too_thin():
    refined = ip.refined_period_matrix(two_needles(1e-6), 1e-30)
    assert refined.complex.n_faces == 2
