"""The command ``texture``: a mesh with conformal texture coordinates in a file."""

from __future__ import annotations

import argparse
from pathlib import Path

from igl_periods.machine import require
from igl_periods.reports import parametrization_in_words

from .arguments import Commands
from .picture_arguments import (
    add_form_argument,
    add_picture_command,
    chosen_parametrization,
    reduced_surface,
)
from .terminal import say


def add_texture(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    texture = add_picture_command(
        commands, "texture", "export a conformally textured mesh", _texture
    )
    texture.add_argument("-o", "--output", required=True, metavar="FILE", help="an OBJ or GLB file")
    texture.add_argument(
        "--scale", type=float, help="texture coordinates are this times z = ∫ζ; default: automatic"
    )
    add_form_argument(texture)


def _texture(options: argparse.Namespace) -> int:
    from igl_periods.pictures import write_glb, write_obj

    require("a texture", "PIL")
    writers = {".obj": write_obj, ".glb": write_glb}
    suffix = Path(options.output).suffix.lower()
    if suffix not in writers:
        raise ValueError(f"a textured mesh is an OBJ or GLB file; {options.output} is neither.")
    P = chosen_parametrization(reduced_surface(options)[0], options.form)
    files = writers[suffix](options.output, P, options.scale)
    say(f"wrote {', '.join(str(file) for file in files)}")
    say("\n".join(parametrization_in_words(P)))
    return 0
