"""The command ``demo``: a surface for a first try."""

from __future__ import annotations

import argparse
import shlex
import sys

from .samples import SAMPLES, sample_files


def add_demo_command(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    compute: argparse.ArgumentParser,
) -> None:
    """Add the command to the parser of ``igl-periods``, after ``compute``, which it calls."""
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
    demo.set_defaults(run=_demo, compute=compute)


def _demo(options: argparse.Namespace) -> int:
    file = str(sample_files()[options.surface])
    what = SAMPLES[options.surface][1]
    sys.stdout.write(f"{what[0].upper()}{what[1:]}: igl-periods compute {shlex.quote(file)}\n\n")
    chosen = options.compute.parse_args([file])
    return int(chosen.run(chosen))
