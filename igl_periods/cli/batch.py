"""The command ``batch``: many meshes, one table."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias

from igl_periods.display import counted
from igl_periods.interrupts import INTERRUPTED
from igl_periods.machine import require

from .arguments import (
    Commands,
    add_double_argument,
    add_memory_argument,
    add_output_argument,
    add_period_arguments,
    add_reading_arguments,
    chosen_options,
    memory_limit,
    repair_options,
)
from .terminal import refused, say

if TYPE_CHECKING:
    from igl_periods.batch import BatchOptions, BatchResult

_Row: TypeAlias = "dict[str, Any]"
# Refused files that are named, of each kind of error.
_NAMED = 10


def add_batch(commands: Commands) -> None:
    """Add the command to the parser of ``igl-periods``; it sets the default ``run``."""
    batch = commands.add_parser(
        "batch",
        help="a table of the period matrices of many meshes",
        description="Compute the period matrices of many meshes, on several processes or on a "
        "Dask cluster, and write a Parquet or CSV file with a row for each component. A mesh that "
        "is refused has a row that says why. An interrupted run is continued by the same command.",
        epilog="Exit codes: 0 every file has its rows, 1 the files, the output or the cluster "
        "cannot be used, 2 wrong usage, 130 interrupted.",
    )
    batch.add_argument(
        "meshes",
        nargs="+",
        metavar="DIR | LIST | MESH",
        help="a folder, searched for meshes and gluings with all folders in it; a text file with "
        "a path on each line, relative to its own folder; or a mesh",
    )
    add_output_argument(batch, "a table", ".parquet", ".csv")
    add_reading_arguments(batch)
    add_double_argument(batch)
    add_period_arguments(batch)
    add_memory_argument(batch)
    where = batch.add_mutually_exclusive_group()
    where.add_argument(
        "--workers",
        type=_positive,
        metavar="N",
        help="processes on this machine, with one thread each (default: one for each core)",
    )
    where.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="use a Dask cluster that runs; its workers read the files by their paths",
    )
    again = batch.add_mutually_exclusive_group()
    again.add_argument(
        "--retry",
        action="store_true",
        help="compute files anew that were refused, or missed the tolerance, in a former run",
    )
    again.add_argument("--restart", action="store_true", help="compute all files anew")
    batch.set_defaults(run=_batch)


def _batch(options: argparse.Namespace) -> int:
    # Dask and Arrow take a second to import, which no other command shall wait for.
    from igl_periods.batch import BatchOptions
    from igl_periods.errors import BatchError

    chosen = BatchOptions(
        **repair_options(options),
        double=options.double,
        **chosen_options(options),
        max_memory=memory_limit(options),
    )
    try:
        result = _run(options, chosen)
    except BatchError as error:
        return refused(error)
    except KeyboardInterrupt:
        return refused(
            f"interrupted. What was finished is kept in {options.output}.journal: the same command "
            "goes on from there" + (", without --restart." if options.restart else "."),
            INTERRUPTED,
        )
    say("\n".join(_in_words(options.output, result)))
    return 0


def _run(options: argparse.Namespace, chosen: BatchOptions) -> BatchResult:
    from igl_periods.batch import find_files, remote_cluster, run_batch

    files = find_files(*options.meshes)
    cluster = remote_cluster(options.scheduler) if options.scheduler else nullcontext(None)
    with cluster as client, _progress(options.quiet) as progress:
        return run_batch(
            files,
            options.output,
            chosen,
            client=client,
            workers=options.workers,
            restart=options.restart,
            retry=options.retry,
            progress=progress,
        )


@contextmanager
def _progress(quiet: bool) -> Iterator[Callable[[int, int, int], None]]:
    """A bar on the terminal, and on nothing else, from the first call on."""
    require("a batch", "tqdm")
    from tqdm import tqdm

    with ExitStack() as stack:
        bar: tqdm[NoReturn] | None = None

        def show(done: int, refused: int, total: int) -> None:
            nonlocal bar
            if bar is None:
                silent = True if quiet else None
                bar = tqdm(total=total, initial=done, unit="file", leave=False, disable=silent)
                stack.enter_context(bar)
            bar.set_postfix(refused=refused, refresh=False)
            bar.update(done - bar.n)

        yield show


def _in_words(output: str, result: BatchResult) -> list[str]:
    files = counted(result.computed + result.kept, "file", "files")
    rows = counted(len(result.rows), "row", "rows")
    if result.computed:
        what = f"{result.computed} computed now, {result.kept} kept from before"
    else:
        what = "nothing to do: no file has changed"
    lines = [f"{output}: {rows} of {files} ({what})"]
    lines += _refusals_in_words(result.refused)
    if dead := result.deadly:
        lines.append(f"  workers died on {', '.join(dead)}: try fewer --workers, with --retry")
    return lines


def _refusals_in_words(refused: Sequence[_Row]) -> list[str]:
    """How many files were refused for which kind of reason, and the first of each with why."""
    if not refused:
        return []
    kinds: dict[str, dict[str, _Row]] = {}
    for row in refused:
        kinds.setdefault(row["error_kind"], {}).setdefault(row["file"], row)
    files = counted(len({row["file"] for row in refused}), "file", "files")
    rows = counted(len(refused), "row", "rows")
    lines = [f"  {files} with {rows} without a period matrix (the column 'error' says why):"]
    for kind, first in sorted(kinds.items(), key=lambda item: -len(item[1])):
        lines.append(f"  {len(first)} {kind}")
        lines += [f"    {name}: {_why(row)}" for name, row in list(first.items())[:_NAMED]]
        if len(first) > _NAMED:
            lines.append(f"    … and {len(first) - _NAMED} more")
    return lines


def _why(row: _Row) -> str:
    """The first sentence of an error."""
    which = f"component {row['component']}: " if row["component"] else ""
    return which + str(row["error"]).split("\n")[0].partition(". ")[0].rstrip(".")


def _positive(text: str) -> int:
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"a number of processes is at least 1, not {text!r}")
    return int(text)
