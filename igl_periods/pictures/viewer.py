"""A surface that one can turn: one HTML file, which asks the network for nothing.

The page shows scenes of one surface.  What colours the surface is chosen one at a time; curves and
points are shown or hidden; the surface can be made transparent, so that what is behind it is seen.
K3D draws: its program and the surface are in the page, compressed.  The surface is there once, and
each colouring adds a colour for every point.  Where a browser cannot draw, the page says so and
shows a picture instead.
"""

from __future__ import annotations

import base64
import json
import os
import re
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

import numpy as np

from igl_periods.arrays import Bytes, Floats, Ints
from igl_periods.complexes import DeltaComplex
from igl_periods.machine import check_output, require
from igl_periods.periods import PeriodMatrix
from igl_periods.run_log import stage

from .all_scenes import CYCLES, PLAIN, scenes_of_complex, scenes_of_matrix
from .rendering import seen_from
from .scene import Scene
from .viewer_objects import (
    ANGLE_OF_VIEW,
    PagePoints,
    packed_colour,
    png_bytes,
    scenes_with_curves,
    snapshot,
)

_HEIGHT = 560
_PLAIN_CAPTION, _ZEROS = "The surface.", "zeros of the form"


@dataclass(frozen=True, eq=False)
class Viewer:
    """A page with a surface to turn; a notebook shows it, :meth:`save` writes it to a file.

    Attributes
    ----------
    title : str
    html : str
        The page.
    """

    title: str
    html: str

    def __repr__(self) -> str:
        return f"Viewer({self.title!r}, {len(self.html) / 1e6:.1f} MB)"

    def _repr_html_(self) -> str:
        return self.frame()

    def frame(self, height: int = _HEIGHT) -> str:
        """The page inside of another one, as an HTML element; it takes no style from there."""
        return (
            f'<iframe title="{escape(self.title, quote=True)}" loading="lazy" '
            f'style="width:100%;height:{height}px;border:1px solid #ccc" '
            f'srcdoc="{escape(self.html, quote=True)}"></iframe>'
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the page to a file.

        Raises
        ------
        OSError
            If it cannot be written.
        """
        check_output(path)
        Path(path).write_text(self.html, encoding="utf-8")


def interactive(surface: PeriodMatrix | DeltaComplex, *, title: str = "") -> Viewer:
    """A surface to turn, with everything that there is to see of it.

    Parameters
    ----------
    surface : PeriodMatrix or DeltaComplex
        A period matrix brings its canonical cycles, the checkerboard and the length of the form
        of most even length, the cut, and where the bound originates.
    title : str
        What the page is called.

    Returns
    -------
    Viewer
        Without positions the surface is drawn in the plane: by the polygons that it was glued
        from, or developed by the form.

    Raises
    ------
    MissingExtraError
        If k3d or Pillow are not installed.
    ComplexError
        If the surface is a sphere without positions, or lies in more than 3 dimensions.
    """
    if isinstance(surface, PeriodMatrix):
        return viewer_of_scenes(
            scenes_of_matrix(surface), title=title or f"Surface of genus {surface.genus}"
        )
    return viewer_of_scenes(scenes_of_complex(surface), title=title or "Surface")


def viewer_of_scenes(
    scenes: Mapping[str, Scene], *, title: str, picture: Bytes | None = None, first: str = CYCLES
) -> Viewer:
    """A page that shows scenes of one surface.

    Parameters
    ----------
    scenes : mapping of str to Scene
        By what the controls call them; all have the same points and triangles.
    title : str
    picture : (height, width, 3) uint8, optional
        What is shown where a browser cannot draw.
    first : str
        The scene that is seen at first.

    Raises
    ------
    ValueError
        If there are no scenes, or their surfaces are not the same.
    MissingExtraError
        If k3d or Pillow are not installed.
    """
    require("a surface to turn", "k3d", "PIL")
    shapes = {(scene.V.shape, scene.F.shape) for scene in scenes.values()}
    if len(shapes) != 1:
        raise ValueError(f"scenes of one surface are shown, not of {len(shapes)} surfaces.")
    with stage("page to turn"):
        template, points = Template(_resource("viewer.html")), PagePoints.of(scenes.values())
        html = template.substitute(
            title=escape(title),
            picture=_picture(picture, title),
            layers=json.dumps(_layers(scenes, points, first)).replace("<", "\\u003c"),
            library=_packed(_library().encode()),
            snapshot=base64.b64encode(snapshot(scenes, points, first)).decode(),
            script=_resource("viewer.js"),
        )
    return Viewer(title, html)


def _resource(name: str) -> str:
    return files(__package__).joinpath(name).read_text("utf-8")


def _library() -> str:
    """The program of K3D; its fonts in files beside it, which nobody has, are left out."""
    source = files("k3d").joinpath("static", "standalone.js").read_text("utf-8")
    return re.sub(r',url\(fonts/[\w.-]+\) format\("\w+"\)', "", source)


def _packed(data: bytes) -> str:
    return base64.b64encode(zlib.compress(data, 9)).decode()


def _picture(picture: Bytes | None, title: str) -> str:
    if picture is None:
        return ""
    data = base64.b64encode(png_bytes(picture)).decode()
    return f'<img src="data:image/png;base64,{data}" alt="{escape(title, quote=True)}">'


# ---- What the controls know ----


def _layers(scenes: Mapping[str, Scene], points: PagePoints, first: str) -> dict[str, Any]:
    """Colourings, of which one is seen, curves, and where the eye is."""
    colourings: dict[str, dict[str, Any]] = {PLAIN: {}}
    plain = next(iter(scenes.values()))
    for name, scene in scenes.items():
        if _is_plain(scene):
            plain = scene
        else:
            colourings[name] = _colouring(name, scene, points.vertex)
    colourings[PLAIN] = _colouring(PLAIN, plain, points.vertex) | {
        "caption": _PLAIN_CAPTION,
        "legend": [],
    }
    if not _is_plain(plain):
        del colourings[PLAIN]
    return {
        "colourings": list(colourings.values()),
        "first": [*colourings].index(first if first in colourings else next(iter(colourings))),
        "curves": [
            {
                "name": name if _is_plain(scene) else _ZEROS,
                "visible": name == first,
                "legend": _legend(scene) if _is_plain(scene) else [],
            }
            for name, scene in scenes_with_curves(scenes)
        ],
        "camera": _camera(plain.V),
    }


def _is_plain(scene: Scene) -> bool:
    """Whether nothing is to be seen of the surface but its shape."""
    return scene.corner_uv is None and not np.ptp(scene.colours, axis=0).any()


def _colouring(name: str, scene: Scene, vertex: Ints) -> dict[str, Any]:
    """What a control tells of a colouring; no colours where there is a checkerboard."""
    rgb = np.rint(255.0 * scene.colours[vertex]).astype(np.uint32)
    colours = rgb @ np.array([1 << 16, 1 << 8, 1], dtype=np.uint32)
    return {
        "name": name,
        "caption": scene.caption,
        "legend": _legend(scene),
        "colours": None if scene.corner_uv is not None else _packed(colours.tobytes()),
    }


def _legend(scene: Scene) -> list[tuple[str, str]]:
    return [(name, f"#{packed_colour(colour):06x}") for name, colour in scene.legend]


def _camera(V: Floats) -> list[float]:
    """The places of the eye and of what it looks at, and the direction upwards."""
    eye, up = seen_from(V)
    centre = 0.5 * (V.max(axis=0) + V.min(axis=0))
    radius = float(np.linalg.norm(V - centre, axis=1).max())
    distance = radius / np.sin(np.radians(0.5 * ANGLE_OF_VIEW))
    return [*(centre + distance * eye).tolist(), *centre.tolist(), *up.tolist()]
