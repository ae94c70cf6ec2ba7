"""The command ``view``: it needs a display, and shows the scene."""

from pathlib import Path

import pytest

from igl_periods.errors import RenderError
from igl_periods.pictures.rendering import check_display

LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"


def test_view_needs_a_display(command, capsys):
    with pytest.raises(RenderError, match="DISPLAY is not set"):
        check_display()
    assert command("view", LAWSON) == 1
    assert "there is no display to open a window on" in capsys.readouterr().err


def test_view_shows_the_scene_in_a_window(command, monkeypatch, capsys):
    import open3d

    shown = []
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(open3d.visualization, "draw", lambda parts, **_: shown.extend(parts))
    assert command("view", LAWSON, "--show", "cut") == 0
    assert [part["name"] for part in shown] == ["surface", "marks"]
    surface, marks = (part["geometry"] for part in shown)
    assert len(surface.triangles) == 1536
    assert len(marks.triangles) > 1000
    assert "The cut that makes the surface a disk" in capsys.readouterr().out
