"""The command ``report``: a page about a mesh."""

from __future__ import annotations

import argparse
from pathlib import Path

from igl_periods.machine import require

from .arguments import Commands
from .picture_arguments import add_picture_command, reduced_surface
from .terminal import say


def add_report(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    report = add_picture_command(commands, "report", "write a page about a mesh", _report)
    report.add_argument("-o", "--output", required=True, metavar="FILE", help="an HTML file")


def _report(options: argparse.Namespace) -> int:
    from igl_periods.reports import write_report

    require("a report", "matplotlib", "open3d", "PIL")
    pm, mesh = reduced_surface(options)
    write_report(options.output, pm, name=Path(options.mesh).name, mesh=mesh)
    say(f"wrote {options.output}")
    return 0
