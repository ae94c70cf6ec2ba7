"""Everything that there is to see: on one surface, in space or in the plane."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.pictures.all_scenes import (
    BOUND,
    CHECKERBOARD,
    CUT,
    CYCLES,
    LENGTH,
    PLAIN,
    scenes_of_complex,
    scenes_of_matrix,
    sheet_of_form,
)
from igl_periods.surfaces import flat_torus

SPHERE = ip.DeltaComplex.from_mesh(
    [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
)


def test_scenes_show_one_surface(torus):
    scenes = scenes_of_matrix(torus)
    assert list(scenes) == [CYCLES, CHECKERBOARD, LENGTH, BOUND, CUT]
    for scene in scenes.values():
        assert np.array_equal(scene.V, scenes[CUT].V)
        assert np.array_equal(scene.F, scenes[CUT].F)
    (plain,) = scenes_of_complex(torus.complex).values()
    assert np.array_equal(plain.V, scenes[CUT].V)


def test_flat_surfaces_lie_in_the_plane_as_they_are():
    tau = 0.2 + 1.1j
    K = flat_torus(tau, 4)
    pm = ip.period_matrix(K)
    scenes = scenes_of_matrix(pm)
    V, F = scenes[CUT].V, scenes[CUT].F
    assert not V[:, 2].any()
    # Developed isometrically, up to one scale.
    sides = np.linalg.norm(np.roll(V[F], -1, axis=1) - np.roll(V[F], 1, axis=1), axis=2)
    ratio = sides / K.lengths
    assert np.ptp(ratio) < 1e-9 * ratio.mean()
    # Both sides of the cut are drawn, and closed walks in pieces of it.
    P = ip.parametrize(pm, [1.0])
    assert len(scenes[CUT].tubes) == 2 * len(P.seams)
    assert not any(curve.closed for curve in scenes[CYCLES].tubes)
    steps = sum(len(curve.points) - 1 for curve in scenes[CYCLES].tubes)
    assert steps == 8
    (plain,) = scenes_of_complex(K).values()
    assert len(plain.F) == K.n_faces
    assert sheet_of_form(P).unfolded


def test_spheres_are_plain(torus):
    assert list(scenes_of_matrix(ip.period_matrix(SPHERE))) == [PLAIN]
    assert list(scenes_of_complex(SPHERE)) == [PLAIN]
    assert not sheet_of_form(ip.parametrize(torus, [1.0])).unfolded


def test_what_lies_nowhere_is_refused():
    abstract = ip.DeltaComplex.from_lengths(np.ones((4, 3)), SPHERE.corner_vertex)
    for scenes in (
        lambda: scenes_of_complex(abstract),
        lambda: scenes_of_matrix(ip.period_matrix(abstract)),
    ):
        with pytest.raises(ip.ComplexError, match="no positions in space"):
            scenes()
    V = np.concatenate([SPHERE.positions, SPHERE.positions], axis=1)
    with pytest.raises(ip.ComplexError, match=r"lies in R\^6"):
        scenes_of_complex(ip.DeltaComplex.from_mesh(V, SPHERE.corner_vertex))
