"""How much memory this process can still take."""

from __future__ import annotations

import ctypes
import re
import resource
import sys
from collections.abc import Iterator
from pathlib import Path

import psutil

from igl_periods.errors import MemoryLimitError

_CGROUP = Path("/sys/fs/cgroup")
_MEMBERSHIP = Path("/proc/self/cgroup")


def available_memory() -> float:
    """Bytes that this process can still take: of the machine, its control group and its limit."""
    room = [float(psutil.virtual_memory().available), *_control_groups()]
    soft, _ = resource.getrlimit(resource.RLIMIT_AS)
    if soft != resource.RLIM_INFINITY:
        room.append(float(soft - psutil.Process().memory_info().vms))
    return max(min(room), 0.0)


def _control_groups() -> Iterator[float]:
    """What is left of the limit of each control group that this process is in, outermost last.

    Containers, services and batch systems set such limits (Linux, versions 1 and 2).  Pages of
    files that nobody uses count as used there, and are given back when memory is short.
    """
    for line in _text(_MEMBERSHIP).splitlines():
        _, controllers, path = line.split(":", 2)
        if controllers == "":
            root, limit, used = _CGROUP, "memory.max", "memory.current"
        elif "memory" in controllers.split(","):
            root, limit, used = _CGROUP / "memory", "memory.limit_in_bytes", "memory.usage_in_bytes"
        else:
            continue
        group = root / path.lstrip("/")
        # A container may see its own group as the root, under the path that it has outside.
        for folder in (group, *group.parents):
            if not folder.is_relative_to(root):
                break
            most, taken = _text(folder / limit), _text(folder / used)
            if most.strip().isdigit() and taken.strip().isdigit():
                statistics = _text(folder / "memory.stat")
                idle = re.findall(r"^(?:total_)?inactive_file (\d+)$", statistics, re.MULTILINE)
                yield float(most) - float(taken) + max(map(float, idle), default=0.0)


def _text(path: Path) -> str:
    """The content of a file, empty where it cannot be read."""
    try:
        return path.read_text()
    except OSError:
        return ""


def require_memory(needed: float, what: str, limit: float | None) -> float:
    """The limit, or what is available where there is none; raises if less than ``needed``."""
    available = available_memory()
    allowed = available if limit is None else limit
    if needed > min(allowed, available):
        of = "are available" if needed > available else "are allowed"
        raise MemoryLimitError(
            f"{what} about {_gigabytes(needed)}, and {_gigabytes(min(allowed, available))} {of}. "
            "Simplify the mesh, or use a machine with more memory; one that is too large for any "
            "can be divided among several (igl_periods.distributed)."
        )
    return allowed


def _gigabytes(size: float) -> str:
    return f"{size / 1e9:.3g} GB"


def release_freed_memory() -> None:
    """Give memory that was freed back to the system, where the C library is GNU's.

    It keeps freed blocks of some megabytes, all over its heap: hundreds of megabytes after arrays
    of millions of faces, which the factor cannot use.
    """
    if sys.platform == "linux":
        trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
        if trim is not None:
            trim(0)
