"""The command ``texture``: a mesh with conformal texture coordinates in a file."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from igl_periods.machine import require
from igl_periods.reports import parametrization_in_words

from .arguments import Commands, add_output_argument, claim
from .picture_arguments import (
    add_copies_argument,
    add_form_argument,
    add_picture_command,
    chosen_parametrization,
    chosen_surface,
    how_computed,
    reduced_matrix,
)
from .terminal import say


def add_texture(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    texture = add_picture_command(
        commands, "texture", "export a conformally textured mesh", _texture
    )
    add_output_argument(texture, "a textured OBJ or GLB mesh", ".obj", ".glb")
    texture.add_argument(
        "--scale", type=_scale, help="texture coordinates are this times z = ∫ζ; default: automatic"
    )
    add_form_argument(texture)
    add_copies_argument(texture)


def _texture(options: argparse.Namespace) -> int:
    from igl_periods.pictures import surface_in_space, write_glb, write_obj

    require("a texture", "PIL")
    writers = {".obj": write_obj, ".glb": write_glb}
    suffix = Path(options.output).suffix.lower()
    claim(options, *((".mtl", ".png") if suffix == ".obj" else ()))
    K, _ = chosen_surface(options)
    surface_in_space(K)
    pm = reduced_matrix(K, options)
    P = chosen_parametrization(pm, options.form)
    files = writers[suffix](options.output, P, options.scale, options.copies)
    say(f"wrote {', '.join(str(file) for file in files)}")
    say("\n".join(parametrization_in_words(P) + how_computed(options, pm)))
    return 0


def _scale(text: str) -> float:
    value = float(text)
    if not math.isfinite(value) or value == 0.0:
        raise argparse.ArgumentTypeError(f"a scale is a number other than 0, not {text}")
    return value
