"""What this machine offers: memory, threads, packages.

================  ============================================================================
``memory``        how much this process can still take, and refusing what needs more
``threads``       how many threads linear algebra has, by its size and its callers; forked processes
``extras``        packages that only an extra of the installation brings
``output_files``  files that are to be written, checked before anything is computed
================  ============================================================================
"""

from .memory import available_memory, release_freed_memory, require_memory
from .threads import one_thread, threads_by_size, threads_for, without_lost_threads
from .output_files import check_output
from .extras import EXTRAS, missing_library, require

__all__ = [
    "available_memory",
    "release_freed_memory",
    "require_memory",
    "one_thread",
    "threads_for",
    "threads_by_size",
    "without_lost_threads",
    "check_output",
    "EXTRAS",
    "missing_library",
    "require",
]
