r"""Keeping the parts of a surface in space apart: the tangent-point energy.

.. math:: E = \sum_{v, w} m_v m_w \frac{\langle n_v, X_w - X_v \rangle^2}{|X_w - X_v|^6},

a discretisation of the double integral of :math:`1 / (4 R^2 |x - y|^2)`, R the radius of the sphere
that touches the surface in x and passes through y.  It is finite on smooth embedded surfaces and
grows beyond all bounds before two sheets meet; on a sheet that curves gently it is small.  Normals
are kept fixed in its gradient, which serves for a direction only.

References
----------
Buck, Orloff, "A simple energy function for knots" (1995).
Yu, Brakensiek, Schumacher, Crane, "Repulsive surfaces" (2021).
"""

from __future__ import annotations

import igl
import numpy as np

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex
from igl_periods.harmonic import face_areas, spread_to_vertices

# Pairs worked on at once.
_PAIRS_AT_ONCE = 2_000_000


def repulsion(K: DeltaComplex) -> tuple[float, Floats]:
    """The energy and its gradient by the positions (n, 3), normals fixed; O(n²).

    ``K`` lies in R³.
    """
    X = np.asarray(K.positions, dtype=np.float64)
    n = len(X)
    area = face_areas(K)
    m = spread_to_vertices(K, area) / area.sum()
    X = X / np.sqrt(area.sum())
    normals = np.asarray(igl.per_vertex_normals(X, K.corner_vertex))
    energy, gradient = 0.0, np.zeros_like(X)
    size = max(1, _PAIRS_AT_ONCE // n)
    for start in range(0, n, size):
        rows = slice(start, min(start + size, n))
        apart = X[None] - X[rows, None]
        squares = np.einsum("vwi,vwi->vw", apart, apart)
        here = np.arange(rows.start, rows.stop)
        squares[here - start, here] = np.inf
        height = np.einsum("vi,vwi->vw", normals[rows], apart)
        weight = m[rows, None] * m / squares**3
        energy += float((weight * height**2).sum())
        by_normal, by_place = 2.0 * weight * height, -6.0 * weight * height**2 / squares
        push = by_normal[..., None] * normals[rows, None] + by_place[..., None] * apart
        gradient += push.sum(axis=0)
        gradient[rows] -= push.sum(axis=1)
    return energy, gradient / np.sqrt(area.sum())
