"""The pictures of ``capacity``: harmonic measures and slit maps of plane domains."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from scipy.sparse import csr_array

from igl_periods.arrays import Bytes
from igl_periods.complexes import DeltaComplex, split
from igl_periods.domains import (
    SlitMap,
    boundary_loops,
    circular_slit_disc,
    circular_slit_map,
    harmonic_measures,
    parallel_slit_plane,
    radial_slit_disc,
    radial_slit_map,
)
from igl_periods.errors import ComplexError
from igl_periods.machine import check_output, require

from .parser import Parser, refuse_without_effect

_KINDS = {
    "measure": "the harmonic function that is 1 on one loop and 0 on the others",
    "circular": "the map onto an annulus with circular slits",
    "radial": "the map onto an annulus with radial slits",
    "parallel": "the map onto the plane with parallel slits, a point to infinity",
    "circular-disc": "the map onto a disc with circular slits, a point to 0",
    "radial-disc": "the map onto a disc with radial slits, a point to 0",
}
_AT_A_POINT: dict[str, Callable[..., SlitMap]] = {
    "parallel": parallel_slit_plane,
    "circular-disc": circular_slit_disc,
    "radial-disc": radial_slit_disc,
}
# Triangles of a picture, at least, and the degree of what is shown.
_TRIANGLES, _DEGREE = 4000, 3


def add_domain_picture_arguments(command: Parser) -> None:
    """Add what is drawn; :func:`draw_domain` does it."""
    command.add_argument(
        "--picture", type=_picture, metavar="FILE", help="draw the domain to a PNG or JPEG file"
    )
    command.add_argument(
        "--show",
        choices=tuple(_KINDS),
        default="measure",
        help="; ".join(f"{kind}: {what}" for kind, what in _KINDS.items()),
    )
    command.add_argument(
        "--loop",
        type=int,
        default=2,
        metavar="K",
        help="the loop that is 1, or becomes the inner circle, counted from 1 (2)",
    )
    command.add_argument(
        "--point", type=_point, metavar="X,Y", help="the point that goes to infinity, or to 0"
    )
    command.checks.append(_check)


def _check(command: Parser, options: argparse.Namespace) -> None:
    if options.picture is None:
        refuse_without_effect(command, options, ("show", "loop", "point"), "without --picture")
    elif options.show in _AT_A_POINT:
        refuse_without_effect(command, options, ("loop",), f"on --show {options.show}")
        if options.point is None:
            raise ValueError(f"--show {options.show} needs --point X,Y, inside of the domain.")
    else:
        refuse_without_effect(command, options, ("point",), f"on --show {options.show}")


def claim_picture(options: argparse.Namespace) -> None:
    """Refuse a picture that cannot be written, before anything is computed."""
    if options.picture is not None:
        require("a picture of a domain", "matplotlib", "PIL")
        check_output(options.picture, options.mesh)


def draw_domain(K: DeltaComplex, options: argparse.Namespace) -> str:
    """Draw what is to be shown; returns what it is, in words."""
    from igl_periods.pictures import save

    n = len(boundary_loops(K))
    first = 1 if options.show == "measure" else 2
    if options.show not in _AT_A_POINT and not first <= options.loop <= n:
        raise ComplexError(
            f"--loop {options.loop}: there are loops {first} to {n} for this picture."
        )
    while K.n_faces < _TRIANGLES:
        K, _ = split(K, csr_array((0, K.n_edges), dtype="int64"))
    save(options.picture, _drawn(K, options))
    return f"{options.picture}: {_KINDS[options.show]}"


def _drawn(K: DeltaComplex, options: argparse.Namespace) -> Bytes:
    from igl_periods.pictures import measure_picture, slit_map_picture

    k = options.loop - 1
    if options.show == "measure":
        return measure_picture(K, harmonic_measures(K, _DEGREE)[k], boundary_loops(K))
    if options.show in _AT_A_POINT:
        return slit_map_picture(_AT_A_POINT[options.show](K, options.point, degree=_DEGREE))
    annulus = circular_slit_map if options.show == "circular" else radial_slit_map
    return slit_map_picture(annulus(K, k, degree=_DEGREE))


def _picture(text: str) -> str:
    if not text.lower().endswith((".png", ".jpg", ".jpeg")):
        raise argparse.ArgumentTypeError(f"a picture has a name in .png or .jpg, not {text!r}")
    return text


def _point(text: str) -> complex:
    try:
        x, y = (float(number) for number in text.split(","))
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"a point is X,Y, not {text!r}") from error
    return complex(x, y)
