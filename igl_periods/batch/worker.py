"""What a worker of a cluster does: the rows of one file, one file at a time.

The precision of ball arithmetic and the filters of warnings belong to the whole process, so that
two files must never be computed at once in it, however many threads the worker has.
"""

from __future__ import annotations

import threading

from .rows import BatchOptions, Row, rows_of

_alone = threading.Lock()


def compute_file(path: str, name: str, options: BatchOptions) -> list[Row]:
    """:func:`rows_of`, waiting until this process computes nothing else."""
    with _alone:
        return rows_of(path, options, name)
