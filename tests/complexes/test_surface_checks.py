"""Which complexes are connected, closed and oriented, and what is said of others."""

import numpy as np
import pytest
from support.random_surfaces import (
    torus_of_revolution,
)
from support.small_complexes import POINTS, TETRAHEDRON, check_invariants

import igl_periods as ip
from igl_periods.complexes.surface_checks import check_surface, is_orientable


def test_components_are_found_and_keep_their_rows_of_V():
    V, F = torus_of_revolution(2.0, 0.5, 6, 5)
    two = np.concatenate([F + len(V), F])
    K = ip.DeltaComplex.from_mesh(np.concatenate([V, V + 9.0]), two)
    first, second = K.components()
    assert first.labels.min() == len(V)
    assert second.labels.max() == len(V) - 1
    for part in (first, second):
        check_invariants(part)
        assert np.array_equal(part.corner_vertex, F)
    with pytest.raises(ip.ComplexError, match="2 components"):
        check_surface(K)


def test_boundary():
    K = ip.DeltaComplex.from_mesh(POINTS, TETRAHEDRON[:3])
    with pytest.raises(ip.ComplexError, match=r"not closed: it has 3 boundary edges.*double"):
        check_surface(K)


def test_inconsistent_orientation():
    F = TETRAHEDRON.copy()
    F[1] = F[1, ::-1]
    K = ip.DeltaComplex.from_mesh(POINTS, F)
    assert is_orientable(K)
    with pytest.raises(ip.ComplexError, match=r"across 3 edges.*orientable: turn faces over"):
        check_surface(K)


def test_non_orientable():
    # The projective plane on six vertices.
    F = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1],
         [1, 2, 4], [2, 3, 5], [3, 4, 1], [4, 5, 2], [5, 1, 3]]  # fmt: skip
    K = ip.DeltaComplex.from_mesh(np.random.default_rng(0).normal(size=(6, 4)), F)
    assert K.euler_characteristic == 1
    assert not is_orientable(K)
    with pytest.raises(ip.ComplexError, match="not orientable"):
        check_surface(K)
