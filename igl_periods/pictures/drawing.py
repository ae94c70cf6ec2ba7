"""Drawing with Open3D, in a process that does nothing else and may be ended at any time."""

from __future__ import annotations

import pickle
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import igl
import numpy as np

from igl_periods.arrays import Bools, Bytes, Floats, Ints
from igl_periods.errors import RenderError
from igl_periods.machine import missing_library

from .drivers import check_egl, check_vulkan
from .scene import Scene
from .scenes import TUBE, checkerboard
from .tubes import diagonal, tube

_SUN, _SKY = 45_000.0, 20_000.0
_FIELD_OF_VIEW = 30.0
_GAMMA = 2.2
# Pictures are drawn this many times larger and averaged, so that edges are smooth.
_OVERSAMPLING = 2
_CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
_DITHERED_WHITE = 252.0
_BACKGROUND = (1.0, 1.0, 1.0, 1.0)


def main(folder: str) -> None:
    """Do what the file ``task`` of a folder says; the outcome is ``pictures.npy`` or ``error``."""
    place = Path(folder)
    # Our own file.  The half of Open3D that is about learning takes a second to import.
    task, *arguments = pickle.loads((place / "task").read_bytes())
    sys.modules.setdefault("open3d.ml", ModuleType("open3d.ml"))
    try:
        if task == "show":
            show(*arguments)
        else:
            np.save(place / "pictures.npy", draw(*arguments))
    except RenderError as error:
        (place / "error").write_text(str(error), encoding="utf-8")


def draw(views: list[tuple[Scene, Floats, Floats]], size: tuple[int, int]) -> Bytes:
    """Pictures of scenes, (k, height, width, 3); each has directions to the eye and upwards."""
    o3d = load_open3d()
    if _draws_with_egl(o3d):
        check_egl()
    else:
        check_vulkan()
    width, height = (_OVERSAMPLING * pixels for pixels in size)
    renderer = o3d.visualization.rendering.OffscreenRenderer(width, height)
    return np.stack([_draw(o3d, renderer, view, size) for view in views])


def _draw(
    o3d: ModuleType, renderer: Any, view: tuple[Scene, Floats, Floats], size: tuple[int, int]
) -> Bytes:
    scene, eye, up = view
    renderer.scene.clear_geometry()
    _light(o3d, renderer, eye, up)
    for name, geometry, material in geometries(o3d, scene):
        renderer.scene.add_geometry(name, geometry, material)
    _aim(renderer, scene.V, eye, up, size[0] / size[1])
    picture = np.asarray(renderer.render_to_image()).astype(np.float64)
    picture[_background(o3d, renderer, picture)] = 255.0
    fine = picture.reshape(size[1], _OVERSAMPLING, size[0], _OVERSAMPLING, 3)
    return np.rint(fine.mean(axis=(1, 3))).astype(np.uint8)


def _background(o3d: ModuleType, renderer: Any, picture: Floats) -> Bools:
    """Where nothing is: 0.19 dithers white there, 0.20 colours it, but the depth is infinite."""
    if _draws_with_egl(o3d):
        return picture.min(axis=-1) >= _DITHERED_WHITE
    return np.isinf(np.asarray(renderer.render_to_depth_image(z_in_view_space=True)))


def show(scene: Scene, title: str) -> None:
    """Show a scene in a window, until it is closed."""
    o3d = load_open3d()
    if not _draws_with_egl(o3d):
        check_vulkan()
    parts = [
        {"name": name, "geometry": geometry, "material": material}
        for name, geometry, material in geometries(o3d, scene)
    ]
    o3d.visualization.draw(parts, title=title, show_skybox=False, bg_color=_BACKGROUND)


def load_open3d() -> ModuleType:
    """The module ``open3d``, which tells nothing but errors.

    Raises
    ------
    RenderError
        If a system library is missing.
    """
    try:
        import open3d
    except (ImportError, OSError) as error:
        raise RenderError(
            f"Open3D, which draws the pictures, cannot start: {missing_library(error)}"
        ) from error
    open3d.utility.set_verbosity_level(open3d.utility.VerbosityLevel.Error)
    return open3d


def _draws_with_egl(o3d: ModuleType) -> bool:
    return tuple(int(number) for number in o3d.__version__.split(".")[:2]) < (0, 20)


