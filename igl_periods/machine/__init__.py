"""What this machine offers: memory, threads, packages.

============  =================================================================================
``memory``    how much this process can still take, and refusing what needs more
``threads``   one thread of linear algebra where callers work in parallel; forked processes
``extras``    packages that only an extra of the installation brings
============  =================================================================================
"""

from .memory import available_memory, release_freed_memory, require_memory
from .threads import one_thread, without_lost_threads
from .extras import EXTRAS, missing_library, require

__all__ = [
    "available_memory",
    "release_freed_memory",
    "require_memory",
    "one_thread",
    "without_lost_threads",
    "EXTRAS",
    "missing_library",
    "require",
]
