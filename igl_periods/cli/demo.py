"""The command ``demo``: a surface for a first try."""

from __future__ import annotations

import argparse
import shlex

from igl_periods.meshes import SAMPLES, sample_files

from .arguments import Commands
from .terminal import say


def add_demo(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    demo = commands.add_parser(
        "demo",
        help="the period matrix of a surface that comes with the package",
        description="Compute the period matrix of a surface that comes with the package, and say "
        "how: it is a file, like any other.",
    )
    demo.add_argument(
        "surface",
        nargs="?",
        choices=tuple(SAMPLES),
        default="lawson_2_1",
        metavar="NAME",
        help="; ".join(f"{name}: {what}" for name, (_, what) in SAMPLES.items()),
    )
    demo.add_argument("--quiet", action="store_true", help="no progress on the terminal")
    demo.set_defaults(run=_demo, commands=commands)


def _demo(options: argparse.Namespace) -> int:
    file, what = str(sample_files()[options.surface]), SAMPLES[options.surface][1]
    say(f"{what[0].upper()}{what[1:]}: igl-periods compute {shlex.quote(file)}\n")
    chosen = options.commands.choices["compute"].parse_args([file])
    return int(chosen.run(chosen))
