r"""Closed forms that are constant on every triangle.

The chart of a face is the plane C in which corner 0 is the origin, corner 1 lies on the positive
real axis, and corner 2 above it.  A closed cochain is the integral of exactly one constant form on
each face.  A real one is :math:`\omega = g_x\,dx + g_y\,dy` with the gradient
:math:`g = g_x + i g_y`; its Hodge star has the gradient :math:`i g`.  A complex one is

.. math:: \zeta = p\,dz + q\,d\bar z,

and z ↦ ∫ζ maps the face affinely, with the singular values :math:`|p| + |q|` and
:math:`\bigl||p| - |q|\bigr|`; it keeps the orientation iff :math:`|q| < |p|`.  Squared norms are
taken with respect to the area dx dy, :math:`\|\omega\|^2 = \sum_f |g|^2 A_f`.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import DeltaComplex, along_sides, apexes, double_areas


def face_areas(K: DeltaComplex) -> Floats:
    """Area of each face; (m,)."""
    return 0.5 * double_areas(K.lengths)


def spread_to_vertices(K: DeltaComplex, values: Floats) -> Floats:
    """Sums of values of faces (m,) at vertices, a third of each at each corner; (n_vertices,)."""
    sums = np.bincount(K.corner_vertex.ravel(), np.repeat(values / 3, 3), K.n_vertices)
    return sums.astype(np.float64)


def third_corners(K: DeltaComplex) -> Complexes:
    """Position of corner 2 of each face in its chart; (m,).  Corners 0 and 1 are 0 and l_2."""
    foot, height = apexes(K.lengths)
    return foot * K.lengths[:, 2] + 1j * height


def gradients(K: DeltaComplex, forms: Floats) -> Complexes:
    """Gradients of real closed cochains in the charts of the faces.

    Parameters
    ----------
    forms : (…, n_edges) float

    Returns
    -------
    (…, m) complex
    """
    p, _ = linear_parts(K, forms.astype(np.complex128))
    # ω = p dz + p̄ dz̄ has the gradient 2 p̄.
    return 2.0 * p.conj()


def linear_parts(K: DeltaComplex, forms: Complexes) -> tuple[Complexes, Complexes]:
    """The numbers p and q with ζ = p dz + q dz̄ on each face.

    Parameters
    ----------
    forms : (…, n_edges) complex
        Closed cochains.

    Returns
    -------
    p, q : (…, m) complex
    """
    values = along_sides(K, forms)
    to_1, to_2 = values[..., 2], -values[..., 1]
    corner = third_corners(K)
    total = to_1 / K.lengths[:, 2]
    p: Complexes = (to_2 - total * corner.conj()) / (2j * corner.imag)
    q: Complexes = total - p
    return p, q
