r"""Values of forms of high degree at points of faces.

A point is a face and its barycentric coordinates there.  The chart of a face is the plane in which
corner 0 is the origin, corner 1 is on the positive real axis, and corner 2 above it.  In the
coordinates (s, t) of the element (:mod:`~igl_periods.elements.reference_elements`), with e the unit
vector from corner a to corner b, n = -i e the unit vector along the height, h the height and ℓ the
length of the side from a to b, the gradient of u is

.. math:: \frac\tau t \left( \frac{u_s}{\tau \ell}\, e
          + \frac{\kappa u_\tau - (s - x)\, u_s / \tau}{h}\, n \right).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex, angles, edge_ends

from .placement import Elements
from .trial_forms import HighOrderForms, coefficients

_POINTS_AT_ONCE = 4096


def potentials(forms: HighOrderForms, face: ArrayLike, barycentric: ArrayLike) -> Floats:
    """Integrals of the forms from corner 0 of faces to points in them; (n, k) float.

    Parameters
    ----------
    forms : HighOrderForms
    face : (n,) array-like of int
        Faces of ``forms.complex``.
    barycentric : (n, 3) array-like
        Weights of the corners, adding up to 1.

    Raises
    ------
    ValueError
        If a face does not exist, or a point is outside of its face.
    """
    values = np.empty((np.size(face), forms.cochains.shape[0]))
    for points, elements, block, s, t in _located(forms, face, barycentric):
        u = coefficients(forms, elements, block)
        tau = t ** elements.kappa[block]
        shapes, _, _ = elements.reference.tabulate(s, tau)
        corner_0 = (-elements.apex[block]) % 3
        values[points] = np.einsum("bn,nbk->bk", shapes, u) - u[corner_0, np.arange(block.size)]
    return values


def gradients(forms: HighOrderForms, face: ArrayLike, barycentric: ArrayLike) -> Complexes:
    """Gradients u_x + i u_y of potentials of the forms, in the charts of the faces; (n, k) complex.

    The form is ω = u_x dx + u_y dy, and where it is harmonic, ω + i*ω is the holomorphic form
    conj(gradient) dz.  At a vertex of total angle above 2π there is no gradient: infinity or NaN.

    Parameters, Raises
        As in :func:`potentials`.
    """
    values = np.empty((np.size(face), forms.cochains.shape[0]), dtype=np.complex128)
    K = forms.complex
    for points, elements, block, s, t in _located(forms, face, barycentric):
        u = coefficients(forms, elements, block)
        kappa = elements.kappa[block]
        _, by_tau, by_s = elements.reference.tabulate(s, t**kappa)
        u_tau, u_s = (np.einsum("bn,nbk->bk", shapes, u) for shapes in (by_tau, by_s))
        along = u_s
        down = kappa[:, None] * u_tau - (s - elements.foot[block])[:, None] * u_s
        length = K.lengths[elements.face[block], elements.apex[block]]
        slope = along - 1j * down / elements.aspect[block, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = t ** (kappa - 1.0) / length * side_directions(K, elements, block)
            values[points] = scale[:, None] * slope
    return values


def edge_integrals(forms: HighOrderForms) -> Floats:
    """Integrals of the forms along the edges of ``forms.complex``; (k, n_edges) float."""
    K = forms.complex
    values = forms.cochains.toarray().astype(np.float64)
    f = forms.traces[: K.n_vertices].T
    tail, head = edge_ends(K)
    return values + (f[:, head] - f[:, tail])


def _located(
    forms: HighOrderForms, face: ArrayLike, barycentric: ArrayLike
) -> Iterator[tuple[Ints, Elements, Ints, Floats, Floats]]:
    """Points with their elements, the indices of these, and their coordinates s and t."""
    faces, weights = np.atleast_1d(np.asarray(face)), np.atleast_2d(np.asarray(barycentric, float))
    _check_points(forms.complex, faces, weights)
    for elements in forms.elements:
        chosen = np.flatnonzero(np.isin(faces, elements.face))
        for start in range(0, chosen.size, _POINTS_AT_ONCE):
            points = chosen[start : start + _POINTS_AT_ONCE]
            block = np.searchsorted(elements.face, faces[points])
            row, apex = np.arange(points.size), elements.apex[block]
            local = np.clip(weights[points], 0.0, None)
            a, b = local[row, (apex + 1) % 3], local[row, (apex + 2) % 3]
            t = a + b
            s = np.divide(b, t, out=np.full_like(t, 0.5), where=t > 0.0)
            yield points, elements, block, s, np.minimum(t, 1.0)


def _check_points(K: DeltaComplex, faces: Ints, weights: Floats) -> None:
    if faces.ndim != 1 or weights.shape != (faces.size, 3):
        raise ValueError(
            f"points are n faces and (n, 3) barycentric coordinates, not arrays of shapes "
            f"{faces.shape} and {weights.shape}."
        )
    if faces.size and not 0 <= faces.min() <= faces.max() < K.n_faces:
        raise ValueError(
            f"faces {faces.min()} … {faces.max()} are out of range: there are {K.n_faces}."
        )
    inside = (weights > -1e-9).all(axis=1) & (np.abs(weights.sum(axis=1) - 1.0) < 1e-9)
    if not inside.all():
        i = int(np.argmin(inside))
        raise ValueError(
            f"{np.count_nonzero(~inside)} points are outside of their faces; the first has "
            f"barycentric coordinates {weights[i].tolist()}, which must be ≥ 0 and add up to 1."
        )


def side_directions(K: DeltaComplex, elements: Elements, block: Ints) -> Complexes:
    """Unit vector of the side opposite the apex, from corner apex + 1 to apex + 2, in the chart."""
    face, apex = elements.face[block], elements.apex[block]
    angle = angles(K.lengths[face])
    turn = np.stack([np.pi - angle[:, 1], np.pi + angle[:, 0], np.zeros(face.size)], axis=1)
    return np.exp(1j * turn[np.arange(face.size), apex])
