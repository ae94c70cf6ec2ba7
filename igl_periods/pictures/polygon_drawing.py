"""A flat surface as its polygons in the plane, drawn as an SVG file.

Glued sides have the same letter and colour, with a prime where the second one is glued by a
rotation that is no translation.  Vertices of the surface are dots of one colour each, hollow where
the total angle is 2π; the legend tells the angles.  Polygons that overlap in their own coordinates
are drawn one beside the other.
"""

from __future__ import annotations

import math
from fractions import Fraction
from os import PathLike
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex
from igl_periods.errors import RenderError
from igl_periods.flat_surfaces import flat_surface_report
from igl_periods.machine import check_output

# Colours that stay apart for readers who see few of them (Okabe, Ito 2008), then darker ones.
_COLOURS = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8C6D1F", "#5B3A8E",
    "#7A0019", "#2F4F4F",
)  # fmt: skip
_LETTERS = "abcdefghijklmnopqrstuvwxyz"
_FONT = "DejaVu Sans, Helvetica, Arial, sans-serif"
_INK = "#333333"
_GAP = 0.15
_MOST_ANGLES = 8


def render_polygons(K: DeltaComplex, path: str | PathLike[str], *, width: int = 800) -> None:
    """Draw the polygons that a surface was glued from, with named sides and cone points.

    Parameters
    ----------
    K : DeltaComplex
        From :meth:`~igl_periods.DeltaComplex.from_polygons`.
    path : path-like
        An SVG file.
    width : int
        Of the picture, in pixels.

    Raises
    ------
    RenderError
        If the surface was not glued from polygons, or ``width`` is less than 100.
    FileNotFoundError
        If there is no such folder.
    """
    if K.polygons is None:
        raise RenderError(
            "the surface was not glued from polygons: make it with DeltaComplex.from_polygons."
        )
    if width < 100:
        raise RenderError(f"width = {width}: a picture of 100 pixels at least is drawn.")
    check_output(path)
    ET.ElementTree(_picture(K, width)).write(Path(path), encoding="utf-8", xml_declaration=True)


