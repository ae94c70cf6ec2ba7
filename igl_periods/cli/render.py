"""The command ``render``: a picture of a mesh in a file."""

from __future__ import annotations

import argparse
from pathlib import Path

from igl_periods.errors import RenderError
from igl_periods.machine import require

from .arguments import Commands
from .picture_arguments import add_picture_command, add_scene_arguments, chosen_scene
from .terminal import refused, say


def add_render(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    render = add_picture_command(commands, "render", "draw a picture of a mesh to a file", _render)
    render.add_argument("-o", "--output", required=True, metavar="FILE", help="a PNG or JPEG file")
    render.add_argument(
        "--size", type=_size, default=(1200, 900), metavar="WxH", help="default: 1200x900"
    )
    render.add_argument(
        "--direction", type=_direction, metavar="X,Y,Z", help="from the surface to the eye"
    )
    add_scene_arguments(render)


def _render(options: argparse.Namespace) -> int:
    from igl_periods.pictures import render, save, with_legend

    require("drawing", "open3d", "PIL")
    suffix = Path(options.output).suffix.lower()
    if suffix not in (".png", ".jpg", ".jpeg"):
        raise ValueError(f"a picture is a PNG or JPEG file; {options.output} is neither.")
    scene = chosen_scene(options)
    try:
        save(options.output, with_legend(render(scene, options.size, options.direction), scene))
    except RenderError as error:
        return refused(error)
    say(f"{options.output}: {scene.caption}")
    return 0


def _size(text: str) -> tuple[int, int]:
    width, times, height = text.lower().partition("x")
    if not (times and width.isdigit() and height.isdigit()):
        raise argparse.ArgumentTypeError(f"a size is WIDTHxHEIGHT, such as 1200x900, not {text!r}")
    return int(width), int(height)


def _direction(text: str) -> tuple[float, ...]:
    try:
        x, y, z = (float(number) for number in text.split(","))
    except ValueError as error:
        message = f"a direction is three numbers X,Y,Z, not {text!r}"
        raise argparse.ArgumentTypeError(message) from error
    return x, y, z
