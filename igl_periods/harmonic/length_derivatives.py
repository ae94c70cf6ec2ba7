r"""How energies of harmonic forms change with the metric: Rauch's formula on triangles.

Energies of harmonic forms are stationary in their potentials, so that their derivative is that of
the energy of *fixed* forms, and nothing has to be solved for it.  If the metric of a triangle moves
by the symmetric form ε, lengths of vectors v by :math:`\epsilon(v, v) / |v|`, then

.. math:: \partial \int \omega_i \wedge {*\omega_j}
          = \int \omega_i^T (\operatorname{tr} \epsilon - 2 \epsilon)\, \omega_j
          = -2 \operatorname{Re} \int \bar\mu\, G_i G_j ,

where G is the gradient as a complex number in the chart of the face and μ the traceless part of ε,
:math:`\epsilon^0(v, v) = \operatorname{Re} (\bar\mu v^2)`.  With the sides :math:`E_0 + E_1 + E_2 =
0` as complex numbers, twice the area a and the relative changes :math:`\lambda_s = dl_s / l_s`,

.. math:: \mu = \frac{E_0 E_1 E_2}{2 a^2} \sum_s \lambda_s \bar E_s .

It is 0 where all λ are equal, so only the conformal structure counts: :math:`\sum_e l_e\,
\partial D / \partial l_e = 0`, triangle by triangle.  The :math:`\bar G_i \bar G_j\, dz^2` are the
quadratic differentials of the theory of Rauch and Ahlfors; their integrals over the triangles, the
*moments* :math:`\int G_i G_j`, are all that derivatives in both directions need.

For linear functions this is the derivative of the discrete energies, to rounding.  For functions of
high degree it is Rauch's formula with nearly harmonic forms, for deformations that are linear on
triangles: the derivative of the exact energies up to the error of the forms in energy.

References
----------
Rauch, "Weierstrass points, branch points, and moduli of Riemann surfaces" (1959).
Ahlfors, "The complex analytic structure of the space of closed Riemann surfaces" (1960).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import apexes, double_areas

from .linear_forms import LinearForms, blocks


class GradientBlocks(Protocol):
    """Forms on a triangulation that show their gradients a few faces at a time."""

    def gradient_blocks(self) -> Iterable[tuple[Ints | slice, Complexes]]:
        """Faces, each at most once, and gradients there.

        The gradients are complex numbers G √w in the charts of the faces at the points of a
        quadrature with the weights w, Σ w the area; (q, faces, k).
        """


@dataclass(frozen=True, eq=False)
class LinearGradients:
    """The gradients of linear forms, one for each face."""

    forms: LinearForms

    def gradient_blocks(self) -> Iterator[tuple[slice, Complexes]]:
        """All faces in portions; (1, faces, k)."""
        for block in blocks(len(self.forms.faces.lengths), self.forms.n_forms):
            along, across = np.split(self.forms.gradients(block), 2)
            yield block, (along + 1j * across)[None]


def side_vectors(lengths: Floats) -> Complexes:
    """The sides of triangles as complex numbers, corner 0 at 0 and corner 1 on the axis; (m, 3)."""
    foot, height = apexes(lengths)
    base = lengths[:, 2]
    apex = foot * base + 1j * height
    return np.stack([apex - base, -apex, base], axis=1)


def distortions(lengths: Floats, relative: Floats) -> Complexes:
    """The μ of faces whose sides change by ``relative`` of their lengths; (c, m).

    Parameters
    ----------
    lengths : (m, 3) float
    relative : (c, m, 3) float
    """
    E = side_vectors(lengths)
    factor = E.prod(axis=1) / (2.0 * double_areas(lengths) ** 2)
    return np.asarray(factor * np.einsum("cms,ms->cm", relative, E.conj()))


def energy_derivatives(forms: GradientBlocks, mu: Complexes) -> Floats:
    """The derivatives −2 Re ∫ μ̄ G_i G_j for some distortions (c, m); (c, k, k)."""
    parts = []
    for faces, G in forms.gradient_blocks():
        q, n, k = G.shape
        points = G.reshape(q * n, k)
        weights = np.tile(mu[:, faces].conj(), q)
        parts.append([(points.T @ (row[:, None] * points)).real for row in weights])
    return np.asarray(-2.0 * np.sum(parts, axis=0, dtype=np.float64))


def moments(forms: GradientBlocks, S: Floats, n_faces: int) -> Complexes:
    """The integrals of Σ S_ij G_i G_j over faces, for some symmetric S (c, k, k); (c, m)."""
    found = np.zeros((len(S), n_faces), dtype=np.complex128)
    for faces, G in forms.gradient_blocks():
        for row, matrix in zip(found, S):
            row[faces] += np.sum((G @ matrix) * G, axis=(0, 2))
    return found


def length_gradient(lengths: Floats, moment: Complexes) -> Floats:
    """The gradient of Σ S_ij D_ij by the logarithms of the sides of each face; (c, m, 3).

    Parameters
    ----------
    moment : (c, m) complex
        :func:`moments` of S.
    """
    E = side_vectors(lengths)
    factor = E.prod(axis=1).conj() / double_areas(lengths) ** 2
    return np.asarray(-((factor * moment)[:, :, None] * E).real)
