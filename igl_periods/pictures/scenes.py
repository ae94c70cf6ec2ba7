r"""What a picture shows: a coloured or textured surface, and curves and points on it.

A scene is made of arrays alone; :mod:`~igl_periods.pictures.rendering` draws it.  There are five:

* the canonical cycles of a marking, as tubes;
* the checkerboard of a holomorphic form, squares but for the error of discretisation, with its
  zeros;
* the length |ζ| of a form, on a logarithmic scale;
* where the bound of the period matrix originates;
* the cut that makes the surface a disk.

They show the surface where :meth:`~igl_periods.pictures.sheets.Sheet.of` finds it, or on a sheet
that is given.
"""

from __future__ import annotations

import colorsys

import igl
import numpy as np

from igl_periods.arrays import Bytes, Floats, Ints
from igl_periods.complexes import DeltaComplex
from igl_periods.differentials import Parametrization
from igl_periods.harmonic import face_areas, spread_to_vertices
from igl_periods.periods import MeshQuality, PeriodMatrix
from igl_periods.topology import canonical_cycles

from .cells import smooth_cycles
from .scene import Scene, Tube
from .sheets import Sheet

_PALE, _DARK = (0.93, 0.92, 0.90), (0.16, 0.30, 0.52)
_CUT, _ZERO, _FOLD = (0.80, 0.12, 0.10), (0.95, 0.75, 0.05), (0.80, 0.12, 0.10)
# Radii, in diagonals of the surface.
TUBE, _BALL = 0.006, 0.012
_MOST_HANDLES = 8
# Squares of the checkerboard per square root of the area, and the part of the faces at each end of
# a scale that gets the extreme colours.
_SQUARES, _CLIPPED = 60.0, 1.0


def cycle_colour(k: int, n: int) -> tuple[float, float, float]:
    """Colour of cycle k of n, in the order a_1, b_1, a_2, b_2, …: all hues from red on."""
    return colorsys.hsv_to_rgb(k / n, 0.90, 0.85)


def cycles_scene(pm: PeriodMatrix, sheet: Sheet | None = None) -> Scene:
    """The canonical cycles of the marking of a period matrix, shortened and smoothed.

    Raises
    ------
    ComplexError
        If the surface has no positions in space, and no sheet is given.
    """
    K, g = pm.complex, pm.genus
    sheet = sheet or Sheet.of(K)
    V, F = sheet.V, sheet.F
    walks = canonical_cycles(pm.complex, pm.cocycles)
    handles = _shortest_handles(K, walks)
    shown = [k for i in handles for k in (i, i + g)]
    curves = smooth_cycles(sheet, [walks[k] for k in shown])
    colours = [cycle_colour(k, len(shown)) for k in range(len(shown))]
    names = [f"{'ab'[k // g]}{k % g + 1}" for k in shown]
    which = (
        "canonical cycles" if len(handles) == g else f"canonical cycles, the shortest of {2 * g}"
    )
    return Scene(
        V,
        F,
        _uniform(V),
        tubes=tuple(
            Tube(points, normals, colour, closed)
            for pieces, colour in zip(curves, colours, strict=True)
            for points, normals, closed in pieces
        ),
        legend=tuple(zip(names, colours, strict=True)),
        caption=f"{len(shown)} {which}; a_i meets b_i once, and no other, counted with signs.",
    )


def _shortest_handles(K: DeltaComplex, walks: list[Ints]) -> Ints:
    """The numbers i, increasing, of the pairs a_i, b_i that are to be shown."""
    g = len(walks) // 2
    lengths = np.array([K.lengths.ravel()[walk].sum() for walk in walks])
    return np.sort(np.argsort(lengths[:g] + lengths[g:], kind="stable")[:_MOST_HANDLES])


def checkerboard_scene(P: Parametrization, sheet: Sheet | None = None) -> Scene:
    """The checkerboard of a form, with its zeros (yellow) and vertices of negative index (red)."""
    sheet = sheet or Sheet.of(P.complex)
    V, F = sheet.V, sheet.F
    index = P.index[sheet.source]
    zeros, folds = np.flatnonzero(index > 0), np.flatnonzero(index < 0)
    uv = P.corner_uv[: len(F)] * checkerboard_scale(P)
    return Scene(
        V,
        F,
        _uniform(V),
        corner_uv=np.stack([uv.real, uv.imag], axis=-1),
        balls=((V[zeros], _BALL, _ZERO), (V[folds], _BALL, _FOLD)),
        caption=(
            "The checkerboard of a holomorphic form: every square is the image of a square of the "
            "plane. Where more than four squares meet in a point is a zero of the form."
        ),
    )


