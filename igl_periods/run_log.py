"""Stage names, elapsed times and progress, through :mod:`logging`.

Every step of a computation reports itself to the logger ``igl_periods`` at level INFO: when it
starts, a few times a second while it runs if it is long, and when it is done.  The command line
shows these records on a terminal; the library itself never prints.

Three kinds of records, told apart by their attributes:

========  =======  =========================================
stage     seconds  the stage has started (None), or is done
progress  done     how far a part of it has come
          total    … of how many, or None if it is not known
========  =======  =========================================
"""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager

logger = logging.getLogger("igl_periods")
# Seconds between two reports of progress.
_INTERVAL = 0.2


@contextmanager
def stage(name: str) -> Iterator[None]:
    """Log that a stage starts, and how long it took; ``record.seconds`` is None, then the time."""
    logger.info("%s …", name, extra={"stage": name, "seconds": None})
    start = time.perf_counter()
    _clock.last = start
    try:
        yield
    except Exception:
        logger.info("%s failed", name)
        raise
    seconds = time.perf_counter() - start
    logger.info("%s: %.2f s", name, seconds, extra={"stage": name, "seconds": seconds})


def progress(name: str, done: int, total: int | None = None) -> None:
    """Log how far something long has come, unless that was done a moment ago.

    It costs a look at the clock, so it may be called in inner loops.

    Parameters
    ----------
    name : str
        What is counted, in the plural or as an activity.
    done : int
    total : int, optional
        The count at which it is finished, where that is known.
    """
    now = time.perf_counter()
    if now - _clock.last < _INTERVAL or not logger.isEnabledFor(logging.INFO):
        return
    _clock.last = now
    count = f"{done:,}" if total is None else f"{done:,} of {total:,}"
    logger.info("%s: %s", name, count, extra={"progress": name, "done": done, "total": total})


class _Clock:
    """When progress was last reported; one for all, as the logger is."""

    last = float("-inf")


_clock = _Clock()
