r"""Pictures of plane domains: harmonic measures, and conformal maps onto slit domains.

A map is shown by two nets.  In the domain lie the lines on which the coordinates of the image are
constant, x and y or, where circles around 0 matter, log r and φ; in the image lie those of the
domain, x and y.  As the map is conformal, each of the nets is one of squares.

Lines are those of the linear interpolation on each triangle.  φ is continued from corner to corner
of a triangle, so that its jumps by 2π are not seen.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

import numpy as np

from igl_periods.arrays import Bytes, Complexes, Floats
from igl_periods.complexes import DeltaComplex
from igl_periods.domains import BoundaryLoop, SlitMap
from igl_periods.errors import ComplexError
from igl_periods.machine import require

from .scenes import cycle_colour

_NET, _FILL = ("#29508a", "#9a8f5a"), "#f4f3ef"
# Squares of a net along the domain or around 0, and lines of a harmonic measure.
_SQUARES, _ROUND, _LEVELS = 30, 48, 10
_CROWDED = 3.0
# How much of a plane with slits is seen, in sizes of the slits.
_AROUND = 0.35


def slit_map_picture(m: SlitMap, size: tuple[int, int] = (1200, 640)) -> Bytes:
    """A domain and its image under a conformal map, each with the net of the other.

    Parameters
    ----------
    m : SlitMap
        Of a mesh in the plane, fine enough to be looked at: its vertices are what is mapped.
    size : (int, int)
        Width and height in pixels.

    Returns
    -------
    (height, width, 3) uint8

    Raises
    ------
    ComplexError
        If the surface is not in the plane.
    MissingExtraError
        If matplotlib is not installed.
    """
    z, w = _in_plane(m.complex), m.values
    F = m.complex.corner_vertex
    visible = np.isfinite(w[F]).all(axis=1)
    F = F[visible]
    figure = _figure(size)
    left, right = figure.subplots(1, 2)
    net = np.log(w[F[:, :1]]) + np.log(w[F] / w[F[:, :1]]) if m.polar else w[F]
    box = _box(
        np.concatenate([w[loop.vertices] for loop in m.loops]), 0.04 if m.is_bounded else _AROUND
    )
    step = 2 * np.pi / _ROUND if m.polar else float(np.ptp(box[:2])) / _SQUARES
    _panel(left, z, m.loops, z[F], _net(net, z[F], step))
    steps = float(max(np.ptp(z.real), np.ptp(z.imag))) / _SQUARES
    _panel(right, w, m.loops, w[F], _net(z[F], w[F], steps))
    right.set_xlim(*box[:2])
    right.set_ylim(*box[2:])
    return _pixels(figure)


def measure_picture(
    K: DeltaComplex,
    values: Floats,
    loops: Sequence[BoundaryLoop],
    size: tuple[int, int] = (800, 640),
) -> Bytes:
    """A function on a domain between 0 and 1, from dark to light, with its level lines.

    Parameters
    ----------
    K : DeltaComplex
        In the plane.
    values : (n_vertices,) float
        One row of :func:`~igl_periods.domains.harmonic_measures`.
    loops : sequence of BoundaryLoop
    size : (int, int)
        Width and height in pixels.

    Returns
    -------
    (height, width, 3) uint8

    Raises
    ------
    ComplexError
        If the surface is not in the plane.
    MissingExtraError
        If matplotlib is not installed.
    """
    z, F = _in_plane(K), K.corner_vertex
    figure = _figure(size)
    axes = figure.subplots()
    drawn = axes.tripcolor(z.real, z.imag, F, values, shading="gouraud", vmin=0.0, vmax=1.0)
    figure.colorbar(drawn, ax=axes)
    _add_lines(axes, level_lines(values[F], z[F], 1 / _LEVELS), "white", 0.7)
    _add_loops(axes, z, loops)
    return _pixels(figure)


def level_lines(values: Floats, corners: Complexes, step: float) -> Complexes:
    """The lines on which a function that is linear on triangles is a multiple of a step.

    Parameters
    ----------
    values, corners : (m, 3) float, (m, 3) complex
    step : float

    Returns
    -------
    (k, 2) complex
        The ends of their pieces in the triangles.
    """
    order = np.argsort(values, axis=1)
    low, middle, high = np.take_along_axis(values / step, order, axis=1).T
    a, b, c = np.take_along_axis(corners, order, axis=1).T
    pieces = []
    level = np.ceil(low)
    while True:
        crossed = np.flatnonzero((level < high) & (level > low))
        if crossed.size == 0 and not np.any((level <= low) & (level < high)):
            break
        at = level[crossed]
        x, y, top = low[crossed], middle[crossed], high[crossed]
        t = (at - x) / (top - x)
        one = a[crossed] + t * (c[crossed] - a[crossed])
        with np.errstate(divide="ignore", invalid="ignore"):
            below = a[crossed] + (at - x) / (y - x) * (b[crossed] - a[crossed])
            above = b[crossed] + (at - y) / (top - y) * (c[crossed] - b[crossed])
        pieces.append(np.stack([one, np.where(at < y, below, above)], axis=1))
        level = level + 1
    return np.concatenate(pieces) if pieces else np.zeros((0, 2), dtype=np.complex128)


def _in_plane(K: DeltaComplex) -> Complexes:
    if K.positions is None or K.positions.shape[1] < 2 or np.ptp(K.positions[:, 2:], axis=0).any():
        raise ComplexError("the surface does not lie in the plane: its maps are not drawn.")
    return np.asarray(K.positions[:, 0] + 1j * K.positions[:, 1])


def _figure(size: tuple[int, int]) -> Any:
    require("a picture of a domain", "matplotlib", "PIL")
    from matplotlib.figure import Figure

    return Figure(figsize=(size[0] / 100, size[1] / 100), dpi=100, layout="constrained")


def _net(net: Complexes, corners: Complexes, step: float) -> list[Complexes]:
    """The lines on which both parts of a function are multiples of a step.

    Where they are closer than the triangles, at poles, there are none.
    """
    lines = []
    for part in (net.real, net.imag):
        kept = np.ptp(part, axis=1) < _CROWDED * step
        lines.append(level_lines(part[kept], corners[kept], step))
    return lines


def _panel(
    axes: Any,
    points: Complexes,
    loops: Sequence[BoundaryLoop],
    corners: Complexes,
    net: list[Complexes],
) -> None:
    from matplotlib.collections import PolyCollection

    faces: Any = np.stack([corners.real, corners.imag], axis=-1)
    axes.add_collection(PolyCollection(faces, facecolors=_FILL, edgecolors=_FILL, linewidths=0.3))
    for lines, colour in zip(net, _NET):
        _add_lines(axes, lines, colour, 0.6)
    _add_loops(axes, points, loops)


def _add_lines(axes: Any, lines: Complexes, colour: str, width: float) -> None:
    from matplotlib.collections import LineCollection

    segments: Any = np.stack([lines.real, lines.imag], axis=-1)
    axes.add_collection(LineCollection(segments, colors=colour, linewidths=width))


def _add_loops(axes: Any, points: Complexes, loops: Sequence[BoundaryLoop]) -> None:
    for k, loop in enumerate(loops):
        ring = points[np.append(loop.vertices, loop.vertices[0])]
        axes.plot(ring.real, ring.imag, color=cycle_colour(k, len(loops)), linewidth=1.8)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.autoscale_view()


def _box(points: Complexes, margin: float) -> tuple[float, float, float, float]:
    """A square around points, with a margin in sizes of what they take up."""
    low, high = (complex(f(points.real), f(points.imag)) for f in (np.min, np.max))
    centre, half = (low + high) / 2, (0.5 + margin) * max((high - low).real, (high - low).imag)
    return (
        centre.real - half,
        centre.real + half,
        centre.imag - half,
        centre.imag + half,
    )


def _pixels(figure: Any) -> Bytes:
    from PIL import Image

    stream = io.BytesIO()
    figure.savefig(stream, format="png")
    return np.asarray(Image.open(stream).convert("RGB"))
