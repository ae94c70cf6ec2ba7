"""The command ``view``: a mesh in a window."""

from __future__ import annotations

import argparse
from pathlib import Path

from igl_periods.errors import RenderError
from igl_periods.machine import require

from .arguments import Commands
from .picture_arguments import add_picture_command, add_scene_arguments, chosen_scene
from .terminal import refused, say


def add_view(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    add_scene_arguments(add_picture_command(commands, "view", "show a mesh in a window", _view))


def _view(options: argparse.Namespace) -> int:
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
