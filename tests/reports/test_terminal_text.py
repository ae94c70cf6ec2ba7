"""The summary in words: as many digits as are known, and every number within its rounding."""

import re

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.periods.matrix import siegel_reduced
from igl_periods.reports.terminal_text import summary
from igl_periods.surfaces import square_tiled_surface, thickened_lattice


def printed(text):
    """The entries of the matrix as they are printed, and the number of their decimals."""
    found = re.findall(r"([+-]\d+\.(\d+)) ([+-]\d+\.\d+) i", text)
    return np.array([float(x) + 1j * float(y) for x, _, y in found]), {len(d) for _, d, _ in found}


@pytest.mark.parametrize("degree", [1, 6])
def test_printed_entries_are_those_of_the_matrix_to_the_digits_that_are_known(degree):
    pm = ip.period_matrix(square_tiled_surface("omega_1", 2), degree=degree)
    reduced, gamma = siegel_reduced(pm)
    text = summary(pm, reduced, gamma)
    entries, decimals = printed(text)
    (digits,) = decimals
    assert digits == np.clip(np.ceil(-np.log10(reduced.bound)) + 1, 3, 15)
    difference = entries - reduced.matrix.ravel()
    assert max(np.abs(difference.real).max(), np.abs(difference.imag).max()) <= 0.51 * 10.0**-digits
    assert "-0.000 " not in text
    assert "genus 2, Siegel reduced" in text


def test_the_transformation_is_printed():
    pm = ip.period_matrix(*noisy_torus(7, 6, 0.1, 1))
    reduced, gamma = siegel_reduced(pm)
    rows = re.findall(r"^ +(-?\d+) +(-?\d+)$", summary(pm, reduced, gamma), flags=re.MULTILINE)
    assert np.array_equal(np.array(rows, dtype=int), gamma)


def test_without_reduction():
    pm = ip.period_matrix(*noisy_torus(7, 6, 0.1, 1))
    text = summary(pm, None, None)
    assert "genus 1, in the marking of the mesh, not Siegel reduced" in text
    assert abs(printed(text)[0][0] - pm.matrix[0, 0]) < 1e-2
    assert "[[a, b], [c, d]]" not in text


def test_large_matrices_are_counted_instead_of_printed():
    pm = ip.period_matrix(*thickened_lattice((3, 2, 2), 1))
    assert pm.genus == 9
    text = summary(pm, *siegel_reduced(pm))
    assert "9 × 9 entries; --json prints all of them" in text
    assert "18 × 18 integers; --json prints all of them" in text


def test_a_sphere_has_no_periods():
    K = ip.DeltaComplex.from_lengths(np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])
    assert "a sphere (genus 0): its period matrix is empty" in summary(
        ip.period_matrix(K), None, None
    )
