"""The command ``view``: it needs a display, and shows the scene."""

from pathlib import Path

import pytest

from igl_periods.errors import RenderError
from igl_periods.pictures import rendering
from igl_periods.pictures.rendering import check_display

LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"


def test_view_needs_a_display(command, capsys):
    with pytest.raises(RenderError, match="DISPLAY is not set"):
        check_display()
    assert command("view", LAWSON) == 1
    assert "there is no display to open a window on" in capsys.readouterr().err


def test_view_shows_the_scene_in_a_window(command, monkeypatch, capsys):
    shown = []
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(rendering, "_run_open3d", lambda folder, task, seconds: shown.extend(task))
    assert command("view", LAWSON, "--show", "cut") == 0
    task, scene, title = shown
    assert (task, title) == ("show", "lawson_2_1.off")
    assert len(scene.F) == 1536
    assert len(scene.tubes) > 0
    assert "The cut that makes the surface a disk" in capsys.readouterr().out
