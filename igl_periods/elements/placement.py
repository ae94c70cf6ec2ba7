"""Which face gets which element.

A face at a vertex of cone angle θ ≠ 2π gets the conical element with that apex, any other face the
flat one.  No face may have two such vertices: where one has, every face is divided into four first,
since the midpoints of sides are flat.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, cone_angles, cotangents, double_areas, split

from .reference_elements import ReferenceElement, conical_element, flat_element

# Numbers that are worked on at once: few enough to stay in the cache.
NUMBERS_AT_ONCE = 2**19


@dataclass(frozen=True, eq=False)
class Elements:
    """The faces that carry the same reference element, and their shapes seen from the apex.

    Attributes
    ----------
    reference : ReferenceElement
    face : (m,) int
        The faces, ascending.
    apex : (m,) int
        The corner of each that is the apex.
    aspect : (m,) float
        Height over length of the side opposite the apex.
    foot : (m,) float
        Where the foot of that height lies on the side: 0 at corner apex + 1, 1 at apex + 2.
    kappa : (m,) float
        The exponent 2π/θ of the cone at the apex, 1 on flat elements.
    """

    reference: ReferenceElement
    face: Ints
    apex: Ints
    aspect: Floats
    foot: Floats
    kappa: Floats

    def blocks(self, numbers_per_face: int) -> Iterator[Ints]:
        """Runs of the indices 0 … m - 1, short enough to be worked on at once."""
        size = max(1, NUMBERS_AT_ONCE // max(numbers_per_face, 1))
        for start in range(0, self.face.size, size):
            yield np.arange(start, min(start + size, self.face.size))


def shaped_elements(
    K: DeltaComplex, reference: ReferenceElement, face: Ints, apex: Ints, kappa: Floats
) -> Elements:
    """Elements on the given faces, with the shapes that the lengths of the sides determine."""
    lengths, row = K.lengths[face], np.arange(face.size)
    # Not 1 / (cot a + cot b), which cancels where the angle at a or b is near π.
    aspect = double_areas(lengths) / lengths[row, apex] ** 2
    cot_a = cotangents(lengths)[row, (apex + 1) % 3]
    return Elements(reference, face, apex, aspect, aspect * cot_a, kappa)


# Vertices whose total angle is 2π up to this, relatively, count as flat.
_FLATNESS = 1e-9
_EPS = float(np.finfo(np.float64).eps)


def separate_cones(K: DeltaComplex, cochains: csr_array) -> tuple[DeltaComplex, csr_array]:
    """The complex, with every face divided into four if one has two corners at cone points."""
    cones = is_cone(K)[K.corner_vertex]
    return split(K, cochains) if np.any(cones.sum(axis=1) > 1) else (K, cochains)


def is_cone(K: DeltaComplex) -> NDArray[np.bool_]:
    """Whether the total angle at each vertex differs from 2π beyond doubt; (n_vertices,) bool."""
    curvature = np.abs(cone_angles(K) - 2.0 * np.pi)
    return (curvature >= 2.0 * np.pi * _FLATNESS) & (curvature > _doubt(K))


def _doubt(K: DeltaComplex) -> Floats:
    """What rounding of lengths can do to the total angle at each vertex; (n_vertices,).

    The angle α opposite side a changes by a (δa − cos γ δb − cos β δc) / 2A.  A needle as wide as
    many ulps of its length has angles of a few digits, at vertices that may well be flat.
    """
    perimeter = K.lengths.sum(axis=1, keepdims=True)
    doubt = K.lengths * perimeter / double_areas(K.lengths)[:, None]
    if K.distortion is not None:
        doubt += K.distortion[:, None]
    return np.asarray(_EPS * np.bincount(K.corner_vertex.ravel(), doubt.ravel(), K.n_vertices))


def choose_elements(K: DeltaComplex, degree: int) -> tuple[Elements, ...]:
    """Conical elements on the faces with a corner at a cone point, flat ones on the others."""
    cone, kappa = is_cone(K)[K.corner_vertex], 2.0 * np.pi / cone_angles(K)
    face = np.flatnonzero(cone.any(axis=1))
    tip = np.argmax(cone[face], axis=1)
    exponents = kappa[K.corner_vertex[face, tip]]
    conical = shaped_elements(K, conical_element(degree), face, tip, exponents)
    flat = flat_elements(K, degree, np.flatnonzero(~cone.any(axis=1)))
    return tuple(elements for elements in (flat, conical) if elements.face.size)


def flat_elements(K: DeltaComplex, degree: int, face: Ints) -> Elements:
    """Flat elements on given faces: Lagrange elements, as far as their span is concerned.

    With them on all faces, the order of convergence is limited by the largest cone angle.
    """
    # The foot of the height on the longest side lies within it: accurate in thin triangles.
    top = np.argmax(K.lengths[face], axis=1)
    return shaped_elements(K, flat_element(degree), face, top, np.ones(face.size))
