"""Covers of the pillowcase: angles by cycles, cyclic ones as known surfaces."""

import numpy as np
import pytest
from support.glued_polygons import same_periods

import igl_periods as ip
from igl_periods.surfaces import pillowcase_cover, quaternion_origami


def cycle_lengths(p):
    left, lengths = set(range(len(p))), []
    while left:
        start = k = left.pop()
        length = 1
        while (k := int(p[k])) != start:
            left.discard(k)
            length += 1
        lengths.append(length)
    return lengths


@pytest.mark.parametrize("seed", range(6))
def test_cycles_are_cone_points(seed):
    rng = np.random.default_rng(seed)
    d = 5
    g = [np.roll(np.arange(d), 1), rng.permutation(d), rng.permutation(d)]
    product = g[2][g[1][g[0]]]
    last = np.argsort(product)
    K = pillowcase_cover(*g, last)
    lengths = sorted(x for p in (*g, last) for x in cycle_lengths(p))
    found = ip.flat_surface_report(K)
    assert sorted(2 * a for a in found.cone_angles) == lengths
    assert found.holonomy in (1, 2)
    assert float(found.area) == pytest.approx(2 * d)
    # Riemann–Hurwitz.
    assert 2 - 2 * found.genus == 2 * d - sum(x - 1 for x in lengths)
    assert np.array_equal(pillowcase_cover(*g).twin, K.twin)


def cyclic(d, *steps):
    return pillowcase_cover(*((np.arange(d) + step) % d for step in steps))


def test_cyclic_covers_with_names():
    # y⁴ = x³ − x with four points of the angle 4π, and y⁶ = (x−a)(x−b)(x−c)(x−d)³.
    wollmilchsau, ornithorynque = cyclic(4, 1, 1, 1, 1), cyclic(6, 1, 1, 1, 3)
    assert ip.flat_surface_report(wollmilchsau).stratum == "H(1, 1, 1, 1)"
    assert ip.flat_surface_report(ornithorynque).stratum == "H(2, 2, 2)"
    assert ornithorynque.genus == 4
    assert same_periods(wollmilchsau, quaternion_origami())


def test_the_torus():
    K = pillowcase_cover("(1,2)", "(1,2)", "(1,2)", "(1,2)")
    assert ip.enclose(K, digits=15).reduced().contains([[1j]])


@pytest.mark.parametrize(
    ("g", "message"),
    [
        (("(1,2)", "(1,2)", "(1,2)", "(1)(2)"), "the product of the permutations is not 1"),
        (("()", "(1)", "(2)", ""), "the cover is not connected: its sheets fall into 2 parts"),
        (("(1,2", "(1)", "(2)"), "g0 is not a product of cycles"),
        (([0, 1], [0, 1, 2], [0, 1]), "g0 permutes 2 things and g1 permutes 3"),
        (([0, 1], [0, 0], [0, 1]), "g1 is not a permutation"),
    ],
)  # fmt: skip
def test_what_is_no_cover(g, message):
    with pytest.raises(ip.ComplexError, match=message):
        pillowcase_cover(*g)
