"""Permutations: composition is that of functions, and what is none is refused."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.surfaces.permutations import checked_permutation, composed


def test_composition_is_the_product_of_matrices():
    rng = np.random.default_rng(0)
    for n in range(1, 8):
        a, b, c = (tuple(rng.permutation(n).tolist()) for _ in range(3))
        # Column i of the matrix of p is the unit vector of p(i).
        A, B = (np.eye(n, dtype=int)[:, list(p)] for p in (a, b))
        assert np.array_equal(np.eye(n, dtype=int)[:, list(composed(a, b))], A @ B)
        assert composed(composed(a, b), c) == composed(a, composed(b, c))
        assert composed(a, tuple(np.argsort(a).tolist())) == tuple(range(n))


def test_permutations_pass():
    images = checked_permutation([2, 0, 1], "right")
    assert images.dtype == np.int64
    assert images.tolist() == [2, 0, 1]


@pytest.mark.parametrize("images", [[], [[0, 1]], [0.0, 1.0], 3])
def test_arrays_of_a_wrong_shape_or_type(images):
    with pytest.raises(ip.ComplexError, match="right must be a list of integers"):
        checked_permutation(images, "right")


@pytest.mark.parametrize("images", [[1, 2], [0, 0], [-1, 0, 1]])
def test_images_that_are_not_all_numbers_once(images):
    with pytest.raises(ip.ComplexError, match="up is no permutation of 0, …,"):
        checked_permutation(images, "up")
