"""Scenes are arrays, and say so."""

import numpy as np

from igl_periods.pictures.scene import Scene, Tube


def test_shown_by_their_shapes():
    V, F = np.eye(3), np.array([[0, 1, 2]])
    curve = Tube(V, V, (1.0, 0.0, 0.0))
    scene = Scene(V, F, V, tubes=(curve,), caption="A triangle.")
    assert "V=<3 × 3 float64>" in repr(scene)
    assert curve.closed