def checkerboard_scale(P: Parametrization) -> float:
    """By what to multiply z, so that a period of the checkerboard, two squares, has length 1."""
    return 0.5 * _SQUARES / float(np.sqrt(P.density @ face_areas(P.complex)))


def checkerboard(pixels: int = 256) -> Bytes:
    """One period of the checkerboard, two by two squares; (pixels, pixels, 3) uint8."""
    half = np.arange(pixels) < pixels // 2
    dark = half[:, None] == half
    colours = np.where(dark[..., None], _DARK, _PALE)
    return np.rint(255.0 * colours).astype(np.uint8)


def density_scene(P: Parametrization, sheet: Sheet | None = None) -> Scene:
    """The length |ζ| of a form, from dark (small) to light, on a logarithmic scale."""
    K = P.complex
    sheet = sheet or Sheet.of(K)
    area = face_areas(K)
    at_vertices = spread_to_vertices(K, P.density * area) / spread_to_vertices(K, area)
    values = 0.5 * np.log10(np.maximum(at_vertices[sheet.source], 1e-300))
    colours, low, high = coloured(values)
    return Scene(
        sheet.V,
        sheet.F,
        colours,
        legend=scale_legend(10.0**low, 10.0**high),
        caption=(
            f"|ζ| of a holomorphic form, from {10.0**low:.2g} (dark) to {10.0**high:.2g} (light), "
            "on a logarithmic scale."
        ),
    )


def quality_scene(K: DeltaComplex, quality: MeshQuality, sheet: Sheet | None = None) -> Scene:
    """Where the bound originates: its density, from dark (small) to light, logarithmic."""
    sheet = sheet or Sheet.of(K)
    density = quality.vertex_excess / spread_to_vertices(K, face_areas(K))
    relative = density / max(quality.bound, 1e-300) * float(face_areas(K).sum())
    values = np.log10(np.maximum(relative[sheet.source], 1e-6))
    colours, low, high = coloured(values)
    return Scene(
        sheet.V,
        sheet.F,
        colours,
        legend=scale_legend(10.0**low, 10.0**high),
        caption=(
            "Where the bound originates: its part per area, compared with the average, from "
            f"{10.0**low:.2g} (dark) to {10.0**high:.2g} (light), on a logarithmic scale."
        ),
    )


def cut_scene(P: Parametrization, sheet: Sheet | None = None) -> Scene:
    """The edges along which the surface is cut to a disk."""
    sheet = sheet or Sheet.of(P.complex)
    # In a cell both sides of a seam are seen, each in its place.
    seams = np.concatenate([P.seams, P.complex.twin.ravel()[P.seams]])
    ends = np.unique(np.sort(np.stack(sheet.ends(seams), axis=1), axis=1), axis=0)
    normals = igl.per_vertex_normals(sheet.V, sheet.F)
    tubes = tuple(Tube(sheet.V[e], normals[e], _CUT, closed=False) for e in ends)
    joints = sheet.V[np.unique(ends)]
    return Scene(
        sheet.V,
        sheet.F,
        _uniform(sheet.V),
        tubes=tubes,
        balls=((joints, TUBE, _CUT),),
        caption="The cut that makes the surface a disk.",
    )


def plain_scene(K: DeltaComplex, sheet: Sheet | None = None) -> Scene:
    """The surface, and nothing on it."""
    sheet = sheet or Sheet.of(K)
    return Scene(sheet.V, sheet.F, _uniform(sheet.V), caption="The surface.")


def _uniform(V: Floats) -> Floats:
    return np.tile(_PALE, (len(V), 1))


def coloured(values: Floats) -> tuple[Floats, float, float]:
    """Colours of values, and the least and greatest that are told apart."""
    low, high = np.percentile(values, [_CLIPPED, 100.0 - _CLIPPED])
    if high - low < 1e-9:
        low, high = low - 0.5, high + 0.5
    return _viridis(np.clip((values - low) / (high - low), 0.0, 1.0)), float(low), float(high)


def _viridis(values: Floats) -> Floats:
    return np.asarray(igl.colormap(igl.ColorMapType.VIRIDIS, values, False))


def scale_legend(low: float, high: float) -> tuple[tuple[str, tuple[float, float, float]], ...]:
    """The ends and the middle of a logarithmic scale, with their colours."""
    ends = _viridis(np.array([0.0, 0.5, 1.0]))
    values = (low, np.sqrt(low * high), high)
    return tuple(
        (f"{value:.2g}", (float(r), float(g), float(b)))
        for value, (r, g, b) in zip(values, ends, strict=True)
    )
