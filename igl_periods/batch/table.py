"""The rows of a batch as a Parquet or a CSV file.

In CSV a list is written as JSON, a number with all digits that lead back to the same bits, and None
as nothing; lines end as the system ends them, and the encoding is UTF-8.
"""

from __future__ import annotations

import csv
import io
import json
import os
import tempfile
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import IO, Any

import pyarrow as pa
import pyarrow.parquet as pq

from .rows import COLUMNS, Row

_TYPES = {
    str: pa.string(),
    int: pa.int64(),
    float: pa.float64(),
    bool: pa.bool_(),
    list[float]: pa.list_(pa.float64()),
}
SCHEMA = pa.schema(
    [pa.field(name, _TYPES[kind], nullable=name != "file") for name, kind in COLUMNS.items()],
    metadata={"igl_periods.version": version("igl_periods"), "igl_periods.schema": "1"},
)


def write_rows(rows: Sequence[Row], output: Path) -> None:
    """Write a table, or leave everything as it is: the file is replaced when it is whole.

    Parameters
    ----------
    rows : sequence of dict
        With the keys ``COLUMNS``.
    output : Path
        ``.csv``; a Parquet file has any other suffix.
    """
    write = _write_csv if output.suffix.lower() == ".csv" else _write_parquet
    with tempfile.NamedTemporaryFile(
        dir=output.parent, prefix=f".{output.name}.", delete=False
    ) as file:
        try:
            write(rows, file)
            file.flush()
            os.fsync(file.fileno())
            os.chmod(file.name, _usual_mode())
            os.replace(file.name, output)
        except BaseException:
            os.unlink(file.name)
            raise


def _write_parquet(rows: Sequence[Row], file: IO[bytes]) -> None:
    pq.write_table(pa.Table.from_pylist(rows, schema=SCHEMA), file)


def _write_csv(rows: Sequence[Row], file: IO[bytes]) -> None:
    text = io.TextIOWrapper(file, encoding="utf-8", newline="")
    table = csv.writer(text, lineterminator=os.linesep)
    table.writerow(COLUMNS)
    table.writerows([_cell(row.get(name)) for name in COLUMNS] for row in rows)
    text.detach()


def _cell(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, list) else value


def _usual_mode() -> int:
    """The permissions of a new file, which temporary ones do not have."""
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
