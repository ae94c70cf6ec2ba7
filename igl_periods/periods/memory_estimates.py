r"""How much memory a computation will take.

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
(:mod:`igl_periods.harmonic.energies`), and take what is left.

Estimates are there to refuse what cannot work before it is begun, since a process that takes more
memory than there is gets killed without a word.
"""

from __future__ import annotations

import numpy as np

from igl_periods.complexes import BYTES_A_FACE_FLIPPING, DeltaComplex
from igl_periods.elements import count_unknowns
from igl_periods.machine import require_memory

_BYTES_A_FACE = 240.0
_BYTES_AN_ENTRY = 12.0
_DENSE_MATRICES = 12.0
_GRADIENTS_A_FORM = 5_000.0
_FEWEST_COLUMNS = 64


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
    needed = max(BYTES_A_FACE_FLIPPING * m, _BYTES_A_FACE * m + factor)
    needed += 8.0 * (_DENSE_MATRICES * rank**2 + _GRADIENTS_A_FORM * max(rank, 0))
    what = f"harmonic forms on {n:,} vertices with {rank:,} cohomology classes take"
    allowed = require_memory(needed + 8.0 * n * np.clip(rank, 0, _FEWEST_COLUMNS), what, limit)
    return allowed - needed


def check_high_order(K: DeltaComplex, degree: int, n_forms: int, limit: float | None) -> None:
    """Raise MemoryLimitError unless forms of some degree have room; K has separated cone points."""
    what = f"{n_forms} forms of degree {degree} on {K.n_faces:,} faces take"
    require_memory(high_order_memory(K, degree, n_forms), what, limit)


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
