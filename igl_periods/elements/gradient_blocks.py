r"""Gradients of forms of high degree in the charts of faces, at the points of the quadrature.

With e the unit vector along the side opposite the apex of an element, and n = −i e the one along
its height, the two components that :func:`~igl_periods.elements.condensation.scaled_gradients`
yields are those along n and along e = i n.  So :math:`G \sqrt w = (X_n + i X_e)\, n` as a complex
number in the chart of the face, in which corner 0 is the origin and corner 1 on the real axis.
Products :math:`G_i G_j w` add up to the moments :math:`\int G_i G_j` of the face, for the exact
gradient also on conical elements.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from igl_periods.arrays import Complexes, Ints

from .condensation import scaled_gradients
from .point_values import side_directions
from .trial_forms import HighOrderForms, coefficients


@dataclass(frozen=True, eq=False)
class HighOrderGradients:
    """The gradients of forms of high degree on the faces of ``forms.complex``."""

    forms: HighOrderForms

    def gradient_blocks(self) -> Iterator[tuple[Ints, Complexes]]:
        """Faces in portions, and G √w at the points of the quadrature; (q, faces, k)."""
        forms = self.forms
        k = forms.cochains.shape[0]
        for elements in forms.elements:
            for block in elements.blocks(4 * k * elements.reference.quadrature.nodes.size):
                u = coefficients(forms, elements, block)
                down, along = scaled_gradients(elements, block, u)
                normal = -1j * side_directions(forms.complex, elements, block)
                yield elements.face[block], (down + 1j * along) * normal[:, None]
