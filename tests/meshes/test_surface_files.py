"""Surfaces of files: components by genus."""

import numpy as np
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.meshes.surface_files import components_by_genus, surface_of


def test_components_are_sorted_by_genus():
    V, F = torus_of_revolution(2.0, 0.7, 16, 8)
    sphere = np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])
    W = np.concatenate([np.eye(4, 3), V])
    K = ip.DeltaComplex.from_mesh(W, np.concatenate([sphere, F + 4]))
    assert [part.genus for part in K.components()] == [0, 1]
    assert [part.genus for part in components_by_genus(K)] == [1, 0]
    assert surface_of(K, component=1).genus == 1
    assert surface_of(K) is K
    doubled = surface_of(ip.DeltaComplex.from_mesh(V, F[1:]), doubled=True, component=1)
    assert doubled.genus == 2