def _picture(K: DeltaComplex, width: int) -> ET.Element:
    assert K.polygons is not None
    placed, apart = laid_out([polygon.copy() for polygon in K.polygons.xy])
    corners = np.concatenate(placed)
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 44.0
    scale = (width - 2 * margin) / float(max(high[0] - low[0], 0.75 * (high[1] - low[1])))
    left = 0.5 * (width - scale * (high[0] - low[0]))
    points = [
        np.stack([left + scale * (p[:, 0] - low[0]), margin + scale * (high[1] - p[:, 1])], axis=1)
        for p in placed
    ]
    angles = _angles(K)
    below = margin + scale * float(high[1] - low[1])
    height = below + margin + 24 * (1 + len(_legend(angles)) // 3)
    svg = ET.Element(
        "svg",
        xmlns="http://www.w3.org/2000/svg",
        width=str(width),
        height=f"{height:.0f}",
        viewBox=f"0 0 {width} {height:.0f}",
    )
    ET.SubElement(svg, "rect", width="100%", height="100%", fill="white")
    for polygon in points:
        ET.SubElement(svg, "polygon", points=_text_of(polygon), fill="#F3F1EA")
    _draw_sides(svg, K, points, -13.0 if apart else 13.0)
    _draw_vertices(svg, K, points, angles)
    _draw_legend(svg, angles, below + 40.0, width)
    return svg


def laid_out(polygons: list[Floats]) -> tuple[list[Floats], bool]:
    """The polygons where they are, or side by side if their boxes overlap; and whether so."""
    boxes = [(p.min(axis=0), p.max(axis=0)) for p in polygons]
    size = max(float((high - low).max()) for low, high in boxes)
    close = 1e-9 * size
    overlap = any(
        bool(((a[0] < b[1] - close) & (b[0] < a[1] - close)).all())
        for i, a in enumerate(boxes)
        for b in boxes[:i]
    )
    if not overlap:
        return polygons, False
    columns = max(1, math.ceil(math.sqrt(1.5 * len(polygons))))
    cell = np.array([max(float(high[k] - low[k]) for low, high in boxes) for k in (0, 1)])
    step = cell + _GAP * size
    moved = []
    for i, (p, (low, high)) in enumerate(zip(polygons, boxes)):
        place = step * np.array([i % columns, -(i // columns)])
        moved.append(p - 0.5 * (low + high) + place)
    return moved, True


def _draw_sides(svg: ET.Element, K: DeltaComplex, points: list[Floats], inwards: float) -> None:
    assert K.polygons is not None
    for number, pair in enumerate(K.polygons.gluing):
        colour = _COLOURS[number % len(_COLOURS)]
        name, again = _name(number), ""
        v, w = (_side(points, *side) for side in pair)
        if np.hypot(*(v + w)) > 1e-6 * np.hypot(*v):
            again = "′"
        for (p, k), prime in zip(pair, ("", again)):
            a, b = points[p][k], points[p][(k + 1) % len(points[p])]
            ET.SubElement(
                svg,
                "line",
                {"stroke": colour, "stroke-width": "3", "stroke-linecap": "round"},
                **dict(zip(("x1", "y1", "x2", "y2"), (f"{x:.2f}" for x in (*a, *b)))),
            )
            # Inside is to the left of the side, and the picture is upside down.
            along = (b - a) / np.hypot(*(b - a))
            x, y = 0.5 * (a + b) + inwards * np.array([along[1], -along[0]])
            _write(svg, name + prime, x, y + 5.0, colour)


def _side(points: list[Floats], p: int, k: int) -> Floats:
    side: Floats = points[p][(k + 1) % len(points[p])] - points[p][k]
    return side


def _angles(K: DeltaComplex) -> list[Fraction | float]:
    return list(flat_surface_report(K).cone_angles)


def _draw_vertices(
    svg: ET.Element, K: DeltaComplex, points: list[Floats], angles: list[Fraction | float]
) -> None:
    assert K.polygons is not None
    drawn = set()
    for p, t, vertices in zip(K.polygons.polygon, K.polygons.corners, K.corner_vertex):
        for corner, vertex in zip(t.tolist(), vertices.tolist()):
            if (int(p), corner) not in drawn:
                drawn.add((int(p), corner))
                x, y = points[int(p)][corner]
                _dot(svg, x, y, vertex, angles[vertex])


def _dot(svg: ET.Element, x: float, y: float, vertex: int, angle: Fraction | float) -> None:
    colour = _COLOURS[(vertex + 1) % len(_COLOURS)]
    fill = "white" if angle == 1 else colour
    ET.SubElement(
        svg,
        "circle",
        {"stroke": colour, "stroke-width": "2", "fill": fill},
        cx=f"{x:.2f}",
        cy=f"{y:.2f}",
        r="5.5",
    )


def _legend(angles: list[Fraction | float]) -> list[int]:
    """The vertices that the legend shows: of cone points, the first ones."""
    cones = [v for v, angle in enumerate(angles) if angle != 1]
    return (cones or [0])[:_MOST_ANGLES]


def _draw_legend(svg: ET.Element, angles: list[Fraction | float], y: float, width: int) -> None:
    shown = _legend(angles)
    for i, vertex in enumerate(shown):
        x = 40.0 + (width - 80.0) * (i % 3) / 3
        _dot(svg, x, y + 24 * (i // 3) - 5, vertex, angles[vertex])
        angle = angles[vertex]
        twice = f"{2 * angle}π" if isinstance(angle, Fraction) else f"{2 * angle:.4g}π"
        last = i == len(shown) - 1 and sum(a != 1 for a in angles) > len(shown)
        text = f"total angle {'π' if twice == '1π' else twice}{', …' if last else ''}"
        _write(svg, text, x + 14, y + 24 * (i // 3), _INK)


def _write(svg: ET.Element, text: str, x: float, y: float, colour: str) -> None:
    """Text in the colour of what it names, about the point; black text starts there."""
    anchor = "start" if colour == _INK else "middle"
    ET.SubElement(
        svg,
        "text",
        {"font-family": _FONT, "font-size": "14", "text-anchor": anchor, "fill": colour},
        x=f"{x:.2f}",
        y=f"{y:.2f}",
    ).text = text


def _name(number: int) -> str:
    """a, b, …, z, a1, b1, …"""
    letter = _LETTERS[number % len(_LETTERS)]
    return letter if number < len(_LETTERS) else f"{letter}{number // len(_LETTERS)}"


def _text_of(polygon: Floats) -> str:
    return " ".join(f"{x:.2f},{y:.2f}" for x, y in polygon)
