r"""Pictures of derivatives: where Π is sensitive to the shape, and the quadratic differentials.

If the metric is strained, Π_kl moves by :math:`\int \bar\mu\, \zeta_k \zeta_l` (Rauch), μ the
traceless part of the strain.  So the products ζ_kζ_l, holomorphic quadratic differentials with
4g − 4 zeros, show which strain changes what: a stretch along the lines on which ζ_kζ_l > 0, the
*horizontal* ones, or across them.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex
from igl_periods.differentials import normalised_differentials
from igl_periods.errors import ComplexError
from igl_periods.harmonic import face_areas, linear_parts, spread_to_vertices
from igl_periods.periods import PeriodMatrix
from igl_periods.siegel import orthonormal_weights

from .scene import Scene, Tube
from .scenes import coloured, scale_legend
from .sheets import Sheet, surface_in_space
from .tubes import diagonal

_STROKE = (0.80, 0.12, 0.10)
_STROKES, _STROKE_LENGTH = 900, 0.022


def sensitivity_scene(pm: PeriodMatrix) -> Scene:
    """How much Π moves as the surface is displaced at a place, from dark to light, logarithmic.

    The gradients of all coordinates of Π in Siegel's metric by the position of a vertex, their
    norm, per area at the vertex.

    Raises
    ------
    ComplexError
        If the vertices have no positions in space.
    """
    K = pm.complex
    surface_in_space(K)
    sheet = Sheet.of(K)
    by_vertex = pm.gradient(orthonormal_weights(pm.matrix)).vertices
    if by_vertex is None:
        raise ComplexError(
            "the vertices of a periodic surface have no positions that Π could be sensitive to: "
            "there are gradients by the lengths (pm.gradient)."
        )
    norms = np.sqrt(np.einsum("cvi,cvi->v", by_vertex, by_vertex))
    area = face_areas(K)
    # Distances in diagonals, areas in parts of the whole: the scale has no unit.
    density = norms * diagonal(sheet.V) / (spread_to_vertices(K, area) / area.sum())
    colours, low, high = coloured(np.log10(np.maximum(density[sheet.source], 1e-300)))
    return Scene(
        sheet.V,
        sheet.F,
        colours,
        legend=scale_legend(10.0**low, 10.0**high),
        caption=(
            "How much the period matrix moves, in Siegel's metric, per displacement and area, from "
            f"{10.0**low:.2g} (dark) to {10.0**high:.2g} (light), on a logarithmic scale."
        ),
    )


def quadratic_scene(pm: PeriodMatrix, first: int, second: int) -> Scene:
    """The horizontal directions of ζ_kζ_l as strokes, and |ζ_kζ_l| in colours, logarithmic.

    Parameters
    ----------
    first, second : int
        The k and l, from 1 on.

    Raises
    ------
    ValueError
        If there are no such forms.
    ComplexError
        If the surface has no positions in space.
    """
    if not (1 <= first <= pm.genus and 1 <= second <= pm.genus):
        raise ValueError(f"there is no product ζ_{first} ζ_{second}: the genus is {pm.genus}.")
    K = pm.complex
    sheet = Sheet.of(K)
    zeta = normalised_differentials(pm)
    p, _ = linear_parts(K, zeta[[first - 1, second - 1]])
    product = p[0] * p[1]
    area = face_areas(K)
    at_vertices = spread_to_vertices(K, np.abs(product) * area) / spread_to_vertices(K, area)
    colours, low, high = coloured(np.log10(np.maximum(at_vertices[sheet.source], 1e-300)))
    return Scene(
        sheet.V,
        sheet.F,
        colours,
        tubes=_strokes(sheet, K, product),
        legend=scale_legend(10.0**low, 10.0**high),
        caption=(
            f"The quadratic differential ζ_{first} ζ_{second}: its horizontal directions, and its "
            f"size from {10.0**low:.2g} (dark) to {10.0**high:.2g} (light), on a logarithmic scale."
        ),
    )


def _strokes(sheet: Sheet, K: DeltaComplex, product: Complexes) -> tuple[Tube, ...]:
    """Short lines with ζ_kζ_l > 0, spread evenly by area."""
    V, F = sheet.V, sheet.F
    faces = _spread(face_areas(K)[: len(F)], _STROKES)
    corners = V[F[faces]]
    e = corners[:, 1] - corners[:, 0]
    e /= np.linalg.norm(e, axis=1, keepdims=True)
    normals = np.cross(e, corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    # dz with product · dz² > 0.
    dz = np.exp(-0.5j * np.angle(product[faces]))
    along = dz.real[:, None] * e + dz.imag[:, None] * np.cross(normals, e)
    half = 0.5 * _STROKE_LENGTH * diagonal(V)
    centres = corners.mean(axis=1)
    return tuple(
        Tube(np.stack([c - half * t, c + half * t]), np.stack([n, n]), _STROKE, closed=False)
        for c, t, n in zip(centres, along, normals)
    )


def _spread(area: Floats, count: int) -> Ints:
    """Faces at equal distances on the scale of the sum of areas."""
    total = np.cumsum(area)
    places = (np.arange(count) + 0.5) / count * total[-1]
    return np.unique(np.searchsorted(total, places))
