"""The command ``view``: it needs a display, and shows the scene."""

import json
import re
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


def test_view_writes_a_page_without_a_display(command, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("igl_periods.cli.view._SIZE", (40, 30))
    page = tmp_path / "page.html"
    options = ("--show", "density", "--form", "2")
    assert command("view", LAWSON, "-o", page, *options) == 0
    assert capsys.readouterr().out == f"wrote {page}\n"
    text = page.read_text(encoding="utf-8")
    known = json.loads(re.search(r'id="layers">(.*?)</script>', text, re.DOTALL)[1])
    assert known["colourings"][known["first"]]["name"] == "length |ζ|"
    assert '<img src="data:image/png;base64,' in text
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        command("view", LAWSON, "-o", tmp_path / "nowhere" / "page.html")


@pytest.mark.parametrize("kind", ["quadratic", "sensitivity"])
def test_pages_of_derivatives_where_nothing_draws(
    command, torus, tmp_path, monkeypatch, capsys, kind
):
    def render(*_):
        raise RenderError("no driver")

    monkeypatch.setattr("igl_periods.pictures.render", render)
    assert command("view", torus, "-o", tmp_path / "page.html", "--show", kind) == 0
    assert "no picture for browsers that cannot draw: no driver" in capsys.readouterr().out
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    known = json.loads(re.search(r'id="layers">(.*?)</script>', text, re.DOTALL)[1])
    assert known["colourings"][known["first"]]["name"] == kind


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
