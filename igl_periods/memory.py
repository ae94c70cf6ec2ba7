r"""How much memory a computation takes, and how much there is.

Most of it is the Cholesky factor.  On n vertices of a surface of genus g, ordered by minimum
degree, it has about

.. math:: n\, (6 \log_2 n + 4 \sqrt g)

entries: the first part is that of planar meshes, whose separators have of the order of √n vertices,
the second that of handles, which separators have to cut.  Measured on marching cubes surfaces
(half of it), subdivided surfaces (all of it), thickened lattices and sponges up to genus 1,500
(between); CHOLMOD takes 12 bytes an entry with its own lists and fronts.

The other parts are the arrays of the complex, 400 bytes a face while edges are flipped and 240
afterwards, a dozen dense matrices of 2g rows and columns, the gradients on a block of faces, 5,000
numbers a form, and the functions of the forms: these are held in panels
(:mod:`igl_periods.harmonic_energies`), and take what is left.

Estimates are there to refuse what cannot work before it is begun, since a process that takes more
memory than there is gets killed without a word.
"""

from __future__ import annotations

import ctypes
import re
import resource
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import psutil

from .delta_complex import DeltaComplex
from .errors import MemoryLimitError

_BYTES_A_FACE_FLIPPING = 400.0
_BYTES_A_FACE = 240.0
_BYTES_AN_ENTRY = 12.0
_DENSE_MATRICES = 12.0
_GRADIENTS_A_FORM = 5_000.0
_FEWEST_COLUMNS = 64
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


def room_for_forms(K: DeltaComplex, limit: float | None = None) -> float:
    """Bytes left for the functions of harmonic forms of degree 1.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
    limit : float, optional
        Bytes that everything may take; by default what is available.

    Raises
    ------
    MemoryLimitError
        If the rest needs more, or so much that not even a few functions have room.
    """
    n, m, rank = K.n_vertices, K.n_faces, 2 - K.euler_characteristic
    handles = 4.0 * np.sqrt(max(rank, 0) / 2)
    factor = _BYTES_AN_ENTRY * n * (6.0 * np.log2(n + 1) + handles)
    needed = max(_BYTES_A_FACE_FLIPPING * m, _BYTES_A_FACE * m + factor)
    needed += 8.0 * (_DENSE_MATRICES * rank**2 + _GRADIENTS_A_FORM * max(rank, 0))
    what = f"harmonic forms on {n:,} vertices with {rank:,} cohomology classes take"
    allowed = _checked(needed + 8.0 * n * np.clip(rank, 0, _FEWEST_COLUMNS), what, limit)
    return allowed - needed


def check_faces(n_faces: int) -> None:
    """Raise MemoryLimitError unless there is memory for a complex of so many faces."""
    _checked(_BYTES_A_FACE_FLIPPING * n_faces, f"a complex of {n_faces:,} faces takes", None)


def check_high_order(K: DeltaComplex, degree: int, n_forms: int, limit: float | None) -> None:
    """Raise MemoryLimitError unless forms of some degree have room; K has separated cone points."""
    what = f"{n_forms} forms of degree {degree} on {K.n_faces:,} faces take"
    _checked(high_order_memory(K, degree, n_forms), what, limit)


def high_order_memory(K: DeltaComplex, degree: int, n_forms: int) -> float:
    """Bytes that forms of some degree take on a complex whose cone points are separated.

    Bubbles in terms of traces, the entries of the system with their indices, the Cholesky factor
    of n unknowns with at most about 2 n (p + 1) log₂ n entries, and the forms.
    """
    n, traces = count_unknowns(K, degree), 3 * degree
    extensions = K.n_faces * (degree - 1) ** 2 * traces
    entries = 5 * K.n_faces * traces * (traces + 1) / 2
    factor = 2.0 * n * (degree + 1) * np.log2(n + 1)
    return 8.0 * float(extensions + entries + factor + 4 * n * n_forms)


def count_unknowns(K: DeltaComplex, degree: int) -> int:
    """Unknowns of the condensed system on a complex whose cone points are separated."""
    return K.n_vertices + (degree - 1) * K.n_edges


def _checked(needed: float, what: str, limit: float | None) -> float:
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
