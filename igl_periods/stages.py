"""Stage names and elapsed times, through :mod:`logging`.

Every step of a computation reports itself to the logger ``igl_periods`` at level INFO, when it
starts and when it is done; the command line shows these lines on a terminal.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager

logger = logging.getLogger("igl_periods")


@contextmanager
def stage(name: str) -> Iterator[None]:
    """Log that a stage starts, and how long it took; ``record.seconds`` is None, then the time."""
    logger.info("%s …", name, extra={"stage": name, "seconds": None})
    start = time.perf_counter()
    try:
        yield
    except BaseException:
        logger.info("%s failed", name)
        raise
    seconds = time.perf_counter() - start
    logger.info("%s: %.2f s", name, seconds, extra={"stage": name, "seconds": seconds})
