"""The command ``igl-periods``: parse, call, print.

Exit codes: 0 done, 1 a mesh was refused, 2 wrong usage, 130 interrupted.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import os
import sys
from collections.abc import Sequence

from igl_periods.errors import MissingExtraError, PeriodsError
from igl_periods.interrupts import INTERRUPTED, interrupt_as_usual
from igl_periods.machine import require

from .batch import add_batch
from .capacity import add_capacity
from .compute import add_compute
from .curve import add_curve
from .demo import add_demo
from .enclose import add_enclose
from .identify import add_identify
from .parser import Parser
from .render import add_render
from .report import add_report
from .schema import add_schema
from .terminal import about, refused, show_stages, warnings_told, write_readably
from .texture import add_texture
from .view import add_view

# In the order in which they are listed.
_COMMANDS = (
    add_demo,
    add_compute,
    add_enclose,
    add_identify,
    add_curve,
    add_capacity,
    add_render,
    add_view,
    add_texture,
    add_report,
    add_batch,
    add_schema,
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit code."""
    try:
        interrupt_as_usual()
        return _run(arguments)
    except KeyboardInterrupt:
        return refused("interrupted.", INTERRUPTED)


def _run(arguments: Sequence[str] | None) -> int:
    parser = _parser()
    _complete(parser)
    write_readably()
    options = parser.parse_args(arguments)
    if sys.stderr.isatty() and not getattr(options, "quiet", False):
        show_stages()
    try:
        with warnings_told():
            return int(options.run(options))
    except BrokenPipeError:
        # Whoever reads the output has had enough, as ``head`` does.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (OSError, MissingExtraError) as error:
        return refused(str(error))
    except (ValueError, PeriodsError) as error:
        return refused(about(getattr(options, "mesh", ""), error))


def _complete(parser: argparse.ArgumentParser) -> None:
    """Answer a shell that asks how the command line goes on, and exit."""
    if "_ARGCOMPLETE" in os.environ:
        require("completion", "argcomplete")
        import argcomplete

        argcomplete.autocomplete(parser)


def _parser() -> Parser:
    version = importlib.metadata.version("igl_periods")
    parser = Parser(
        prog="igl-periods",
        description="Period matrices of triangle meshes, with certified error bounds.",
        epilog="Exit codes: 0 done, 1 a mesh was refused, 2 wrong usage, 130 interrupted.",
    )
    parser.add_argument("--version", action="version", version=f"igl-periods {version}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for add in _COMMANDS:
        add(commands)
    return parser
