"""Rendering: what is drawn, and what cannot be."""

import builtins
import ctypes

import numpy as np
import pytest
from PIL import Image
from support.random_surfaces import torus_of_revolution
from support.rendered_pictures import SIZE, count_near, is_drawn

import igl_periods as ip
from igl_periods.errors import RenderError
from igl_periods.pictures.rendering import render, save, with_legend
from igl_periods.pictures.scenes import (
    Scene,
    cycle_colour,
    cycles_scene,
    plain_scene,
    surface_in_space,
)
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
    ("message", "expected"),
    [
        ("libX11.so.6: cannot open shared object file", "libX11.so.6 is missing.*libx11-6"),
        ("libusb-1.0.so.0: cannot open shared object", "libusb-1.0.so.0 is missing.*libusb-1.0-0"),
        ("libunheard.so.3: cannot open", r"libunheard.so.3 is missing\."),
        ("No module named 'open3d'", "pip install open3d"),
    ],
)
def test_what_open3d_lacks_is_named(torus, monkeypatch, message, expected):
    original = builtins.__import__

    def broken(name, *arguments, **options):
        if name == "open3d":
            raise (ImportError if "module" in message else OSError)(message)
        return original(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", broken)
    with pytest.raises(RenderError, match=expected):
        render(plain_scene(torus.complex), SIZE)


def test_missing_egl_is_named(torus, monkeypatch):
    scene = plain_scene(torus.complex)

    class NoDriver:
        def __init__(self, name):
            self.eglGetPlatformDisplay = self.eglGetDisplay = Refusing()
            self.eglInitialize = Refusing()

    class Refusing:
        restype = None

        def __call__(self, *arguments):
            return 0

    monkeypatch.setattr(ctypes, "CDLL", NoDriver)
    with pytest.raises(RenderError, match=r"EGL finds no driver.*libegl-mesa0"):
        render(scene, SIZE)

    def missing(name):
        raise OSError(f"{name}: cannot open shared object file")

    monkeypatch.setattr(ctypes, "CDLL", missing)
    with pytest.raises(RenderError, match=r"libEGL.so.1 is missing.*libegl1"):
        render(scene, SIZE)
