"""What a picture shows, as arrays: coloured or textured triangles, tubes, balls, a caption."""

from __future__ import annotations

from dataclasses import dataclass

from igl_periods.arrays import Floats, Ints
from igl_periods.display import arrays_repr


@dataclass(frozen=True, eq=False)
class Tube:
    """A curve: its points (k, 3), the normals of the surface there, its colour; closed or not."""

    __repr__ = arrays_repr

    points: Floats
    normals: Floats
    colour: tuple[float, float, float]
    closed: bool = True


@dataclass(frozen=True, eq=False)
class Scene:
    """What a picture shows.

    Attributes
    ----------
    V, F : (n, 3) float, (m, 3) int
        The surface.
    colours : (n, 3) float
        RGB of the vertices, between 0 and 1.
    corner_uv : (m, 3, 2) float or None
        Where the corners lie on the checkerboard, of period 1 in both directions; the colours of
        the vertices do not matter then.
    tubes : tuple of Tube
    balls : tuple of ((k, 3) float, float, colour)
        Points, and their radius in diagonals of the surface.
    legend : tuple of (str, colour)
        What the colours mean.
    caption : str
        What is to be seen, in words.
    """

    __repr__ = arrays_repr

    V: Floats
    F: Ints
    colours: Floats
    corner_uv: Floats | None = None
    tubes: tuple[Tube, ...] = ()
    balls: tuple[tuple[Floats, float, tuple[float, float, float]], ...] = ()
    legend: tuple[tuple[str, tuple[float, float, float]], ...] = ()
    caption: str = ""
