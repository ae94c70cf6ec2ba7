"""Contravariants and invariants of plane quartics."""

import flint
import pytest

from igl_periods.curves.ternary_forms import (
    DIXMIER_OHNO_WEIGHTS,
    applied,
    dixmier_ohno_invariants,
    hessian,
    line_contravariants,
    transformed,
)

ONE = flint.fmpq(1)
FERMAT = {(4, 0, 0): ONE, (0, 4, 0): ONE, (0, 0, 4): ONE}
KLEIN = {(3, 1, 0): ONE, (0, 3, 1): ONE, (1, 0, 3): ONE}
NUMBERS = [3, -1, 4, 1, -5, 9, 2, 6, -5, 3, 5, -8, 9, 7, -9]
EXPONENTS = [(i, j, 4 - i - j) for i in range(5) for j in range(5 - i)]
GENERIC = {e: flint.fmpq(n) for e, n in zip(EXPONENTS, NUMBERS, strict=True)}
MATRIX = [[1, 2, 3], [1, 1, 5], [1, 0, 1]]  # of determinant 6


def test_invariants_have_their_degrees():
    values = dixmier_ohno_invariants(GENERIC)
    assert all(value != 0 for value in values)
    moved = dixmier_ohno_invariants(transformed(GENERIC, MATRIX))
    scaled = dixmier_ohno_invariants({e: 2 * c for e, c in GENERIC.items()})
    for value, w, m, s in zip(values, DIXMIER_OHNO_WEIGHTS, moved, scaled, strict=True):
        assert m == value * 6 ** (4 * w // 3)
        assert s == value * 2**w


def test_klein_and_fermat_differ_by_the_first_two():
    klein, fermat = dixmier_ohno_invariants(KLEIN), dixmier_ohno_invariants(FERMAT)
    assert klein[1] / klein[0] ** 2 == flint.fmpq(-280, 3)
    assert fermat[1] / fermat[0] ** 2 == flint.fmpq(8, 3)
    assert not any(klein[2:])
    assert not any(fermat[2:])


def test_contravariants_of_the_fermat_quartic():
    """On u x + v y + w z = 0 the quartic has I = u⁴ + v⁴ + w⁴ and J a multiple of u² v² w²."""
    sigma, psi = line_contravariants(FERMAT)
    assert {e: c for e, c in sigma.items() if c} == FERMAT
    assert [e for e, c in psi.items() if c] == [(2, 2, 2)]


def test_hessian_of_the_fermat_quartic():
    assert {e: c for e, c in hessian(FERMAT).items() if c} == {(2, 2, 2): flint.fmpq(1728)}


def test_operators_differentiate():
    assert applied({(2, 1, 0): ONE}, {(4, 1, 0): ONE, (1, 4, 0): ONE}) == {(2, 0, 0): 12}


def test_refused():
    with pytest.raises(ValueError, match="degree 4"):
        dixmier_ohno_invariants({(3, 0, 0): ONE})
