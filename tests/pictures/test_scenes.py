"""Scenes: what they contain."""

from pathlib import Path

import numpy as np
import pytest
from support.random_surfaces import torus_of_revolution
from support.rendered_pictures import SIZE, count_near, is_drawn

import igl_periods as ip
from igl_periods.complexes.doubling import double
from igl_periods.differentials.even_form import most_even_form
from igl_periods.differentials.parametrization import parametrize
from igl_periods.periods.quality import mesh_quality
from igl_periods.pictures.rendering import render
from igl_periods.pictures.scene import Scene
from igl_periods.pictures.scenes import (
    checkerboard,
    checkerboard_scene,
    cut_scene,
    cycles_scene,
    density_scene,
    plain_scene,
    quality_scene,
)
from igl_periods.pictures.sheets import surface_in_space

LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"


@pytest.fixture(scope="module")
def lawson():
    V, F, _ = ip.load_mesh(LAWSON)
    return ip.period_matrix(V, F).reduced()


def test_cycles_are_seen_in_their_colours(torus):
    scene = cycles_scene(torus)
    picture = render(scene, SIZE, direction=(0.3, -0.2, 1.0))
    assert picture.shape == (180, 240, 3)
    assert picture.dtype == np.uint8
    assert 0.3 < is_drawn(picture).mean() < 0.9
    assert np.array_equal(picture[0, 0], [255, 255, 255])
    assert [name for name, _ in scene.legend] == ["a1", "b1"]
    without = render(plain_scene(torus.complex), SIZE, direction=(0.3, -0.2, 1.0))
    for _, colour in scene.legend:
        assert count_near(picture, colour) > 40
        assert count_near(without, colour) == 0


def test_checkerboard_shows_squares_and_zeros(lawson):
    P = parametrize(lawson, most_even_form(lawson))
    scene = checkerboard_scene(P)
    picture = render(scene, SIZE)
    # Lit or in the shade, dark squares are blue and pale ones are grey.
    pixels = picture[is_drawn(picture)].astype(float)
    blue = pixels[:, 2] > 1.5 * pixels[:, 0]
    grey = np.abs(pixels[:, 2] - pixels[:, 0]) < 25
    assert 0.3 < blue.mean() / (blue.mean() + grey.mean()) < 0.7
    assert blue.mean() + grey.mean() > 0.6
    zeros, _, colour = scene.balls[0]
    assert len(zeros) == np.count_nonzero(P.index > 0)
    with_zeros = Scene(scene.V, scene.F, scene.colours, balls=((scene.V[:1], 0.05, colour),))
    direction = scene.V[0] - scene.V.mean(axis=0)
    assert count_near(render(with_zeros, SIZE, direction), colour) > 20


def test_one_period_of_the_checkerboard():
    board = checkerboard(8)
    assert np.array_equal(board[:4, :4], board[4:, 4:])
    assert np.array_equal(board[:4, 4:], board[4:, :4])
    assert (board[0, 0] != board[0, 7]).all()


def test_density_is_light_where_the_form_is_large(torus):
    # |ζ| is inversely proportional to the distance from the axis.
    scene = density_scene(parametrize(torus, [1.0]))
    distance = np.hypot(scene.V[:, 0], scene.V[:, 1])
    lightness = scene.colours.sum(axis=1)
    assert np.corrcoef(lightness, distance)[0, 1] < -0.9
    low, high = (float(name) for name, _ in (scene.legend[0], scene.legend[-1]))
    assert high / low == pytest.approx(2.7 / 1.3, rel=0.05)
    pixels = render(scene, SIZE, (1, 0, 1)).reshape(-1, 3).astype(int)
    red, green, blue = pixels[is_drawn(pixels[None])[0]].T
    yellow, violet = (np.minimum(red, green) > 2 * blue), (np.minimum(red, blue) > green + 20)
    assert 0.02 < yellow.mean() < 0.5
    assert 0.02 < violet.mean() < 0.5


def test_quality_is_light_where_the_bound_originates(lawson):
    quality = mesh_quality(lawson.complex)
    scene = quality_scene(lawson.complex, quality)
    worst = np.argsort(quality.vertex_excess)[-10:]
    assert scene.colours[worst].sum(axis=1).mean() > scene.colours.sum(axis=1).mean() + 0.2
    drawn = is_drawn(render(scene, SIZE))
    plain = is_drawn(render(plain_scene(lawson.complex), SIZE))
    assert np.mean(drawn != plain) < 0.01
    assert 0.2 < drawn.mean() < 0.9


def test_the_cut_is_seen(lawson):
    P = parametrize(lawson, [1.0, 0.0])
    scene = cut_scene(P)
    assert len(scene.tubes) == P.seams.size
    assert count_near(render(scene, SIZE), scene.tubes[0].colour) > 100


def test_of_a_double_only_one_sheet_is_shown():
    V, F = torus_of_revolution(2.0, 0.7, 20, 10)
    K = double(ip.DeltaComplex.from_mesh(V, np.delete(F, [0, 1, 200], axis=0)))
    pm = ip.period_matrix(K).reduced()
    for scene in (
        cycles_scene(pm),
        cut_scene(parametrize(pm, np.eye(pm.genus)[0])),
        checkerboard_scene(parametrize(pm, np.eye(pm.genus)[0])),
    ):
        assert len(scene.F) == K.n_faces // 2
        normals = np.concatenate([curve.normals for curve in scene.tubes] or [np.zeros((0, 3))])
        assert np.isfinite(normals).all()
        if scene.corner_uv is not None:
            assert len(scene.corner_uv) == len(scene.F)
    assert 0.3 < is_drawn(render(plain_scene(K), SIZE)).mean() < 0.9


def test_plane_surfaces_lie_in_space():
    K = ip.DeltaComplex.from_mesh([[0.0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    V, _ = surface_in_space(K)
    assert V.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
