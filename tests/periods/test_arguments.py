"""What period_matrix takes as a surface, and options that contradict."""

from types import SimpleNamespace

import numpy as np
import pytest
from support.random_surfaces import (
    L_SHAPE,
    random_gluing,
    random_lengths,
    torus_of_revolution,
)

import igl_periods as ip


def test_arguments_that_are_no_surface():
    with pytest.raises(ip.MeshError, match="faces are missing"):
        ip.period_matrix(np.zeros((4, 3)))
    K = ip.DeltaComplex.from_squares(L_SHAPE)
    with pytest.raises(ip.MeshError, match="leave F out"):
        ip.period_matrix(K, np.zeros((1, 3), int))
    with pytest.raises(ValueError, match='"intrinsic" or "extrinsic"'):
        ip.period_matrix(K, weights="cotan")
    V, F = torus_of_revolution(2.0, 0.5, 6, 5)
    with pytest.raises(ip.ComplexError, match="2 components"):
        ip.period_matrix(np.concatenate([V, V]), np.concatenate([F, F + len(V)]))


def test_mesh_objects_are_taken():
    open3d = pytest.importorskip("open3d")
    V, F = torus_of_revolution(2.0, 0.5, 8, 6)
    expected = ip.period_matrix(V, F).matrix
    vertices = open3d.utility.Vector3dVector(V)
    mesh = open3d.geometry.TriangleMesh(vertices, open3d.utility.Vector3iVector(F))
    assert np.array_equal(ip.period_matrix(mesh).matrix, expected)
    other = SimpleNamespace(vertices=V.tolist(), faces=F.tolist())
    assert np.array_equal(ip.period_matrix(other).matrix, expected)
    with pytest.raises(ip.MeshError, match="faces are missing"):
        ip.period_matrix(SimpleNamespace(vertices=V))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"degree": 0}, "degree = 0"),
        ({"degree": 1.5}, "degree = 1.5"),
        ({"degree": np.nan}, "degree = nan: trial functions have degree 1 at least"),
        ({"degree": np.inf}, "degree = inf: trial functions"),
        ({"degree": None}, "degree = None: trial functions"),
        ({"weights": None}, "weights must be"),
        ({"tolerance": -1.0}, "a bound is always positive"),
        ({"tolerance": np.nan}, "a bound is always positive"),
        ({"degree": 2, "tolerance": 1e-3}, "a tolerance chooses the degree"),
        ({"degree": 2, "weights": "extrinsic"}, "extrinsic weights have degree 1"),
    ],
)
def test_options_that_contradict(options, message):
    with pytest.raises(ValueError, match=message):
        ip.period_matrix(ip.DeltaComplex.from_squares(L_SHAPE), **options)


def test_lengths_suffice():
    rng = np.random.default_rng(2)
    twin = random_gluing(8, rng)
    K = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin)
    assert K.positions is None
    assert ip.period_matrix(K.components()[0]).certified
