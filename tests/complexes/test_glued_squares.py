"""Glued squares: genus, and gluings that are none."""

import pytest
from support.random_surfaces import (
    BOLZA,
    HEXAGON,
    L_SHAPE,
)
from support.small_complexes import check_invariants

import igl_periods as ip


@pytest.mark.parametrize(
    ("gluing", "vertices"), [(L_SHAPE, (1, 25)), (BOLZA, (2, 34)), (HEXAGON, (4, 52))]
)
def test_squares_have_genus_two(gluing, vertices):
    # V = (number of squares) n² − 2, by the Euler characteristic.
    for n, expected in zip((1, 3), vertices, strict=True):
        K = ip.DeltaComplex.from_squares(gluing, n)
        assert expected == len(gluing) // 2 * n * n - 2
        assert (K.genus, K.n_vertices) == (2, expected)
        check_invariants(K)


@pytest.mark.parametrize(
    ("gluing", "n", "message"),
    [
        ([((0, 0), (0, 2)), ((0, 1), (0, 1))], 1, "side 1 of square 0 is glued 2 times"),
        ([((0, 0), (0, 2)), ((0, 1), (1, 3))], 1, "side 3 of square 0 is glued 0 times"),
        ([((0, 0), (0, 4)), ((0, 1), (0, 3))], 1, "sides are 0 bottom"),
        ([((0, 0), (0, 2)), ((0, 1), (0, 3))], 0, "n = 0"),
        ([((0, 0), (0, 2)), ((0, 1), (0, 3))], 2.0, "n = 2.0"),
        ([((0, 0), (0, 2)), ((0, 1), (10**9, 3))], 1, "square 1000000000 is named"),
        ([((0, 0), (0, 2)), ((0, 1),)], 1, "list of pairs"),
        ([(0, 1), (2, 3)], 1, "list of pairs"),
        (None, 1, "list of pairs"),
        ([((0, 0), (0, 2)), ((0, 1), (0, 3))], 10**9, r"have 2e\+18 triangles, and up to 1e\+08"),
    ],
)
def test_gluings_of_squares_that_are_none(gluing, n, message):
    with pytest.raises(ip.ComplexError, match=message):
        ip.DeltaComplex.from_squares(gluing, n)
