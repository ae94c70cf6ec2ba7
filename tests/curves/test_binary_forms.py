"""Transvectants and invariants of binary forms."""

import flint
import numpy as np
import pytest

from igl_periods.curves.binary_forms import (
    clebsch_invariants,
    form_of_points,
    igusa_clebsch_of_sextic,
    shioda_invariants,
    substituted,
    transvectant,
)
from igl_periods.moduli import igusa_clebsch_invariants

SPECIAL = [[2, 1], [3, 2]]
GENERAL = [[2, 1], [1, 3]]


def rational(*coefficients):
    return [flint.fmpq(c) for c in coefficients]


SEXTIC = rational(3, -1, 4, 1, -5, 9, 2)
OCTIC = rational(3, -1, 4, 1, -5, 9, 2, 6, -5)


def test_transvectants_are_covariant_and_alternate():
    f, g = rational(1, 2, -1, 3), rational(2, 0, 1, 1, -4)
    for k in range(4):
        moved = transvectant(substituted(f, SPECIAL), substituted(g, SPECIAL), k)
        assert moved == substituted(transvectant(f, g, k), SPECIAL)
        assert transvectant(g, f, k) == [(-1) ** k * c for c in transvectant(f, g, k)]


def test_the_second_transvectant_of_a_form_with_itself_is_its_hessian():
    f = rational(1, 0, 0, 1)  # x³ + z³
    assert transvectant(f, f, 2) == rational(0, 2, 0)


@pytest.mark.parametrize(
    ("form", "invariants", "weights"),
    [(SEXTIC, igusa_clebsch_of_sextic, (2, 4, 6, 10)), (OCTIC, shioda_invariants, range(2, 11))],
)
def test_invariants_have_their_degrees(form, invariants, weights):
    values = invariants(form)
    assert invariants(substituted(form, SPECIAL)) == values
    assert all(value != 0 for value in values)
    # det^{wn/2} for a substitution of another determinant, λ^w for a factor.
    degree, determinant = len(form) - 1, 5
    moved = invariants(substituted(form, GENERAL))
    scaled = invariants([3 * c for c in form])
    for value, w, m, s in zip(values, weights, moved, scaled, strict=True):
        assert m == value * determinant ** (w * degree // 2)
        assert s == value * 3**w


def test_igusa_clebsch_agree_with_the_sums_over_roots():
    roots = [0.3, -1.2, 2.0, 0.5 + 1.0j, 0.5 - 1.0j, 4.0]
    form = form_of_points([(flint.acb(r), flint.acb(1)) for r in roots])
    expected = igusa_clebsch_invariants(roots)
    found = [complex(x) for x in igusa_clebsch_of_sextic(form)]
    assert np.allclose(found, expected, rtol=1e-11)


def test_invariants_vanish_on_unstable_forms():
    assert clebsch_invariants(rational(0, 0, 0, 0, 1, 0, 0)) == [0, 0, 0, 0]


def test_refused():
    with pytest.raises(ValueError, match="transvectants 0 to 2"):
        transvectant(rational(1, 0, 1), SEXTIC, 3)
    with pytest.raises(ValueError, match="7 coefficients, not 9"):
        clebsch_invariants(OCTIC)
    with pytest.raises(ValueError, match="9 coefficients, not 7"):
        shioda_invariants(SEXTIC)
