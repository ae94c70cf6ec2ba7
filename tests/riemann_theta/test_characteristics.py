"""Spin structures: how many, their quadratic forms, and how a marking moves them."""

import numpy as np
import pytest
from support.modular_words import random_word

from igl_periods import SpinStructure, siegel_transform, spin_structures, theta
from igl_periods.riemann_theta.characteristics import twice_characteristic

PI = np.array([[0.2 + 1.1j, 0.3 - 0.2j], [0.3 - 0.2j, -0.1 + 1.4j]])


@pytest.mark.parametrize("genus", [0, 1, 2, 3, 4])
def test_numbers_of_even_and_odd_spin_structures(genus):
    even, odd = (len(spin_structures(genus, parity)) for parity in ("even", "odd"))
    assert even == (4**genus + 2**genus) // 2
    assert odd == (4**genus - 2**genus) // 2
    assert len(spin_structures(genus)) == even + odd


def test_the_form_is_quadratic_and_the_arf_invariant_is_what_most_values_are():
    cycles = np.array(list(np.ndindex((2,) * 4)))
    for spin in spin_structures(2):
        values = np.array([spin(x) for x in cycles])
        assert (values.sum() > 8) == (spin.arf == 1)
        for x in cycles:
            for y in cycles:
                product = x[:2] @ y[2:] - x[2:] @ y[:2]
                assert spin((x + y) % 2) == (spin(x) + spin(y) + product) % 2


def test_a_change_of_marking_moves_spin_structures_with_their_theta_constants():
    gamma = random_word(2, 6, np.random.default_rng(5))
    moved = siegel_transform(gamma, PI)
    factor = abs(np.linalg.det(gamma[2:, :2] @ PI + gamma[2:, 2:])) ** 0.5
    images = {spin.moved(gamma) for spin in spin_structures(2)}
    assert len(images) == 16
    for spin in spin_structures(2):
        there = spin.moved(gamma)
        assert there.arf == spin.arf
        expected = factor * abs(theta(PI, 0, spin))
        assert abs(abs(theta(moved, 0, there)) - expected) < 1e-11


def test_odd_spin_structure_of_a_torus_counts_turns():
    spin = SpinStructure((1,), (1,))
    assert [spin([1, 0]), spin([0, 1]), spin([1, 1])] == [1, 1, 1]
    assert spin + SpinStructure((0,), (1,)) == (1, 0)


def test_halves_and_integers_are_the_same_characteristic():
    assert twice_characteristic(([0.5, 0], [0, 0.5]), 2) == ([1, 0], [0, 1])
    assert twice_characteristic(([1, 0], [0, 1]), 2) == ([1, 0], [0, 1])
    assert twice_characteristic(SpinStructure((1, 0), (0, 1)), 2) == ([1, 0], [0, 1])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: SpinStructure((0, 2), (0, 0)), "digits 0 or 1"),
        (lambda: SpinStructure((0,), (1,))([1, 0, 0]), "2 integer coefficients"),
        (lambda: spin_structures(11), "genus 0 to 10"),
        (lambda: spin_structures(2, "spin"), "'even' or 'odd'"),
        (lambda: twice_characteristic(([1], [0]), 2), "pair of 2 numbers"),
        (lambda: twice_characteristic(([0.25], [0]), 1), "½ Z"),
        (lambda: twice_characteristic(5, 1), "not a characteristic"),
    ],
)
def test_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
