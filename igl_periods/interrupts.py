"""Ctrl-C in the command ``igl-periods``: one line and exit code 130, from the first moment on.

Most of a short command is the import of what it needs, and nothing of the command can catch an
interrupt before it has been imported itself.  So this is the first module that the package imports.
In every other program it does nothing: how that is interrupted is its own affair.
"""

from __future__ import annotations

import itertools
import os
import signal
import sys
import threading
from types import FrameType

INTERRUPTED = 130
_LINE = b"igl-periods: interrupted.\n"


def is_command(arguments: list[str]) -> bool:
    """Whether a process that was started so is the command.

    Examples
    --------
    >>> is_command(["python", "/usr/bin/igl-periods", "compute"])
    True
    >>> is_command(["python", "-X", "dev", "-m", "igl_periods", "compute"])
    True
    >>> is_command(["python", "-m", "igl_periods.distributed"]), is_command(["python"])
    (False, False)
    """
    if os.path.basename("".join(arguments[1:2])) == "igl-periods":
        return True
    return ("-m", "igl_periods") in itertools.pairwise(arguments)


def end_quietly_while_importing() -> None:
    """If this process is the command, let Ctrl-C end it with one line: nothing is lost yet."""
    if (
        is_command(sys.orig_argv)
        and threading.current_thread() is threading.main_thread()
        and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    ):
        signal.signal(signal.SIGINT, _end)


def interrupt_as_usual() -> None:
    """From now on Ctrl-C raises KeyboardInterrupt again, so that what was begun is tidied up."""
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _end(number: int, frame: FrameType | None) -> None:
    os.write(2, _LINE)
    os._exit(INTERRUPTED)
