"""Arrays from outside: any type that holds numbers, and everything that is refused."""

import numpy as np
import pytest
from support.random_surfaces import torus_of_revolution
from support.small_complexes import POINTS, TETRAHEDRON

import igl_periods as ip


def test_any_integer_or_float_type_and_lists_are_accepted():
    V, F = torus_of_revolution(2.0, 0.5, 5, 4)
    reference = ip.DeltaComplex.from_mesh(V, F)
    for faces in (F.tolist(), F.astype(np.uint32), F.astype(np.int16), np.asfortranarray(F)):
        K = ip.DeltaComplex.from_mesh(np.asfortranarray(V), faces)
        assert np.array_equal(K.lengths, reference.lengths)
    rounded = ip.DeltaComplex.from_mesh(V.astype(np.float32), F)
    np.testing.assert_allclose(rounded.lengths, reference.lengths, rtol=1e-6)


# What is refused
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_coordinates_that_are_not_finite(bad):
    V = POINTS.copy()
    V[2, 1] = bad
    with pytest.raises(ip.MeshError, match=r"1 vertex has coordinates .* vertex 2"):
        ip.DeltaComplex.from_mesh(V, TETRAHEDRON)


@pytest.mark.parametrize("V", [np.zeros(4), np.zeros((4, 1))])
def test_positions_of_a_wrong_shape(V):
    with pytest.raises(ip.MeshError, match=r"V must have shape \(n, d\)"):
        ip.DeltaComplex.from_mesh(V, TETRAHEDRON)
    with pytest.raises(ip.MeshError, match="V must hold real numbers"):
        ip.DeltaComplex.from_mesh(np.array([["a", "b", "c"]]), TETRAHEDRON)


def test_lengths_of_a_wrong_shape_or_type():
    with pytest.raises(ip.ComplexError, match=r"lengths must have shape \(4, 3\)"):
        ip.DeltaComplex.from_lengths(np.ones((3, 3)), TETRAHEDRON)
    with pytest.raises(ip.ComplexError, match="lengths must hold real numbers"):
        ip.DeltaComplex.from_lengths(np.ones((4, 3), dtype=complex), TETRAHEDRON)


def test_gluings_of_a_wrong_shape_or_type():
    with pytest.raises(ip.ComplexError, match=r"twin must have shape \(m, 3\)"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), np.zeros(12, dtype=int))
    with pytest.raises(ip.ComplexError, match="twin must be integer"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), np.zeros((4, 3)))
    with pytest.raises(ip.ComplexError, match="twin is not a rectangular array"):
        ip.DeltaComplex.from_gluing(np.ones((4, 3)), [[0, 1, 2], [0]])
    # −1 is a free side; 2^64 − 1, which has the same bits, is not a half-edge.
    unsigned = np.full((1, 3), 2**64 - 1, dtype=np.uint64)
    with pytest.raises(ip.ComplexError, match=r"entries from 18446744073709551615 to"):
        ip.DeltaComplex.from_gluing(np.ones((1, 3)), unsigned)
    with pytest.raises(ip.ComplexError, match="same is not a rectangular array"):
        ip.DeltaComplex.from_gluing(np.ones((2, 3)), np.full((2, 3), -1), [[True], [False, True]])
