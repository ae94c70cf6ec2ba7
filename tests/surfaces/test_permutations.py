"""Permutations: composition is that of functions, and what is none is refused."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.surfaces.permutations import checked_permutation, composed, read_permutations


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
    with pytest.raises(ip.ComplexError, match="up is not a permutation of 0, …,"):
        checked_permutation(images, "up")


def test_cycles_are_counted_from_1_and_images_from_0():
    right, up = read_permutations({"right": "(1,2,3)", "up": "(1, 4)"})
    assert right.tolist() == [1, 2, 0, 3]
    assert up.tolist() == [3, 1, 2, 0]
    assert [p.tolist() for p in read_permutations({"a": "(1 2)", "b": [0, 2, 1]})] == [
        [1, 0, 2], [0, 2, 1],
    ]  # fmt: skip
    assert [p.tolist() for p in read_permutations({"a": "", "b": "(2)()(3,1)"})] == [
        [0, 1, 2], [2, 1, 0],
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"a": "1,2"}, 'a is not a product of cycles like "'),
        ({"a": "(1,2"}, "a is not a product of cycles"),
        ({"a": "(1,,2)"}, "a is not a product of cycles"),
        ({"a": "(0,1)"}, "a names 0, and cycles are counted from 1"),
        ({"a": "(1,2)(2,3)"}, "a names 2 twice: cycles are disjoint"),
        ({"a": "(1,1000001)"}, "a names 1000001; up to 1000000"),
        ({"a": [0, 1], "b": [0, 1, 2]}, "a permutes 2 things and b permutes 3"),
        ({"a": "(1,4)", "b": [0, 1, 2]}, "b permutes 3 things and a cycle permutes 4"),
    ],
)
def test_texts_that_are_no_permutations(given, message):
    with pytest.raises(ip.ComplexError, match=message):
        read_permutations(given)
