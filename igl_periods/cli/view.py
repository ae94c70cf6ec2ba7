"""The command ``view``: a mesh in a window, or on a page where it can be turned."""

from __future__ import annotations

import argparse
from pathlib import Path

from igl_periods.errors import RenderError
from igl_periods.machine import require

from .arguments import Commands, add_output_argument, claim
from .picture_arguments import (
    add_picture_command,
    add_scene_arguments,
    chosen_scene,
    chosen_scenes,
)
from .terminal import refused, say

_SIZE = (900, 640)


def add_view(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    view = add_picture_command(
        commands, "view", "show a mesh in a window, or write a page where it can be turned", _view
    )
    add_output_argument(view, "an HTML page, instead of a window", ".html", ".htm", required=False)
    add_scene_arguments(view)


def _view(options: argparse.Namespace) -> int:
    if options.output is not None:
        return _write_page(options)
    from igl_periods.pictures import check_display, show

    require("drawing", "open3d")
    try:
        check_display()
        scene = chosen_scene(options)
        say(scene.caption)
        show(scene, title=Path(options.mesh).name)
    except RenderError as error:
        return refused(error)
    return 0


def _write_page(options: argparse.Namespace) -> int:
    """A page with all that there is to see, at first what is asked for."""
    from igl_periods.pictures import render, viewer_of_scenes, with_legend

    require("a surface to turn", "k3d", "PIL")
    claim(options)
    scenes, first = chosen_scenes(options)
    picture = None
    try:
        picture = with_legend(render(scenes[first], _SIZE), scenes[first])
    except RenderError as error:
        say(f"the page has no picture for browsers that cannot draw: {error}")
    viewer = viewer_of_scenes(scenes, title=Path(options.mesh).name, picture=picture, first=first)
    viewer.save(options.output)
    say(f"wrote {options.output}")
    return 0
