r"""Harmonic measures: the functions u_i that are 1 on one boundary loop and 0 on the others.

On the double the form of least energy in the class β_i is du_i / 2 on the first sheet, and minus
that on the second one.  In the triangulation of a double, which the exchange of the sheets maps
onto itself, this holds for the form of least energy among functions of any degree, so that

.. math:: u_i = 2\, (\chi_i + f_i - f_i(C_1)), \qquad i \ge 2,

with β_i + df_i this form and χ_i as in :mod:`~igl_periods.domains.boundary_classes`, is constant on
every loop.  All of them add up to 1.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, of_a_surface
from igl_periods.elements import high_order_forms
from igl_periods.errors import ComplexError

from .boundary_classes import boundary_loops, doubled_with_classes


@of_a_surface
def harmonic_measures(K: DeltaComplex, degree: int = 4) -> Floats:
    """The harmonic functions that are 1 on one boundary loop and 0 on the others, at the vertices.

    Parameters
    ----------
    K : surface
        Oriented, connected, with a boundary.
    degree : int
        Degree of the trial functions.

    Returns
    -------
    (n, n_vertices) float
        One row for each of ``boundary_loops(K)``.  The columns add up to 1.

    Raises
    ------
    ComplexError
        If the surface has no boundary, is not connected, or orientations of faces disagree.
    ValueError
        If the degree is less than 1.
    """
    loops = boundary_loops(K)
    if not loops:
        raise ComplexError("the surface has no boundary: there is nothing to measure.")
    L, classes = doubled_with_classes(K, loops)
    forms = high_order_forms(L, classes[1:], degree)
    # Vertices keep their numbers where faces are divided.
    f = forms.traces[: L.n_vertices].T
    vertex = np.empty(K.n_vertices, dtype=np.int64)
    vertex[K.corner_vertex] = L.corner_vertex[: K.n_faces]
    u = f[:, vertex]
    u -= u[:, loops[0].vertices].mean(axis=1, keepdims=True)
    for row, loop in zip(u, loops[1:]):
        row[loop.vertices] += 1.0
    return np.vstack([1.0 - 2.0 * u.sum(axis=0), 2.0 * u])
