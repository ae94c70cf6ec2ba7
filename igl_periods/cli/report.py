"""The command ``report``: a page about a mesh."""

from __future__ import annotations

import argparse
from pathlib import Path

from igl_periods.machine import require

from .arguments import (
    Commands,
    add_output_argument,
    chosen_options,
    claim,
    reading_options,
)
from .picture_arguments import (
    add_copies_argument,
    add_picture_command,
    chosen_surface,
    how_computed,
    reduced_matrix,
)
from .terminal import say


def add_report(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    report = add_picture_command(commands, "report", "write a page about a mesh", _report)
    add_output_argument(report, "an HTML page", ".html", ".htm")
    add_copies_argument(report)
    report.add_argument(
        "--interactive",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="have a surface to turn on the page (default)",
    )


def _report(options: argparse.Namespace) -> int:
    from igl_periods.reports import write_report

    require("a report", *(["k3d"] if options.interactive else []), "matplotlib", "open3d", "PIL")
    claim(options)
    K, mesh = chosen_surface(options)
    pm = reduced_matrix(K, options)
    remarks = how_computed(options, pm)
    write_report(
        options.output,
        pm,
        name=Path(options.mesh).name,
        mesh=mesh,
        remarks=remarks,
        options=chosen_options(options) | reading_options(options),
        copies=options.copies,
        interactive=options.interactive,
    )
    say(f"wrote {options.output}")
    return 0
