"""Rendering: what is drawn, and what cannot be."""

import numpy as np
import pytest
from PIL import Image
from support.random_surfaces import torus_of_revolution
from support.rendered_pictures import SIZE, count_near, is_drawn

import igl_periods as ip
from igl_periods.errors import RenderError
from igl_periods.pictures import rendering
from igl_periods.pictures.rendering import render, save, with_legend
from igl_periods.pictures.scene import Scene
from igl_periods.pictures.scenes import (
    cycle_colour,
    cycles_scene,
    plain_scene,
)
from igl_periods.pictures.sheets import surface_in_space
from igl_periods.surfaces import flat_torus


def test_the_surface_fills_the_picture_and_is_seen_from_the_right_side():
    V, F = torus_of_revolution(2.0, 0.7, 40, 20)
    marked = Scene(V, F, np.full(V.shape, 0.8), balls=((np.array([[0, 0, 0.9]]), 0.1, (1, 0, 0)),))
    for direction in ((0, 0, 1), (1, 0, 0)):
        drawn = is_drawn(render(marked, (300, 200), direction))
        rows, columns = np.flatnonzero(drawn.any(axis=1)), np.flatnonzero(drawn.any(axis=0))
        height, width = np.ptp(rows) + 1, np.ptp(columns) + 1
        assert max(height / 200, width / 300) > 0.85
        assert rows[0] > 0
        assert rows[-1] < 199
        assert columns[0] > 0
        assert columns[-1] < 299
    hidden = Scene(
        V, F, np.full(V.shape, 0.8), balls=((np.array([[2.0, 0, 0.8]]), 0.1, (1, 0, 0)),)
    )
    above, below = (render(hidden, (300, 200), (0, 0, z)) for z in (1.0, -1.0))
    assert count_near(above, (1, 0, 0)) > 100
    assert count_near(below, (1, 0, 0)) < 0.2 * count_near(above, (1, 0, 0))


def test_legend_and_files(torus, tmp_path):
    scene = cycles_scene(torus)
    picture = np.full((240, 320, 3), 255, dtype=np.uint8)
    labelled = with_legend(picture, scene)
    for k in range(2):
        exact = np.rint(255 * np.array(cycle_colour(k, 2)) - 0.5)
        assert np.count_nonzero((np.abs(labelled - exact) <= 1).all(axis=2)) >= 100
    assert np.array_equal(labelled[:200], picture[:200])
    save(tmp_path / "a.png", labelled)
    assert np.array_equal(np.asarray(Image.open(tmp_path / "a.png")), labelled)


def test_nothing_is_said_while_drawing(torus, capfd):
    render(plain_scene(torus.complex), (40, 30))
    assert capfd.readouterr() == ("", "")


def test_the_background_is_white_and_pictures_are_repeatable(torus):
    scene = cycles_scene(torus)
    picture = render(scene, SIZE)
    assert np.array_equal(picture, render(scene, SIZE))
    # Nothing is drawn beyond the silhouette, and everything there is exactly white.
    rows, columns = np.nonzero((picture < 255).any(axis=2))
    assert min(rows.min(), columns.min()) > 0
    assert rows.max() < SIZE[1] - 1
    assert columns.max() < SIZE[0] - 1
    assert 0.2 < (picture == 255).all(axis=2).mean() < 0.8


def test_nothing_on_the_surface_is_as_white_as_the_background(torus):
    # A surface of one colour, dark, smooth, and lit from one side has no spots.
    V, F = surface_in_space(torus.complex)
    dark = Scene(V, F, np.full(V.shape, 0.3), balls=((V[:1], 0.02, (0.1, 0.1, 0.1)),))
    picture = render(dark, SIZE, (0, 0, 1))
    inside = is_drawn(picture)
    inside &= np.roll(inside, 2, 0) & np.roll(inside, -2, 0)
    inside &= np.roll(inside, 2, 1) & np.roll(inside, -2, 1)
    assert inside.mean() > 0.2
    assert picture[inside].max() < 200


def test_the_nearer_of_two_parts_is_seen(torus):
    # A ball in the hole, where one looks down the axis; from the side the torus is before it.
    V, F = surface_in_space(torus.complex)
    red = (1, 0, 0)
    ball = Scene(V, F, np.full(V.shape, 0.8), balls=((np.zeros((1, 3)), 0.05, red),))
    above, aside = render(ball, SIZE, (0, 0, 1)), render(ball, SIZE, (1, 0, 0))
    assert count_near(above, red) > 100
    assert count_near(aside, red) == 0


def test_what_cannot_be_drawn_is_refused(torus):
    scene = plain_scene(torus.complex)
    for size in ((0, 10), (10, 5000)):
        with pytest.raises(ValueError, match="both must be between 1 and 4096"):
            render(scene, size)
    for direction in ((0, 0, 0), (1, 2), (np.nan, 0, 1)):
        with pytest.raises(ValueError, match="a direction is three numbers"):
            render(scene, SIZE, direction)
    with pytest.raises(ip.ComplexError, match="no positions in space"):
        plain_scene(flat_torus(1j, 3))
    V, F = torus_of_revolution(2.0, 0.7, 8, 5)
    K = ip.DeltaComplex.from_mesh(np.concatenate([V, V], axis=1), F)
    with pytest.raises(ip.ComplexError, match="lies in R\\^6"):
        surface_in_space(K)


@pytest.mark.parametrize(
    ("program", "message"),
    [
        ("import time; time.sleep(600)", "has not drawn the picture in .* s, and was ended"),
        (
            "import os; os.write(2, b'no driver\\n\\n'); os.abort()",
            "ended while drawing, by SIGABRT. The last that it said: no driver$",
        ),
        ("raise SystemExit(3)", "ended while drawing, with exit code 3. .*said: nothing$"),
    ],
)
def test_open3d_may_hang_or_abort(torus, monkeypatch, program, message):
    monkeypatch.setattr(rendering, "_PROGRAM", program)
    monkeypatch.setattr(rendering, "_START", 0.5)
    with pytest.raises(RenderError, match=message):
        render(plain_scene(torus.complex), (4, 3))
