"""The arguments of commands that make pictures: which form, which scene."""

from __future__ import annotations

import argparse
from collections.abc import Callable

import numpy as np

from igl_periods.arrays import Complexes
from igl_periods.differentials import Parametrization, most_even_form, parametrize
from igl_periods.meshes import MeshReport
from igl_periods.periods import PeriodMatrix, mesh_quality, period_matrix, reduced_if_feasible
from igl_periods.pictures import (
    Scene,
    checkerboard_scene,
    cut_scene,
    cycles_scene,
    density_scene,
    quadratic_scene,
    quality_scene,
    sensitivity_scene,
)
from igl_periods.run_log import stage

from .arguments import Commands, add_surface_arguments, read_surfaces

_KINDS: dict[str, str] = {
    "cycles": "the canonical cycles of the reduced marking, as tubes",
    "checkerboard": "the checkerboard of a holomorphic form, with its zeros",
    "density": "the length |ζ| of a form",
    "quality": "where the bound of the period matrix originates",
    "sensitivity": "where the period matrix is sensitive to displacements of the surface",
    "quadratic": "a quadratic differential, the square of ζ_K: --form K, or the product: K,L",
    "cut": "the cut that makes the surface a disk",
}


def add_picture_command(
    commands: Commands, name: str, what: str, run: Callable[[argparse.Namespace], int]
) -> argparse.ArgumentParser:
    """Add a command about one surface, with no arguments but those that say which."""
    command = commands.add_parser(name, help=what, description=f"{what[0].upper()}{what[1:]}.")
    add_surface_arguments(command)
    command.set_defaults(run=run)
    return command


def add_scene_arguments(command: argparse.ArgumentParser) -> None:
    """Add what is shown; :func:`chosen_scene` reads it."""
    command.add_argument(
        "--show",
        choices=tuple(_KINDS),
        default="cycles",
        help="; ".join(f"{kind}: {what}" for kind, what in _KINDS.items()),
    )
    add_form_argument(command)


def add_form_argument(command: argparse.ArgumentParser) -> None:
    """Add the choice of a holomorphic form; :func:`chosen_parametrization` reads it."""
    command.add_argument(
        "--form",
        type=_form,
        default="even",
        metavar="even | K | C1,…,CG",
        help="the form of most even length (default); ζ_K of the reduced marking; or the one with "
        "these coefficients in terms of ζ_1, …, ζ_g (complex numbers such as 1+2j)",
    )


def reduced_surface(options: argparse.Namespace) -> tuple[PeriodMatrix, MeshReport | None]:
    """The period matrix of the surface that is meant, and the report of its mesh.

    Siegel reduced, where that is feasible.
    """
    (K,), report = read_surfaces(options)
    pm = period_matrix(K)
    with stage("Siegel reduction"):
        reduced, _ = reduced_if_feasible(pm)
    return pm if reduced is None else reduced, report


def chosen_scene(options: argparse.Namespace) -> Scene:
    """What is to be shown."""
    pm = reduced_surface(options)[0]
    if options.show == "cycles":
        return cycles_scene(pm)
    if options.show == "quality":
        return quality_scene(pm.complex, mesh_quality(pm.complex))
    if options.show == "sensitivity":
        return sensitivity_scene(pm)
    if options.show == "quadratic":
        return quadratic_scene(pm, *_pair(options.form))
    scenes = {"checkerboard": checkerboard_scene, "density": density_scene, "cut": cut_scene}
    return scenes[options.show](chosen_parametrization(pm, options.form))


def chosen_parametrization(pm: PeriodMatrix, form: str | int | Complexes) -> Parametrization:
    """The map of a surface by one of its forms."""
    if isinstance(form, int):
        if not 1 <= form <= pm.genus:
            raise ValueError(f"there is no form ζ_{form}: the genus is {pm.genus}.")
        return parametrize(pm, np.eye(pm.genus)[form - 1])
    return parametrize(pm, most_even_form(pm) if isinstance(form, str) else form)


def _pair(form: str | int | Complexes) -> tuple[int, int]:
    """The numbers k, l of ζ_kζ_l; 1, 1 where nothing is said."""
    if isinstance(form, str):
        return 1, 1
    first, second = (form, form) if isinstance(form, int) else np.resize(form.real, 2).astype(int)
    return int(first), int(second)


def _form(text: str) -> str | int | Complexes:
    if text == "even" or text.isdigit():
        return int(text) if text.isdigit() else text
    try:
        return np.array([complex(number.replace("i", "j")) for number in text.split(",")])
    except ValueError as error:
        message = f"a form is 'even', a number k, or coefficients such as 1,0.5+2j; not {text!r}"
        raise argparse.ArgumentTypeError(message) from error
