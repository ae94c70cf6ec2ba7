"""The command ``igl-periods``: parse, call, print.

Exit codes: 0 the matrix was computed, 1 the mesh was refused, 2 wrong usage, 130 interrupted.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import os
import sys
import warnings
from collections.abc import Sequence

from igl_periods.errors import MissingExtraError, PeriodsError

from .batch import add_batch
from .compute import add_compute
from .demo import add_demo
from .identify import add_identify
from .render import add_render
from .report import add_report
from .terminal import refused, show_stages
from .texture import add_texture
from .view import add_view

# In the order in which they are listed.
_COMMANDS = (
    add_demo,
    add_compute,
    add_identify,
    add_render,
    add_view,
    add_texture,
    add_report,
    add_batch,
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit code."""
    options = _parser().parse_args(arguments)
    if sys.stderr.isatty() and not getattr(options, "quiet", False):
        show_stages()
    try:
        with warnings.catch_warnings(record=True) as caught:
            code = int(options.run(options))
        for warning in caught:
            print(f"igl-periods: warning: {warning.message}", file=sys.stderr)
        return code
    except BrokenPipeError:
        # Whoever reads the output has had enough, as ``head`` does.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (OSError, MissingExtraError) as error:
        return refused(str(error))
    except (ValueError, PeriodsError) as error:
        message, mesh = str(error), getattr(options, "mesh", "")
        return refused(message if mesh in message else f"{mesh}: {message}")


def _parser() -> argparse.ArgumentParser:
    version = importlib.metadata.version("igl_periods")
    parser = argparse.ArgumentParser(
        prog="igl-periods",
        description="Period matrices of triangle meshes, with certified error bounds.",
        epilog="Exit codes: 0 done, 1 the mesh was refused, 2 wrong usage.",
    )
    parser.add_argument("--version", action="version", version=f"igl-periods {version}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for add in _COMMANDS:
        add(commands)
    return parser
