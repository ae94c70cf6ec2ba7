"""The commands that make pictures: ``render``, ``view``, ``texture`` and ``report``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .cli_surface import add_surface_arguments, read_surfaces
from .errors import RenderError
from .extras import require
from .form_choice import most_even_form
from .mesh import MeshReport
from .parametrization import Parametrization, in_words, parametrize
from .periods import PeriodMatrix
from .pipeline import period_matrix
from .quality import mesh_quality
from .scenes import (
    Scene,
    checkerboard_scene,
    cut_scene,
    cycles_scene,
    density_scene,
    quality_scene,
)
from .siegel import SIEGEL_GENUS_LIMIT
from .stages import stage

Complexes = NDArray[np.complex128]

_KINDS: dict[str, str] = {
    "cycles": "the canonical cycles of the reduced marking, as tubes",
    "checkerboard": "the checkerboard of a holomorphic form, with its zeros",
    "density": "the length |ζ| of a form",
    "quality": "where the bound of the period matrix originates",
    "cut": "the cut that makes the surface a disk",
}


def add_commands(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the commands to the parser of ``igl-periods``; each sets the default ``run``."""
    render = _command(commands, "render", "draw a picture of a mesh to a file", _render)
    render.add_argument("-o", "--output", required=True, metavar="FILE", help="a PNG or JPEG file")
    render.add_argument(
        "--size", type=_size, default=(1200, 900), metavar="WxH", help="default: 1200x900"
    )
    render.add_argument(
        "--direction", type=_direction, metavar="X,Y,Z", help="from the surface to the eye"
    )
    view = _command(commands, "view", "show a mesh in a window", _view)
    for command in (render, view):
        command.add_argument(
            "--show",
            choices=tuple(_KINDS),
            default="cycles",
            help="; ".join(f"{kind}: {what}" for kind, what in _KINDS.items()),
        )
        _add_form(command)
    texture = _command(commands, "texture", "export a conformally textured mesh", _texture)
    texture.add_argument("-o", "--output", required=True, metavar="FILE", help="an OBJ or GLB file")
    texture.add_argument(
        "--scale", type=float, help="texture coordinates are this times z = ∫ζ; default: automatic"
    )
    _add_form(texture)
    report = _command(commands, "report", "write a page about a mesh", _report)
    report.add_argument("-o", "--output", required=True, metavar="FILE", help="an HTML file")


def _command(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    what: str,
    run: Callable[[argparse.Namespace], int],
) -> argparse.ArgumentParser:
    command = commands.add_parser(name, help=what, description=f"{what[0].upper()}{what[1:]}.")
    add_surface_arguments(command)
    command.set_defaults(run=run)
    return command


def _add_form(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--form",
        type=_form,
        default="even",
        metavar="even | K | C1,…,CG",
        help="the form of most even length (default); ζ_K of the reduced marking; or the one with "
        "these coefficients in terms of ζ_1, …, ζ_g (complex numbers such as 1+2j)",
    )


def _reduced(options: argparse.Namespace) -> tuple[PeriodMatrix, MeshReport | None]:
    """The period matrix of the surface that is meant, and the report of its mesh.

    Siegel reduced, unless its genus is so large that this takes long.
    """
    (K,), report = read_surfaces(options)
    pm = period_matrix(K)
    if pm.genus > SIEGEL_GENUS_LIMIT:
        return pm, report
    with stage("Siegel reduction"):
        return pm.reduced(), report


def _scene(options: argparse.Namespace) -> Scene:
    pm = _reduced(options)[0]
    if options.show == "cycles":
        return cycles_scene(pm)
    if options.show == "quality":
        return quality_scene(pm.complex, mesh_quality(pm.complex))
    scenes = {"checkerboard": checkerboard_scene, "density": density_scene, "cut": cut_scene}
    return scenes[options.show](_parametrization(pm, options.form))


def _parametrization(pm: PeriodMatrix, form: str | int | Complexes) -> Parametrization:
    if isinstance(form, int):
        if not 1 <= form <= pm.genus:
            raise ValueError(f"there is no form ζ_{form}: the genus is {pm.genus}.")
        return parametrize(pm, np.eye(pm.genus)[form - 1])
    return parametrize(pm, most_even_form(pm) if isinstance(form, str) else form)


def _render(options: argparse.Namespace) -> int:
    from .render import render, save, with_legend

    require("drawing", "open3d", "PIL")
    suffix = Path(options.output).suffix.lower()
    if suffix not in (".png", ".jpg", ".jpeg"):
        raise ValueError(f"a picture is a PNG or JPEG file; {options.output} is neither.")
    scene = _scene(options)
    try:
        save(options.output, with_legend(render(scene, options.size, options.direction), scene))
    except RenderError as error:
        return _failed(error)
    _say(f"{options.output}: {scene.caption}")
    return 0


def _view(options: argparse.Namespace) -> int:
    from .render import check_display, show

    require("drawing", "open3d")
    try:
        check_display()
        scene = _scene(options)
        _say(scene.caption)
        show(scene, title=Path(options.mesh).name)
    except RenderError as error:
        return _failed(error)
    return 0


def _texture(options: argparse.Namespace) -> int:
    from .uv_export import write_glb, write_obj

    require("a texture", "PIL")
    writers = {".obj": write_obj, ".glb": write_glb}
    suffix = Path(options.output).suffix.lower()
    if suffix not in writers:
        raise ValueError(f"a textured mesh is an OBJ or GLB file; {options.output} is neither.")
    P = _parametrization(_reduced(options)[0], options.form)
    files = writers[suffix](options.output, P, options.scale)
    _say(f"wrote {', '.join(str(file) for file in files)}")
    _say("\n".join(in_words(P)))
    return 0


def _report(options: argparse.Namespace) -> int:
    from .report import write_report

    require("a report", "matplotlib", "open3d", "PIL")
    pm, mesh = _reduced(options)
    write_report(options.output, pm, name=Path(options.mesh).name, mesh=mesh)
    _say(f"wrote {options.output}")
    return 0


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")


def _failed(error: Exception) -> int:
    sys.stderr.write(f"igl-periods: {error}\n")
    return 1


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


def _form(text: str) -> str | int | Complexes:
    if text == "even" or text.isdigit():
        return int(text) if text.isdigit() else text
    try:
        return np.array([complex(number.replace("i", "j")) for number in text.split(",")])
    except ValueError as error:
        message = f"a form is 'even', a number k, or coefficients such as 1,0.5+2j; not {text!r}"
        raise argparse.ArgumentTypeError(message) from error
