"""The rows of a batch as a Parquet file."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

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
    """Write a Parquet file, or leave everything as it is: the file is replaced when it is whole.

    Parameters
    ----------
    rows : sequence of dict
        With the keys ``COLUMNS``.
    output : Path
    """
    table = pa.Table.from_pylist(rows, schema=SCHEMA)
    with tempfile.NamedTemporaryFile(
        dir=output.parent, prefix=f".{output.name}.", delete=False
    ) as file:
        try:
            pq.write_table(table, file)
            file.flush()
            os.fsync(file.fileno())
            os.chmod(file.name, _usual_mode())
            os.replace(file.name, output)
        except BaseException:
            os.unlink(file.name)
            raise


def _usual_mode() -> int:
    """The permissions of a new file, which temporary ones do not have."""
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