def _light(o3d: ModuleType, renderer: Any, eye: Floats, up: Floats) -> None:
    rendering = o3d.visualization.rendering
    renderer.scene.set_background(_BACKGROUND)
    grading = rendering.ColorGrading(
        rendering.ColorGrading.Quality.ULTRA, rendering.ColorGrading.ToneMapping.LINEAR
    )
    renderer.scene.view.set_color_grading(grading)
    # Light from behind the left shoulder, and some from everywhere.
    sun = -(eye + 0.7 * up + 0.5 * np.cross(eye, up))
    renderer.scene.scene.set_sun_light(sun, (1.0, 1.0, 1.0), _SUN)
    renderer.scene.scene.enable_sun_light(True)
    renderer.scene.scene.set_indirect_light_intensity(_SKY)


def _aim(renderer: Any, V: Floats, eye: Floats, up: Floats, aspect: float) -> None:
    """Look at the middle of the surface from where it fills the picture."""
    centre = 0.5 * (V.max(axis=0) + V.min(axis=0))
    distance = _distance(V - centre, eye, up, aspect)
    renderer.setup_camera(_FIELD_OF_VIEW, centre, centre + distance * eye, up)


def _distance(V: Floats, eye: Floats, up: Floats, aspect: float) -> float:
    """Distance of the eye from the origin at which the points fill the picture."""
    slope = 0.93 * np.tan(np.radians(0.5 * _FIELD_OF_VIEW))
    sideways, upwards = np.abs(V @ np.cross(up, eye)), np.abs(V @ up)
    return float(np.max(V @ eye + np.maximum(sideways / aspect, upwards) / slope))


def geometries(o3d: ModuleType, scene: Scene) -> Iterator[tuple[str, Any, Any]]:
    """The name, the mesh and the material of each part of a scene."""
    yield "surface", _surface(o3d, scene), _material(o3d, scene.corner_uv is not None)
    size = diagonal(scene.V)
    parts = [
        (*tube(curve.points, curve.normals, TUBE * size, curve.closed), curve.colour)
        for curve in scene.tubes
    ]
    parts += [
        (*_balls(o3d, points, radius * size), colour)
        for points, radius, colour in scene.balls
        if len(points)
    ]
    if parts:
        start = np.cumsum([0, *(len(V) for V, _, _ in parts[:-1])])
        V = np.concatenate([V for V, _, _ in parts])
        F = np.concatenate([F + first for (_, F, _), first in zip(parts, start, strict=True)])
        colours = np.concatenate([np.tile(colour, (len(V), 1)) for V, _, colour in parts])
        yield "marks", _mesh(o3d, V, F, colours), _material(o3d)


def _balls(o3d: ModuleType, points: Floats, radius: float) -> tuple[Floats, Ints]:
    ball = o3d.geometry.TriangleMesh.create_sphere(radius, resolution=10)
    V, F = np.asarray(ball.vertices), np.asarray(ball.triangles).astype(np.int64)
    faces = F + len(V) * np.arange(len(points))[:, None, None]
    return (points[:, None] + V).reshape(-1, 3), faces.reshape(-1, 3)


def _surface(o3d: ModuleType, scene: Scene) -> Any:
    mesh = _mesh(o3d, scene.V, scene.F, scene.colours)
    if scene.corner_uv is not None:
        mesh.triangle_uvs = o3d.utility.Vector2dVector(scene.corner_uv.reshape(-1, 2))
        mesh.triangle_material_ids = o3d.utility.IntVector(np.zeros(len(scene.F), dtype=np.int32))
        mesh.textures = [o3d.geometry.Image(checkerboard())]
    return mesh


def _mesh(o3d: ModuleType, V: Floats, F: Ints, colours: Floats) -> Any:
    mesh = o3d.geometry.TriangleMesh(
        o3d.utility.Vector3dVector(V), o3d.utility.Vector3iVector(F.astype(np.int32))
    )
    # Vertices of the other sheet of a double have no face, hence no normal.
    normals = np.nan_to_num(igl.per_vertex_normals(V, F))
    # The engine takes them for linear; colours are meant as they appear on a screen.
    mesh.vertex_colors = o3d.utility.Vector3dVector(np.asarray(colours) ** _GAMMA)
    mesh.vertex_normals = o3d.utility.Vector3dVector(normals)
    # Also without a texture: 0.20 looks for one where there is none, and draws white spots where
    # the coordinates are constant in a face, or left to chance.
    mesh.triangle_uvs = o3d.utility.Vector2dVector(np.tile(_CORNERS, (len(F), 1)))
    return mesh


def _material(o3d: ModuleType, textured: bool = False) -> Any:
    material = o3d.visualization.rendering.MaterialRecord()
    material.shader = "defaultLit"
    material.base_roughness = 0.7
    material.base_reflectance = 0.3
    if textured:
        material.albedo_img = o3d.geometry.Image(checkerboard())
    return material
