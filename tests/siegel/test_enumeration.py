"""Short vectors: all of them, and up to a limit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from igl_periods.errors import EnumerationLimitError
from igl_periods.siegel.enumeration import short_vectors


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 5), st.integers(0, 2**32 - 1))
def test_short_vectors_are_all_short_vectors(n, seed):
    rng = np.random.default_rng(seed)
    A = rng.standard_normal((n, n))
    Y = A @ A.T + 0.5 * np.eye(n)
    bound = 3.0
    vectors, values = short_vectors(Y, bound)
    box = np.stack(np.meshgrid(*[np.arange(-3, 4)] * n), -1).reshape(-1, n)  # |x_i| ≤ √(3 / 0.5)
    expected = {tuple(x) for x in box.tolist() if np.array(x) @ Y @ np.array(x) <= bound}
    assert {tuple(x) for x in vectors.tolist()} == expected
    assert len(vectors) == len(expected)
    assert np.abs(values - np.einsum("ni,ij,nj->n", vectors, Y, vectors)).max() < 1e-12
    assert np.all(np.diff(values) >= 0)


def test_enumeration_has_a_limit():
    with pytest.raises(
        EnumerationLimitError, match="more than 100 partial vectors at level 2 of 3"
    ):
        short_vectors(np.eye(3), 50.0, limit=100)
