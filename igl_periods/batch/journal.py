"""The journal of a batch: finished files, one a line, so that an interrupted run can go on.

A line is appended when the rows of a file arrive, and is on the disk before anything else happens
(fsync).  Whatever ends a run, power failure included, can damage no more than the line that was
being written; damaged lines at the end are cut off when the journal is opened again, and their
files computed anew.  Of several lines about the same file the last one counts.

Floating-point numbers survive: JSON has their shortest decimal form, which leads back to the same
bits.
"""

from __future__ import annotations

import fcntl
import json
import os
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import IO

from .rows import Row

_HEADER = b'{"igl_periods": "journal of a batch", "schema": 1}\n'


class Journal:
    """Rows of finished files, kept in a file.

    Parameters
    ----------
    path : Path
        The file; it is made if there is none.
    restart : bool
        Forget what is in it.

    Raises
    ------
    FileExistsError
        If the file is something else than a journal.
    BlockingIOError
        If another run has it open.
    OSError
        If it cannot be read and written.
    """

    def __init__(self, path: Path, restart: bool = False) -> None:
        self.path = path
        self.rows: dict[str, list[Row]] = {}
        self._file: IO[bytes] = open(path, "a+b")  # noqa: SIM115 - open as long as the journal
        try:
            self._lock()
            self._read(restart)
        except BaseException:
            self._file.close()
            raise

    def append(self, finished: Sequence[tuple[str, list[Row]]]) -> None:
        """Add the rows of files; they are safe when this returns."""
        if not finished:
            return
        for name, rows in finished:
            self.rows[name] = rows
            self._file.write(json.dumps([name, rows]).encode() + b"\n")
        _flush(self._file)

    def __enter__(self) -> Journal:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._file.close()

    def _lock(self) -> None:
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise BlockingIOError(
                f"another run is writing {str(self.path)!r}: wait for it, or choose another output."
            ) from error

    def _read(self, restart: bool) -> None:
        """Read all whole lines, and cut off what follows the last one."""
        self._file.seek(0)
        first = self._file.readline()
        if first != _HEADER and not _HEADER.startswith(first):
            raise FileExistsError(
                f"{str(self.path)!r} is not a journal of a batch: move it away, or choose another "
                "output."
            )
        whole = len(first) if first == _HEADER and not restart else 0
        if whole:
            for line in self._file:
                if not self._read_line(line):
                    break
                whole += len(line)
        self._file.truncate(whole)
        if not whole:
            self._file.write(_HEADER)
        _flush(self._file)
        _flush_folder(self.path.parent)

    def _read_line(self, line: bytes) -> bool:
        try:
            name, rows = json.loads(line)
            rows[0]["hash"]
        except (ValueError, TypeError, LookupError):
            return False
        if not line.endswith(b"\n"):
            return False
        self.rows[name] = rows
        return True


def _flush(file: IO[bytes]) -> None:
    file.flush()
    os.fsync(file.fileno())


def _flush_folder(folder: Path) -> None:
    """Make the name of a new file safe: it is kept in its folder."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
