"""What appears on the terminal: results, refusals, and stages while they run."""

from __future__ import annotations

import logging
import sys

from igl_periods.run_log import logger


def say(text: str) -> None:
    """Print a result."""
    print(text, flush=True)


def refused(why: object, code: int = 1) -> int:
    """Print why something was not done; returns the exit code."""
    print(f"igl-periods: {why}", file=sys.stderr, flush=True)
    return code


def show_stages() -> None:
    """Show each stage on the terminal while it runs, and its time when it is done."""
    handler = logging.StreamHandler(sys.stderr)
    handler.terminator = ""
    handler.setFormatter(_StageFormatter())
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)


class _StageFormatter(logging.Formatter):
    """One line for each stage, written over while it runs."""

    def __init__(self) -> None:
        super().__init__()
        self._stage = ""

    def format(self, record: logging.LogRecord) -> str:
        # Back to the start of the line, and clear what is left of a longer one.
        line = "\r\x1b[K  "
        if hasattr(record, "progress"):
            return f"{line}{self._stage} … {record.getMessage()}"
        if not hasattr(record, "stage"):
            return f"{line}{record.getMessage()}\n"
        self._stage, seconds = record.stage, getattr(record, "seconds", None)
        if seconds is None:
            return f"{line}{self._stage} …"
        return f"{line}{self._stage:<20} {seconds:8.2f} s\n"
