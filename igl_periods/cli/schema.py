"""The command ``schema``: what the JSON documents of the other commands look like."""

from __future__ import annotations

import argparse
import json

from igl_periods.reports import json_schema

from .arguments import Commands
from .terminal import say


def add_schema(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``."""
    schema = commands.add_parser(
        "schema",
        help="what JSON documents look like, as JSON Schema",
        description="Print what the documents of compute --json and identify --json look like, in "
        "the language of JSON Schema (draft 2020-12).",
    )
    schema.set_defaults(run=_schema)


def _schema(options: argparse.Namespace) -> int:
    say(json.dumps(json_schema(), indent=1, ensure_ascii=True))
    return 0
