"""Enclosures in words: exactly the digits that are proved, and which surface."""

from dataclasses import replace

import flint
import numpy as np
import pytest

import igl_periods as ip
from igl_periods.display import ball_matrix_lines
from igl_periods.enclosures import with_exact_distances
from igl_periods.reports import enclosure_summary, lengths_in_words

SQUARE = [((0, 0), (0, 2)), ((0, 1), (0, 3))]


def test_digits_that_are_shown_are_right():
    with flint.ctx.workprec(200):
        third, root = flint.arb(1) / 3, flint.arb(2).sqrt()
        z = flint.acb(-third + flint.arb(0, "1e-12"), root + flint.arb(0, "1e-12"))
        (line,) = ball_matrix_lines(flint.acb_mat([[z]]), 30)
    real, _, imag = line.removesuffix(" i").partition(" + ")
    assert abs(float(real) + 1 / 3) < 1.1 * 10.0 ** -(len(real) - 3)
    assert abs(float(imag) - 2**0.5) < 1.1 * 10.0 ** -(len(imag) - 2)
    assert 11 <= len(real) - 3 <= 12
    assert len(ball_matrix_lines(flint.acb_mat([[z]]), 5)[0]) < 25


def test_zeros_and_signs():
    small = flint.arb(0, "1e-20")
    rows = [[flint.acb(small, 1), flint.acb(1, small)], [flint.acb(1, -2), flint.acb(0, 0)]]
    one, two = ball_matrix_lines(flint.acb_mat(rows), 3)
    assert one.split() == ["1.00", "i", "1.00"]
    assert two.split() == ["1.00", "-", "2.00", "i", "0"]
    assert "9 × 9 entries" in ball_matrix_lines(flint.acb_mat(9, 9), 3)[0]


def test_summary_of_a_torus_and_of_a_sphere():
    K = ip.DeltaComplex.from_squares(SQUARE)
    text = " ".join(enclosure_summary(ip.enclose(K, digits=12).reduced(), 12).split())
    assert "1.00000000000 i" in text
    assert "off by 1 in its last digit at most" in text
    assert "exact numbers, square roots for instance" in text
    sphere = ip.double([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    assert "a sphere (genus 0)" in enclosure_summary(ip.enclose(sphere, digits=5), 5)


def test_which_surface_is_meant():
    V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 5, 4)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert "the doubles that are stored, exactly" in lengths_in_words(K)
    assert "their exact distances" in lengths_in_words(with_exact_distances(K))
    changed = replace(K, mollification=1e-9)
    assert "1e-09 was added" in lengths_in_words(changed)
    assert with_exact_distances(changed) is changed
    gluing = ip.DeltaComplex.from_squares(SQUARE)
    assert with_exact_distances(gluing) is gluing


@pytest.mark.parametrize("doubled", [False, True])
def test_exact_distances_are_those_of_the_positions(doubled):
    rng = np.random.default_rng(2)
    V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 5, 4)
    K = ip.DeltaComplex.from_mesh(V + 0.1 * rng.standard_normal(V.shape), F[doubled:])
    K = with_exact_distances(ip.double(K) if doubled else K)
    lengths = np.array([float(x.mid()) for x in K.exact_lengths(100)])
    assert np.abs(lengths[K.edge] - K.lengths).max() < 1e-14
    assert all(float(x.rad()) < 1e-28 for x in K.exact_lengths(100))
