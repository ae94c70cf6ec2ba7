"""Recognition of quadratic numbers, and what is not recognised."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.known_bounds import known_within

from igl_periods.errors import NotASiegelPointError
from igl_periods.moduli.quadratic_numbers import recognise_entries, recognise_quadratic
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.surfaces import (
    square_tiled_period_matrix,
)


@settings(max_examples=100, deadline=None)
@given(st.integers(-9, 9), st.integers(-6, 6), st.integers(1, 8), st.sampled_from([2, 3, 5, 7, 13]))
def test_small_quadratic_numbers_are_recognised(p, q, r, n):
    guess = recognise_quadratic((p + q * math.sqrt(n)) / r, 1e-14)
    assert guess is not None
    assert guess.rational == Fraction(p, r)
    assert guess.root == Fraction(q, r)
    assert guess.radicand == (n if q else 0)
    assert guess.error < 1e-14


def test_random_numbers_are_not_recognised():
    rng = np.random.default_rng(0)
    for error in (1e-3, 1e-6, 1e-12):
        recognised = [recognise_quadratic(y, error) for y in rng.uniform(-1, 1, 400)]
        assert sum(guess is not None for guess in recognised) <= 2
    assert recognise_quadratic(math.pi) is None
    assert recognise_quadratic(math.e, 1e-6) is None


def test_a_guess_tells_its_error():
    guess = recognise_quadratic(math.sqrt(2) + 3e-9, 1e-8)
    assert str(guess) == "sqrt(2)"
    assert abs(guess.error - 3e-9) < 1e-12
    assert guess.coincidence < 1e-3
    assert str(recognise_quadratic(-0.75)) == "-3/4"
    assert str(recognise_quadratic(1 - math.sqrt(2))) == "1 - sqrt(2)"
    assert float(recognise_quadratic(1 - math.sqrt(2))) == 1 - math.sqrt(2)


def test_entries_of_the_papers_matrices():
    table = recognise_entries(square_tiled_period_matrix("omega_2"))
    text = [[tuple(str(part) for part in entry) for entry in row] for row in table]
    diagonal, off = ("-2/3", "2/3*sqrt(2)"), ("1/3", "-1/3*sqrt(2)")
    assert text == [[diagonal, off], [off, diagonal]]
    pm = known_within(1e-9, siegel_reduce(square_tiled_period_matrix("omega_3")).matrix)
    for row in recognise_entries(pm):
        for real, imaginary in row:
            assert real.radicand == 0
            assert imaginary.radicand == 3


def test_recognition_refuses_nonsense():
    for y, error in ((math.nan, 1e-9), (1.0, 0.0), (1.0, -1.0)):
        with pytest.raises(ValueError, match="finite number and a positive error"):
            recognise_quadratic(y, error)
    with pytest.raises(NotASiegelPointError, match="not symmetric"):
        recognise_entries([[1j, 0.5], [0, 1j]])
