"""Gluings of triangles, and gluings that are none."""

import numpy as np
import pytest
from support.small_complexes import POINTS, TETRAHEDRON

import igl_periods as ip


def test_gluings_that_reverse_orientation_are_checked():
    twin = ip.DeltaComplex.from_mesh(POINTS, TETRAHEDRON).twin
    with pytest.raises(ip.ComplexError, match="same must"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), twin, np.zeros(3, dtype=bool))
    same = np.zeros((4, 3), dtype=bool)
    same[0, 0] = True
    with pytest.raises(ip.ComplexError, match="same differs"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), twin, same)


def test_unequal_lengths_of_glued_sides():
    lengths = np.ones((4, 3))
    lengths[1, 1] = 1.0 + 1e-6
    with pytest.raises(
        ip.ComplexError, match=r"different lengths: 1 at side 2 of face 0, 1\.000001 at"
    ):
        ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)
    for difference, allowed in ((0.9e-9, True), (1.1e-9, False)):
        lengths[1, 1] = 1.0 + difference
        if allowed:
            ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)
            continue
        with pytest.raises(ip.ComplexError, match="different lengths"):
            ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)
    lengths[1, 1] = 1.0 + 1e-12
    K = ip.DeltaComplex.from_lengths(lengths, TETRAHEDRON)
    assert K.lengths[1, 1] == K.lengths.ravel()[K.twin[1, 1]] == 1.0 + 0.5e-12


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t.__setitem__((0, 0), t[1, 1]), "not an involution"),
        (lambda t: t.__setitem__((0, 0), 0), "not an involution without fixed points"),
        (lambda t: t.__setitem__((0, 0), 99), "entries from .* to 99"),
        (lambda t: t.__setitem__((0, 0), -2), "entries from -2"),
    ],
)
def test_gluings_that_are_none(change, message):
    twin = ip.DeltaComplex.from_mesh(POINTS, TETRAHEDRON).twin.copy()
    change(twin)
    with pytest.raises(ip.ComplexError, match=message):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), twin)
