r"""Smooth functions on a surface: the lowest eigenfunctions of its Laplacian.

A displacement of vertices can change the conformal structure by ripples: much, while it is small in
the mass norm.  Within the span of the lowest eigenfunctions of :math:`L u = \lambda M u` (cotangent
weights on the intrinsic Delaunay triangulation, masses of vertices) there are no ripples, and the
shape changes as a whole.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csc_array, csr_array, diags_array
from scipy.sparse.linalg import eigsh

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, as_complex, cotan_weights, intrinsic_delaunay
from igl_periods.harmonic import face_areas, laplacian, spread_to_vertices
from igl_periods.options import checked_integer

_SHIFT = -1e-6


def smooth_functions(
    surface: DeltaComplex | ArrayLike, F: ArrayLike | None = None, *, count: int
) -> Floats:
    """The lowest eigenfunctions of the Laplacian, the constant first; (n_vertices, count).

    Parameters
    ----------
    surface, F
        As for :func:`period_matrix`.
    count : int
        How many, less than the number of vertices.

    Raises
    ------
    ValueError
        If there are not so many.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> ip.smooth_functions(V, F, count=4).shape
    (96, 4)
    """
    K, count = as_complex(surface, F), checked_integer("count", count)
    if not 1 <= count < K.n_vertices:
        raise ValueError(
            f"count = {count}: of {K.n_vertices} vertices 1 to {K.n_vertices - 1} functions."
        )
    flipped, _ = intrinsic_delaunay(K, csr_array((0, K.n_edges), dtype=np.int64))
    area = face_areas(flipped)
    masses = spread_to_vertices(flipped, area) / area.sum()
    L = laplacian(flipped, cotan_weights(flipped))
    # A start of its own, so that the result is the same every time.
    start = np.random.default_rng(0).standard_normal(K.n_vertices)
    values, functions = eigsh(
        csc_array(L), count, csc_array(diags_array(masses)), sigma=_SHIFT, v0=start
    )
    return np.asarray(functions[:, np.argsort(values)], dtype=np.float64)
