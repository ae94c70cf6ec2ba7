"""What pictures of derivatives show."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.pictures import quadratic_scene, sensitivity_scene
from igl_periods.surfaces import torus_of_revolution

V, F = torus_of_revolution(2.0, 0.8, 40, 20)


@pytest.fixture(scope="module")
def torus():
    return ip.period_matrix(V, F)


def test_sensitivity_is_the_same_along_parallels(torus):
    scene = sensitivity_scene(torus)
    rings = scene.colours.reshape(40, 20, 3)
    assert np.abs(rings - rings[0]).max() < 0.05
    assert np.ptp(rings, axis=1).max() > 0.5
    assert scene.caption.startswith("How much the period matrix moves") and len(scene.legend) == 3


def test_horizontal_lines_of_a_torus(torus):
    """ζ² = dz² on a torus, so its horizontal lines make one angle with all parallels."""
    scene = quadratic_scene(torus, 1, 1)
    angles = []
    for tube in scene.tubes:
        (start, end), normal = tube.points, tube.normals[0]
        assert abs((end - start) @ normal) < 1e-12
        around = np.array([-start[1], start[0], 0.0]) / np.hypot(*start[:2])
        along = (end - start) / np.linalg.norm(end - start)
        angles.append(abs(around @ along))
    assert len(angles) > 300
    assert np.std(angles) < 0.01


def test_there_is_no_such_product(torus):
    with pytest.raises(ValueError, match="there is no product ζ_1 ζ_2: the genus is 1"):
        quadratic_scene(torus, 1, 2)
