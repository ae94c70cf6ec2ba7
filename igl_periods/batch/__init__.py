"""Many meshes: one row for each of their components, in a Parquet file.

    files ─ workers ▶ rows ─ journal ▶ results.parquet

Files are computed by the processes of a cluster (:mod:`igl_periods.batch.cluster`), which read them
by their paths.  Rows are kept in a journal beside the output as they arrive
(:mod:`igl_periods.batch.journal`), so that a run which was interrupted, by whatever, goes on where
it stopped; when all files have their rows, they are written in the order of the files
(:mod:`igl_periods.batch.table`).  What a row holds depends on nothing but the file and the options
(:mod:`igl_periods.batch.rows`), however many workers there are.
"""

from igl_periods.errors import BatchError as BatchError

from .cluster import local_cluster as local_cluster
from .cluster import remote_cluster as remote_cluster
from .files import find_files as find_files
from .rows import BatchOptions as BatchOptions
from .rows import rows_of as rows_of
from .run import BatchResult as BatchResult
from .run import run_batch as run_batch
