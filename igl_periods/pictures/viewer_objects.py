"""What a page to turn draws: one surface, curves and points, packed for K3D.

The surface is there once.  A point of it that lies at several places of the checkerboard, on the
cut, is there several times.  Coordinates and normals are rounded to what can be seen, so that they
can be compressed.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import igl
import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Bytes, Floats, Ints

from .scene import Scene, Tube
from .scenes import TUBE, checkerboard
from .tubes import diagonal, tube

# Of the camera, from top to bottom, in degrees.
ANGLE_OF_VIEW = 40.0
# Layers of a transparent surface that are told apart along a ray.
_DEPTH_PEELS = 0
# To what coordinates are rounded, in diagonals of the surface, and normals.
_STEP, _NORMAL_STEP = 2.0**-17, 2.0**-8


def packed_colour(colour: tuple[float, float, float]) -> int:
    """Red, green and blue in one integer, eight bits each."""
    red, green, blue = (round(255 * part) for part in colour)
    return red << 16 | green << 8 | blue


def png_bytes(picture: Bytes) -> bytes:
    """A picture as a PNG file."""
    from PIL import Image

    stream = io.BytesIO()
    Image.fromarray(picture).save(stream, format="PNG")
    return stream.getvalue()


def scenes_with_curves(scenes: Mapping[str, Scene]) -> list[tuple[str, Scene]]:
    """The scenes with curves or points."""
    return [(name, s) for name, s in scenes.items() if s.tubes or any(len(b[0]) for b in s.balls)]


@dataclass(frozen=True, eq=False)
class PagePoints:
    """The points of the page: each has one place on the checkerboard, if there is one.

    ``vertex`` (k,) are the points of the scenes, ``uv`` (k, 2), ``F`` (m, 3) the triangles.
    """

    vertex: Ints
    uv: Floats
    F: Ints

    @classmethod
    def of(cls, scenes: Iterable[Scene]) -> PagePoints:
        """The corners of the triangles, those at the same place once."""
        some = list(scenes)
        F = some[0].F
        uv = next((s.corner_uv for s in some if s.corner_uv is not None), np.zeros((*F.shape, 2)))
        corners = np.column_stack([F.ravel(), uv.reshape(-1, 2)])
        _, first, point = np.unique(corners, axis=0, return_index=True, return_inverse=True)
        return cls(F.ravel()[first], uv.reshape(-1, 2)[first], point.reshape(F.shape))


def snapshot(scenes: Mapping[str, Scene], points: PagePoints, first: str) -> bytes:
    """The surface and the curves, as K3D packs them.

    The i-th curves have the name ``curves i``; those of the scene ``first`` are visible.
    """
    import k3d

    plot = k3d.plot(
        camera_auto_fit=False,
        grid_visible=False,
        menu_visibility=False,
        axes_helper=0.0,
        camera_fov=ANGLE_OF_VIEW,
        lighting=1.6,
        depth_peels=_DEPTH_PEELS,
        name=None,
    )
    plot += _surface(next(iter(scenes.values())), points)
    for i, (name, scene) in enumerate(scenes_with_curves(scenes)):
        for part in _curves(scene, f"curves {i}"):
            part.visible = name == first
            plot += part
    return bytes(plot.get_binary_snapshot(9))


def _surface(scene: Scene, points: PagePoints) -> Any:
    import k3d

    V, normals = scene.V, np.nan_to_num(igl.per_vertex_normals(scene.V, scene.F))
    return k3d.mesh(
        _short(V, diagonal(V) * _STEP)[points.vertex],
        points.F.astype(np.uint32),
        normals=_short(normals, _NORMAL_STEP)[points.vertex],
        uvs=points.uv.astype(np.float32),
        texture=png_bytes(checkerboard()),
        texture_wrap="repeat",
        texture_file_format="png",
        color=0xFFFFFF,
        flat_shading=False,
        side="double",
        roughness=0.6,
        name="surface",
    )


def _curves(scene: Scene, name: str) -> Iterator[Any]:
    """Tubes, as one mesh, and points."""
    import k3d

    size = diagonal(scene.V)
    if scene.tubes:
        V, F, colours = _as_mesh(scene.tubes, TUBE * size)
        yield k3d.mesh(
            V.astype(np.float32),
            F.astype(np.uint32),
            colors=colours,
            flat_shading=False,
            side="double",
            name=name,
        )
    for places, radius, colour in scene.balls:
        if len(places):
            yield k3d.points(
                places.astype(np.float32),
                point_size=2.0 * radius * size,
                shader="3d",
                color=packed_colour(colour),
                name=name,
            )


def _as_mesh(tubes: tuple[Tube, ...], radius: float) -> tuple[Floats, Ints, NDArray[np.uint32]]:
    """Points, triangles and colours of all tubes together."""
    meshes = [tube(curve.points, curve.normals, radius, curve.closed) for curve in tubes]
    sizes = [len(V) for V, _ in meshes]
    start = np.cumsum([0, *sizes])
    F = np.concatenate([F + first for (_, F), first in zip(meshes, start)])
    colours = [packed_colour(curve.colour) for curve in tubes]
    packed = np.repeat(np.array(colours, dtype=np.uint32), sizes)
    return np.concatenate([V for V, _ in meshes]), F, packed


def _short(numbers: Floats, step: float) -> NDArray[np.float32]:
    """Numbers rounded to multiples of a step, which can be compressed better."""
    return (np.rint(numbers / step) * step).astype(np.float32)
