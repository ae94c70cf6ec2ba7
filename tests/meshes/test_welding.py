"""Welding: equal rows are found whatever their order, and unused vertices go."""

import numpy as np
import pytest

from igl_periods.meshes.welding import compressed, first_equal_row


@pytest.mark.parametrize("seed", range(5))
def test_first_equal_rows_are_those_of_a_search(seed):
    rows = np.random.default_rng(seed).integers(0, 3, (60, 3)).astype(float)
    as_lists = rows.tolist()
    first = first_equal_row(rows)
    assert first.tolist() == [as_lists.index(row) for row in as_lists]
    assert np.array_equal(first[first], first)


def test_rows_that_differ_in_one_bit_are_different():
    rows = np.array([[1.0, 2.0, 3.0], [1.0, 2.0, np.nextafter(3.0, 4)], [1.0, 2.0, 3.0]])
    assert first_equal_row(rows).tolist() == [0, 1, 0]


def test_dropping_unused_vertices_moves_no_corner():
    rng = np.random.default_rng(0)
    V, F = rng.normal(size=(50, 3)), rng.integers(0, 50, (12, 3))
    W, G = compressed(V, F)
    assert np.array_equal(W[G], V[F])
    assert len(W) == len(np.unique(F))
    again, same = compressed(W, G)
    assert np.array_equal(again, W)
    assert np.array_equal(same, G)
