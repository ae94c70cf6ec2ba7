"""Sums in groups: the same sum, with less rounding."""

from fractions import Fraction

import numpy as np
import pytest

from igl_periods.harmonic.grouped_sums import sum_in_groups


@pytest.mark.parametrize("n", [0, 1, 2, 3, 4, 10, 99, 100])
def test_every_term_counts_once(n):
    terms = np.arange(n * 6, dtype=float).reshape(n, 2, 3)
    assert np.array_equal(sum_in_groups(iter(terms), n, (2, 3)), terms.sum(axis=0))


def test_rounding_grows_with_the_root_of_the_number_of_terms():
    n, term = 10_000, np.array([0.1, 1 / 3, 0.7])
    exact = [n * Fraction(x) for x in term.tolist()]
    found = sum_in_groups((term for _ in range(n)), n, (3,))
    one_by_one = np.zeros(3)
    for _ in range(n):
        one_by_one += term

    def worst(total):
        return max(abs(Fraction(x) / y - 1) for x, y in zip(total.tolist(), exact, strict=True))

    assert worst(found) <= 2 * 101 * 2.0**-53
    assert worst(found) < worst(one_by_one)
