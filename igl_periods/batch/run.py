"""A batch from its files to its table, going on where an earlier run stopped."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from contextlib import AbstractContextManager, closing, nullcontext
from dataclasses import dataclass
from importlib.metadata import version
from os import PathLike
from pathlib import Path

from dask.system import CPU_COUNT
from distributed import Client

from igl_periods.display import facts_html
from igl_periods.machine import check_output

from .cluster import local_cluster, outcomes
from .journal import Journal
from .rows import DIED, BatchOptions, Row, file_hash, refused_row
from .table import write_rows


@dataclass(frozen=True, repr=False)
class BatchResult:
    """What a batch did.

    Attributes
    ----------
    rows : list of dict
        All rows of the output, in its order.
    computed, kept : int
        How many files were computed, and of how many the rows were there.
    """

    rows: list[Row]
    computed: int
    kept: int

    def __repr__(self) -> str:
        return f"BatchResult({', '.join(f'{value} {name}' for name, value in self._facts())})"

    def _repr_html_(self) -> str:
        return facts_html("BatchResult", self._facts())

    def _facts(self) -> list[tuple[str, int]]:
        counts = len(self.rows), self.computed, self.kept, len(self.refused)
        return list(zip(("rows", "files computed", "files kept", "rows refused"), counts))

    @property
    def refused(self) -> list[Row]:
        """The rows with an error."""
        return [row for row in self.rows if row["error"] is not None]

    @property
    def deadly(self) -> list[str]:
        """The files on which workers died."""
        return [row["file"] for row in self.rows if row["error_kind"] == DIED]


def run_batch(
    files: Mapping[str, str | PathLike[str]],
    output: str | PathLike[str],
    options: BatchOptions | None = None,
    *,
    client: Client | None = None,
    workers: int | None = None,
    restart: bool = False,
    retry: bool = False,
    progress: Callable[[int, int, int], None] | None = None,
) -> BatchResult:
    """Compute the rows of many files, and write them to a Parquet or CSV file.

    The journal ``<output>.journal`` keeps the rows of finished files.  They are used again as long
    as the bytes of the file, the options and the version of the library are the same.

    Parameters
    ----------
    files : mapping of str to path-like
        The paths, as workers see them, by the names that the rows shall have:
        :func:`find_files`.
    output : path-like
        A table in the form that its suffix says, ``.parquet`` or ``.csv``.
    options : BatchOptions, optional
    client : distributed.Client, optional
        The cluster to use; default: processes on this machine, for the time of the call.  A script
        that is not to be run by these processes too does so under
        ``if __name__ == "__main__":``.
    workers : int, optional
        How many processes, if there is no client; default: the number of cores.
    restart : bool
        Forget the journal.
    retry : bool
        Compute files anew that have a row with an error or a warning: memory may have been short.
    progress : callable, optional
        Called as ``progress(done, refused, total)``, which count files.

    Returns
    -------
    BatchResult

    Raises
    ------
    BatchError
        If the cluster is lost.  What was finished is in the journal.
    OSError
        If the journal or the output cannot be written, or another run is writing them.

    Examples
    --------
    A hundred meshes on the cores of this machine::

        run_batch(find_files("meshes"), "results.parquet", BatchOptions(tolerance=1e-6))
    """
    options, place = options or BatchOptions(), Path(output).absolute()
    check_output(place, *files.values())
    paths = {name: Path(path) for name, path in files.items()}
    with Journal(place.with_name(f"{place.name}.journal"), restart) as journal:
        done = {
            name: journal.rows[name]
            for name, path in paths.items()
            if name in journal.rows and _is_current(journal.rows[name], path, options, retry)
        }
        pending = {name: path for name, path in paths.items() if name not in done}
        refused = sum(map(_is_refused, done.values()))
        tell = progress or _silent
        tell(len(done), refused, len(paths))
        with closing(_computed(pending, options, client, workers)) as stream:
            for finished in stream:
                journal.append(finished)
                done.update(finished)
                refused += sum(_is_refused(rows) for _, rows in finished)
                tell(len(done), refused, len(paths))
        rows = [row for name in paths for row in done[name]]
        write_rows(rows, place)
    return BatchResult(rows, len(pending), len(paths) - len(pending))


def _silent(done: int, refused: int, total: int) -> None:
    """Report no progress."""


def _is_current(rows: list[Row], path: Path, options: BatchOptions, retry: bool) -> bool:
    """Whether the rows of a file are what would be computed now."""
    if retry and (_is_refused(rows) or any(row["warning"] is not None for row in rows)):
        return False
    first = rows[0]
    if (first["options"], first["version"]) != (options.as_json(), version("igl_periods")):
        return False
    return bool(first["hash"] == file_hash(path))


def _is_refused(rows: list[Row]) -> bool:
    return any(row["error"] is not None for row in rows)


def _computed(
    files: dict[str, Path], options: BatchOptions, client: Client | None, workers: int | None
) -> Generator[list[tuple[str, list[Row]]]]:
    """The rows of files as they arrive.  What kills workers is tried again alone at the end."""
    if not files:
        return
    suspects: dict[str, int] = {}
    with (
        _cluster(client, workers or CPU_COUNT) as cluster,
        closing(outcomes(cluster, files, options)) as stream,
    ):
        for arrived in stream:
            suspects |= {name: outcome for name, outcome in arrived if isinstance(outcome, int)}
            yield [(name, rows) for name, rows in arrived if not isinstance(rows, int)]
    if not suspects:
        return
    with _cluster(client, 1) as cluster:
        for name, deaths in suspects.items():
            yield [(name, _alone(cluster, name, files[name], options, deaths))]


def _alone(client: Client, name: str, path: Path, options: BatchOptions, deaths: int) -> list[Row]:
    """The rows of a file on which workers have died, computed with no other beside it."""
    ((_, outcome),) = next(outcomes(client, {name: path}, options))
    if not isinstance(outcome, int):
        return outcome
    error = (
        f"the worker died {deaths + outcome} times, in the end with no other file beside it: the "
        "memory does not suffice, or a library crashed."
    )
    return [refused_row(name, path, options, error=error, error_kind=DIED)]


def _cluster(client: Client | None, workers: int) -> AbstractContextManager[Client]:
    return local_cluster(workers) if client is None else nullcontext(client)
