"""Small integer coefficients of the same curve."""

from fractions import Fraction

import flint
import pytest

from igl_periods.curves.binary_forms import igusa_clebsch_of_sextic, shioda_invariants, substituted
from igl_periods.curves.integer_forms import primitive_form, reduced_form
from igl_periods.curves.weighted_points import same_point

FORM = [3, -1, 4, 1, -5, 9, 2]
CHANGES = [[[7, 3], [0, 1]], [[1, 0], [30, 11]], [[123, 47], [35, 61]], [[1009 * 1013, 5], [0, 1]]]


@pytest.mark.parametrize("change", CHANGES)
def test_a_rational_substitution_is_undone(change):
    large = substituted([flint.fmpz(c) for c in FORM], change)
    found = reduced_form([Fraction(int(c), 7) for c in large])
    assert sum(c * c for c in found) <= sum(c * c for c in FORM)
    pair = [igusa_clebsch_of_sextic([flint.fmpq(c) for c in f]) for f in (found, FORM)]
    assert same_point(*pair, (2, 4, 6, 10))


def test_octics_at_small_primes():
    form = [1, 0, 3, 0, 14, -1, 0, 2, 1]
    large = substituted([flint.fmpz(c) for c in form], [[35, 2], [0, 1]])
    found = reduced_form([Fraction(int(c)) for c in large])
    assert max(map(abs, found)) <= 20
    pair = [shioda_invariants([flint.fmpq(c) for c in f]) for f in (found, form)]
    assert same_point(*pair, range(2, 11))


def test_irrational_scales_of_even_forms():
    """x ↦ √2 x and x ↦ √3 x."""
    assert reduced_form([Fraction(c) for c in (0, 4, 0, 0, 0, 1, 0)]) == [0, 1, 0, 0, 0, 1, 0]
    assert reduced_form([Fraction(c) for c in (0, 9, 0, 3, 0, 1, 0)]) == [0, 1, 0, 1, 0, 1, 0]


def test_primitive_forms():
    assert primitive_form([Fraction(1, 2), Fraction(-3, 4), Fraction(0)]) == [-2, 3, 0]
    with pytest.raises(ValueError, match="all 0"):
        primitive_form([0, 0])
