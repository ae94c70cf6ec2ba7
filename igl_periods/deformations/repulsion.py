r"""What keeps a surface in space away from itself, and its triangles from degenerating.

.. math:: \Phi = \log (E\, A) + \mu \operatorname{mean} \kappa^2 + \nu\, C

* E is the *tangent-point energy*, :math:`\iint \langle n_x, x - y\rangle^6 / |x - y|^{12}`, the
  double sum over faces and their centres: it grows without bounds where parts of the surface that
  are far from each other on it come near each other in space.  It has the dimension of 1/A.
* κ is how far a face is from being similar to the same face of the given surface,
  :math:`\|a\|^2 / (2 \det a)` for the affine map a between them: 1 for similarities, infinite for
  faces that degenerate.
* C is the contact energy (:mod:`igl_periods.deformations.contacts`).  The sum over centres does not
  see a corner that comes near the middle of a large face.

Φ has no unit, and no smooth force: its gradient is to be smoothed by a norm of second order.

References
----------
Yu, Brakensiek, Schumacher, Crane, "Repulsive surfaces" (2021).
Hormann, Greiner, "MIPS: an efficient global parametrization method" (2000), for κ.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, cotangents

from .contacts import contact_energy

_SHAPE, _CONTACT = 0.5, 0.03
# The reach of contacts, in square roots of the mean area of a face.
_REACH = 0.3
_FACES_AT_ONCE = 512


@dataclass(frozen=True, eq=False)
class Repulsion:
    """The energy Φ of surfaces with the faces of a given one.

    Attributes
    ----------
    F : (m, 3) int
    cotangents : (m, 3) float
        Of the angles of the given faces, each opposite the side of its index.
    """

    F: Ints
    cotangents: Floats

    @classmethod
    def of(cls, K: DeltaComplex) -> Repulsion:
        """Of surfaces near a given one."""
        return cls(K.corner_vertex, cotangents(K.lengths))

    def __call__(self, V: Floats) -> tuple[float, Floats]:
        """Φ and its gradient (n, 3)."""
        F, corners = self.F, V[self.F]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        double = np.linalg.norm(normals, axis=1)
        unit, area = normals / double[:, None], 0.5 * float(double.sum())
        energy, by_normal, by_centre = _tangent_point_energy(corners.mean(axis=1), unit, double)
        shapes, by_side, by_double = self._shapes(corners, double)
        contacts, gradient = contact_energy(V, F, _REACH * np.sqrt(area / len(F)))
        # C depends on distances over the reach alone, so this is its derivative by log A.
        by_area = -0.5 * float(np.sum(gradient * V))
        by_area = (1.0 + _CONTACT * by_area) / area
        pull = by_normal / energy + unit * (0.5 * by_area + _SHAPE * by_double)[:, None]
        by_corner = np.repeat(by_centre[:, None] / (3.0 * energy), 3, axis=1)
        for s in range(3):
            side = corners[:, (s + 2) % 3] - corners[:, (s + 1) % 3]
            by_corner[:, s] += np.cross(pull, side)
            by_corner[:, (s + 2) % 3] += _SHAPE * by_side[:, s, None] * side
            by_corner[:, (s + 1) % 3] -= _SHAPE * by_side[:, s, None] * side
        gradient = _CONTACT * gradient
        for axis in range(3):
            gradient[:, axis] += np.bincount(F.ravel(), by_corner[:, :, axis].ravel(), len(V))
        return float(np.log(energy * area)) + _SHAPE * shapes + _CONTACT * contacts, gradient

    def _shapes(self, corners: Floats, double: Floats) -> tuple[float, Floats, Floats]:
        """The mean of κ²; its derivatives by the sides, over these, and by the double areas."""
        sides = np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1)
        squares = np.einsum("msi,msi->ms", sides, sides)
        kappa = np.einsum("ms,ms->m", self.cotangents, squares) / (2.0 * double)
        slope = 2.0 * kappa / len(kappa)
        by_side = (slope / double)[:, None] * self.cotangents
        return float(np.mean(kappa**2)), by_side, -slope * kappa / double


def _tangent_point_energy(
    centres: Floats, unit: Floats, double: Floats
) -> tuple[float, Floats, Floats]:
    """E, and its gradients by the area vectors 2A n and by the centres of faces; (m, 3) both."""
    m, area = len(centres), 0.5 * double
    squares, heights = np.sum(centres**2, axis=1), np.sum(unit * centres, axis=1)
    energy, by_area = 0.0, np.zeros(m)
    by_unit, by_centre = np.zeros((m, 3)), np.zeros((m, 3))
    for start in range(0, m, _FACES_AT_ONCE):
        f = np.arange(start, min(start + _FACES_AT_ONCE, m))
        distance2 = squares[f, None] + squares - 2.0 * centres[f] @ centres.T
        distance2[np.arange(f.size), f] = np.inf
        inverse = 1.0 / distance2
        slope = (heights[f, None] - unit[f] @ centres.T) * inverse  # ⟨n, d⟩ / d²
        kernel = slope**2
        kernel = kernel * kernel * kernel
        energy += float(area[f] @ (kernel @ area))
        by_area[f] += kernel @ area
        by_area += area[f] @ kernel
        weights = area[f, None] * area * inverse
        by_height = 6.0 * weights * (slope**2 * slope) * slope**2
        by_distance = 12.0 * weights * kernel
        total, row = by_height.sum(axis=1)[:, None], by_distance.sum(axis=1)[:, None]
        by_unit[f] += total * centres[f] - by_height @ centres
        by_centre[f] += total * unit[f] - row * centres[f] + by_distance @ centres
        column = by_distance.sum(axis=0)[:, None]
        by_centre -= by_height.T @ unit[f] - by_distance.T @ centres[f] + column * centres
    tangential = by_unit - np.sum(by_unit * unit, axis=1)[:, None] * unit
    return energy, tangential / double[:, None] + 0.5 * by_area[:, None] * unit, by_centre
