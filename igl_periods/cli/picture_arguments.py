"""The arguments of commands that make pictures: which form, which scene."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from igl_periods.arrays import Complexes
from igl_periods.complexes import DeltaComplex
from igl_periods.differentials import Parametrization, most_even_form, parametrize
from igl_periods.errors import ComplexError
from igl_periods.meshes import MeshReport
from igl_periods.periods import PeriodMatrix, mesh_quality, reduced_if_feasible
from igl_periods.pictures import (
    BOUND,
    CHECKERBOARD,
    CUT,
    CYCLES,
    LENGTH,
    Scene,
    checkerboard_scene,
    cut_scene,
    cycles_scene,
    density_scene,
    periodic_copies,
    quadratic_scene,
    quality_scene,
    scenes_of_matrix,
    sensitivity_scene,
    surface_in_space,
)
from igl_periods.reports import method_in_words
from igl_periods.run_log import stage

from .arguments import (
    PERIOD_OPTIONS,
    Commands,
    add_memory_argument,
    add_period_arguments,
    add_surface_arguments,
    chosen_options,
    computed,
    read_surfaces,
    reading_options,
)
from .parser import Parser, refuse_without_effect

_KINDS: dict[str, str] = {
    "cycles": "the canonical cycles of the reduced marking, as tubes",
    "checkerboard": "the checkerboard of a holomorphic form, with its zeros",
    "density": "the length |ζ| of a form",
    "quality": "where the bound of the period matrix originates",
    "sensitivity": "where the period matrix is sensitive to displacements of the surface",
    "quadratic": "a quadratic differential, the square of ζ_K: --form K, or the product: K,L",
    "cut": "the cut that makes the surface a disk",
}

# What a page calls the kinds that it always shows.
_NAMES = {
    "cycles": CYCLES,
    "checkerboard": CHECKERBOARD,
    "density": LENGTH,
    "quality": BOUND,
    "cut": CUT,
}


# Kinds that show a form, and those that show nothing of the period matrix.
_OF_A_FORM, _OF_THE_MESH = ("checkerboard", "density", "quadratic"), ("quality", "cut")
_EVEN = "even"


def add_picture_command(
    commands: Commands, name: str, what: str, run: Callable[[argparse.Namespace], int]
) -> Parser:
    """Add a command about one surface and its period matrix."""
    command = commands.add_parser(name, help=what, description=f"{what[0].upper()}{what[1:]}.")
    add_surface_arguments(command)
    add_period_arguments(command)
    add_memory_argument(command)
    command.set_defaults(run=run)
    return command


def add_scene_arguments(command: Parser) -> None:
    """Add what is shown; :func:`chosen_scene` reads it."""
    command.add_argument(
        "--show",
        choices=tuple(_KINDS),
        default="cycles",
        help="; ".join(f"{kind}: {what}" for kind, what in _KINDS.items()),
    )
    add_form_argument(command)
    add_copies_argument(command)
    command.checks.append(_check_scene)


def add_copies_argument(command: Parser) -> None:
    """Add how many copies of a periodic cell are shown."""
    command.add_argument(
        "--copies",
        type=_copies,
        default=(1,),
        metavar="N | N1,…,NK",
        help="copies of the cell along each translation of --lattice (1)",
    )
    command.checks.append(_check_copies)


def _check_copies(command: Parser, options: argparse.Namespace) -> None:
    if options.lattice is None:
        refuse_without_effect(command, options, ("copies",), "without --lattice")
    elif len(options.copies) not in (1, len(options.lattice)):
        raise ValueError(
            f"--copies takes one number, or {len(options.lattice)}, one for each translation of "
            "--lattice."
        )


def add_form_argument(command: Parser) -> None:
    """Add the choice of a holomorphic form; :func:`chosen_parametrization` reads it."""
    command.add_argument(
        "--form",
        type=_form,
        default=_EVEN,
        metavar="even | K | C1,…,CG",
        help="the form of most even length (default); ζ_K of the reduced marking; or the one with "
        "these coefficients in terms of ζ_1, …, ζ_g (complex numbers such as 1+2j)",
    )


def _check_scene(command: Parser, options: argparse.Namespace) -> None:
    """Refuse what the kind of picture does not depend on."""
    if getattr(options, "output", None) and options.output.lower().endswith((".html", ".htm")):
        return  # a page shows everything
    why = f"on --show {options.show}"
    if options.show not in _OF_A_FORM:
        refuse_without_effect(command, options, ("form",), f"{why}, which shows no form")
    if options.show in _OF_THE_MESH:
        names = (*PERIOD_OPTIONS, "max_memory")
        refuse_without_effect(command, options, names, f"{why}, which shows the mesh alone")


def chosen_surface(options: argparse.Namespace) -> tuple[DeltaComplex, MeshReport | None]:
    """The surface that is meant, which has the form that is asked for, and its report."""
    (K,), report = read_surfaces(options)
    _check_form(getattr(options, "form", _EVEN), K)
    return K, report


def reduced_matrix(K: DeltaComplex, options: argparse.Namespace) -> PeriodMatrix:
    """The period matrix of a surface, Siegel reduced where that is feasible."""
    pm = computed(K, options)
    with stage("Siegel reduction"):
        reduced, _ = reduced_if_feasible(pm)
    return pm if reduced is None else reduced


def chosen_scene(options: argparse.Namespace) -> Scene:
    """What is to be shown, in all copies of a cell."""
    K, _ = chosen_surface(options)
    return periodic_copies(_scene(K, options), K.cell, options.copies)


def _scene(K: DeltaComplex, options: argparse.Namespace) -> Scene:
    surface_in_space(K)
    if K.euler_characteristic == 2 and options.show != "quality":
        raise ComplexError(
            "the surface is a sphere (genus 0): it has no cycles, no forms, and needs no cut."
        )
    if options.show == "quality":
        return _described(quality_scene(K, mesh_quality(K)), options, None)
    pm = reduced_matrix(K, options)
    if options.show == "cycles":
        return _described(cycles_scene(pm), options, pm)
    if options.show == "sensitivity":
        return _described(sensitivity_scene(pm), options, pm)
    if options.show == "quadratic":
        return _described(quadratic_scene(pm, *_pair(options.form)), options, pm)
    scenes = {"checkerboard": checkerboard_scene, "density": density_scene, "cut": cut_scene}
    scene = scenes[options.show](chosen_parametrization(pm, options.form))
    return _described(scene, options, None if options.show == "cut" else pm)


def chosen_scenes(options: argparse.Namespace) -> tuple[dict[str, Scene], str]:
    """Everything that there is to see, by name, and the name of what is asked for."""
    K, _ = chosen_surface(options)
    pm = reduced_matrix(K, options)
    # Of a quadratic differential the form is no form of the surface.
    form = _EVEN if options.show == "quadratic" else options.form
    scenes = scenes_of_matrix(pm, chosen_parametrization(pm, form) if pm.genus else None)
    first = _NAMES.get(options.show, options.show)
    if options.show == "sensitivity":
        scenes[first] = sensitivity_scene(pm)
    if options.show == "quadratic":
        scenes[first] = quadratic_scene(pm, *_pair(options.form))
    if first not in scenes:
        (first,) = scenes
    return {name: _described(scene, options, pm) for name, scene in scenes.items()}, first


def chosen_parametrization(pm: PeriodMatrix, form: str | int | Complexes) -> Parametrization:
    """The map of a surface by one of its forms."""
    if isinstance(form, int):
        return parametrize(pm, np.eye(pm.genus)[form - 1])
    return parametrize(pm, most_even_form(pm) if isinstance(form, str) else form)


def how_computed(options: argparse.Namespace, pm: PeriodMatrix | None) -> list[str]:
    """What was said about the surface and the computation that is not usual, in sentences."""
    return method_in_words(chosen_options(options) | reading_options(options), pm)


def _described(scene: Scene, options: argparse.Namespace, pm: PeriodMatrix | None) -> Scene:
    return replace(scene, caption=" ".join([scene.caption, *how_computed(options, pm)]))


def _check_form(form: str | int | Complexes, K: DeltaComplex) -> None:
    """Raise ValueError before anything is computed unless the surface has this form."""
    genus = 1 - K.euler_characteristic // 2
    if isinstance(form, int) and not 1 <= form <= genus:
        raise ValueError(f"there is no form ζ_{form}: the genus is {genus}.")
    if isinstance(form, np.ndarray) and form.shape != (genus,):
        raise ValueError(
            f"--form takes {genus} coefficients, one for each form of genus {genus}, not "
            f"{form.size}."
        )


def _copies(text: str) -> tuple[int, ...]:
    numbers = text.split(",")
    if not all(number.isdecimal() and int(number) > 0 for number in numbers):
        raise argparse.ArgumentTypeError(f"numbers of copies are 2 or 2,2,1, not {text!r}")
    return tuple(map(int, numbers))


def _pair(form: str | int | Complexes) -> tuple[int, int]:
    """The numbers k, l of ζ_kζ_l; 1, 1 where nothing is said."""
    if isinstance(form, str):
        return 1, 1
    first, second = (form, form) if isinstance(form, int) else np.resize(form.real, 2).astype(int)
    return int(first), int(second)


def _form(text: str) -> str | int | Complexes:
    if text == _EVEN or text.isdecimal():
        return int(text) if text.isdecimal() else text
    try:
        form = np.array([complex(number.replace("i", "j")) for number in text.split(",")])
        if not (np.isfinite(form).all() and form.any()):
            raise ValueError("coefficients are finite, and not all of them 0")
        return form
    except ValueError as error:
        message = f"a form is 'even', a number k, or coefficients such as 1,0.5+2j; not {text!r}"
        raise argparse.ArgumentTypeError(message) from error
