"""The summary in words: as many digits as are known, and every number within its rounding."""

import re

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.periods.matrix import siegel_reduced
from igl_periods.reports.terminal_text import summary
from igl_periods.surfaces import square_tiled_surface, thickened_lattice

NUMBER = r"-?\d+(?:\.\d+)?"


def printed(text):
    """The entries of the matrix as they are printed, and how many decimals each part has."""
    lines = text.split(":\n", 1)[1].split("How far", 1)[0].strip().splitlines()
    cells = [cell.strip() for line in lines for cell in re.split(r" {3,}(?![-+] )", line.strip())]
    entries, decimals = [], []
    for cell in cells:
        whole = re.fullmatch(rf"({NUMBER})? *(?:([+-] {NUMBER}) i)?", cell)
        groups = whole.groups() if whole else ("0", cell.removesuffix(" i"))
        parts = [(part or "0").replace(" ", "") for part in groups]
        entries.append(complex(*map(float, parts)))
        decimals.append([len(part.partition(".")[2]) for part in parts])
    return np.array(entries), np.array(decimals)


@pytest.mark.parametrize("degree", [1, 2, 6])
def test_printed_entries_are_those_of_the_matrix_to_the_digits_that_are_known(degree):
    pm = ip.period_matrix(square_tiled_surface("omega_1", 2), degree=degree)
    reduced, gamma = siegel_reduced(pm)
    text = summary(pm, reduced, gamma)
    entries, decimals = printed(text)
    bounds = np.repeat(reduced.entry_bounds.ravel(), 2).reshape(-1, 2)
    given = entries.view(float).reshape(-1, 2)
    computed = reduced.matrix.ravel().view(float).reshape(-1, 2)
    # What is left out is within its bound of 0, or less than half a unit; all other digits are
    # those of the matrix, rounded, and as many as a bound supports.
    shown = given != 0.0
    assert (np.abs(given - computed)[shown] <= 0.51 * 10.0 ** -decimals[shown]).all()
    assert (bounds[shown] <= 10.0 ** -decimals[shown]).all()
    assert (bounds[shown] > 10.0 ** -(decimals[shown] + 1.0)).all()
    assert (np.abs(computed)[~shown] <= 5.0 * bounds[~shown]).all()
    assert "-0 " not in text
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
    assert abs(printed(text)[0][0] - pm.matrix[0, 0]) < 10.0 ** -printed(text)[1].min()
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
