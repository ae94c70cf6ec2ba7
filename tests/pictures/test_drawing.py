"""What the process that draws does: it loads Open3D, and hands it the parts of a scene."""

import builtins

import numpy as np
import pytest

from igl_periods.errors import RenderError
from igl_periods.pictures import cycles_scene
from igl_periods.pictures.drawing import geometries, load_open3d, show


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        ("libX11.so.6: cannot open shared object file", "libX11.so.6 is missing.*libx11-6"),
        ("libusb-1.0.so.0: cannot open shared object", "libusb-1.0.so.0 is missing.*libusb-1.0-0"),
        ("libidn2.so.0: cannot open shared object file", "libidn2.so.0 is missing.*libidn2-0"),
        ("libunheard.so.3: cannot open", r"libunheard.so.3 is missing\."),
        ("no symbol", "cannot start: no symbol"),
    ],
)
def test_what_open3d_lacks_is_named(monkeypatch, message, expected):
    original = builtins.__import__

    def broken(name, *arguments, **options):
        if name == "open3d":
            raise OSError(message)
        return original(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", broken)
    with pytest.raises(RenderError, match=expected):
        load_open3d()


def test_a_scene_has_a_surface_and_its_marks(torus):
    scene = cycles_scene(torus)
    (surface, mesh, _), (marks, tubes, _) = geometries(load_open3d(), scene)
    assert (surface, marks) == ("surface", "marks")
    assert np.array_equal(np.asarray(mesh.triangles), scene.F)
    assert np.array_equal(np.asarray(mesh.vertices), scene.V)
    # Closed tubes: as many faces as a torus has, and outward normals.
    assert len(tubes.triangles) == 2 * len(tubes.vertices)


def test_a_window_gets_all_parts(torus, monkeypatch):
    o3d, shown = load_open3d(), {}
    monkeypatch.setattr(
        o3d.visualization, "draw", lambda parts, **how: shown.update(how, parts=parts)
    )
    show(cycles_scene(torus), "a torus")
    assert shown["title"] == "a torus"
    assert [part["name"] for part in shown["parts"]] == ["surface", "marks"]
