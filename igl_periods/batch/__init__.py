"""Many meshes: one row for each of their components, in a Parquet file.

    files ─ workers ▶ rows ─ journal ▶ results.parquet

Files are computed by the processes of a cluster (:mod:`igl_periods.batch.cluster`), which read them
by their paths.  Rows are kept in a journal beside the output as they arrive
(:mod:`igl_periods.batch.journal`), so that a run which was interrupted, by whatever, goes on where
it stopped; when all files have their rows, they are written in the order of the files
(:mod:`igl_periods.batch.table`).  What a row holds depends on nothing but the file and the options
(:mod:`igl_periods.batch.rows`), however many workers there are.
"""

from igl_periods.errors import BatchError

from igl_periods.machine import require

require("a batch", "dask", "distributed", "pyarrow")

from .files import find_files
from .rows import BatchOptions, rows_of
from .cluster import local_cluster, remote_cluster
from .run import BatchResult, run_batch

__all__ = [
    "BatchError",
    "find_files",
    "BatchOptions",
    "rows_of",
    "local_cluster",
    "remote_cluster",
    "BatchResult",
    "run_batch",
]
