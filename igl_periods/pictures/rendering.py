"""Pictures of scenes, with Open3D: in a file, on a machine without a display, or in a window.

Open3D is imported when the first picture is made, and never before.
"""

from __future__ import annotations

import ctypes
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import igl
import numpy as np
from numpy.typing import ArrayLike, NDArray

from igl_periods.arrays import Bytes, Floats
from igl_periods.errors import RenderError
from igl_periods.run_log import stage

from .scenes import TUBE, Scene, checkerboard
from .tubes import diagonal, tube

# Debian's packages of the libraries that Open3D loads.
_PACKAGES = {
    "libGL": "libgl1",
    "libEGL": "libegl1",
    "libX11": "libx11-6",
    "libgomp": "libgomp1",
    "libusb-1.0": "libusb-1.0-0",
}
_SURFACELESS = 0x31DD  # EGL_PLATFORM_SURFACELESS_MESA
_SUN, _SKY = 45_000.0, 20_000.0
_FIELD_OF_VIEW = 30.0
_GAMMA = 2.2
# Pictures are drawn this many times larger and averaged, so that edges are smooth.
_OVERSAMPLING = 2
_LARGEST = 4096
_NEARLY_WHITE = 252.0
_BACKGROUND = (1.0, 1.0, 1.0, 1.0)


def render(
    scene: Scene, size: tuple[int, int] = (1200, 900), direction: ArrayLike | None = None
) -> Bytes:
    """Draw a scene without a display.

    Parameters
    ----------
    scene : Scene
    size : (int, int)
        Width and height in pixels.
    direction : (3,) array-like, optional
        From the surface to the eye.  By default the surface is seen from its flattest side, its
        longest direction horizontal.

    Returns
    -------
    (height, width, 3) uint8

    Raises
    ------
    RenderError
        If Open3D or a system library it needs is missing, or there is no way to draw.
    ValueError
        If the size is not between 1 and 4096, or the direction is 0.
    """
    width, height = size
    if not 1 <= min(size) <= max(size) <= _LARGEST:
        raise ValueError(
            f"a picture of {width} x {height} pixels: both must be between 1 and {_LARGEST}."
        )
    eye, up = _camera(scene.V, direction)
    o3d = _open3d()
    _check_egl()
    with stage("drawing"):
        fine = _OVERSAMPLING
        with _silence():
            renderer = o3d.visualization.rendering.OffscreenRenderer(fine * width, fine * height)
        _fill(o3d, renderer, scene, eye, up)
        centre = 0.5 * (scene.V.max(axis=0) + scene.V.min(axis=0))
        distance = _distance(scene.V - centre, eye, up, width / height)
        renderer.setup_camera(_FIELD_OF_VIEW, centre, centre + distance * eye, up)
        picture = np.asarray(renderer.render_to_image()).astype(np.float64)
    picture = picture.reshape(height, fine, width, fine, 3).mean(axis=(1, 3))
    # The engine dithers: the background is white but for that.
    picture[(picture > _NEARLY_WHITE).all(axis=2)] = 255.0
    return np.rint(picture).astype(np.uint8)


def show(scene: Scene, title: str = "igl-periods") -> None:
    """Show a scene in a window, until it is closed.

    Raises
    ------
    RenderError
        If Open3D or a system library it needs is missing, or there is no display.
    """
    check_display()
    o3d = _open3d(surfaceless=False)
    parts = [
        {"name": name, "geometry": geometry, "material": material}
        for name, geometry, material in _geometries(o3d, scene)
    ]
    o3d.visualization.draw(parts, title=title, show_skybox=False, bg_color=_BACKGROUND)


def check_display() -> None:
    """Raise RenderError unless there is a display to open a window on."""
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise RenderError(
            "there is no display to open a window on (DISPLAY is not set). Draw to a file instead: "
            "igl-periods render MESH -o picture.png"
        )


def with_legend(picture: Bytes, scene: Scene) -> Bytes:
    """The picture with the names of the colours of a scene at its lower edge."""
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(picture)
    draw, size = ImageDraw.Draw(image), max(10, image.height // 32)
    font = ImageFont.load_default(size)
    x, y = size, image.height - 2 * size
    for name, colour in scene.legend:
        draw.rectangle((x, y, x + size, y + size), fill=tuple(int(255 * c) for c in colour))
        draw.text((x + 1.4 * size, y + 0.5 * size), name, fill=(40, 40, 40), font=font, anchor="lm")
        x += round(2.4 * size + draw.textlength(name, font=font))
    return np.asarray(image)


def save(path: str | os.PathLike[str], picture: Bytes) -> None:
    """Write a picture to a PNG or JPEG file."""
    from PIL import Image

    Image.fromarray(picture).save(Path(path))


def _fill(o3d: ModuleType, renderer: Any, scene: Scene, eye: Floats, up: Floats) -> None:
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
    for name, geometry, material in _geometries(o3d, scene):
        renderer.scene.add_geometry(name, geometry, material)


def _geometries(o3d: ModuleType, scene: Scene) -> Iterator[tuple[str, Any, Any]]:
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


def _balls(o3d: ModuleType, points: Floats, radius: float) -> tuple[Floats, NDArray[np.int64]]:
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


def _mesh(o3d: ModuleType, V: Floats, F: NDArray[np.int64], colours: Floats) -> Any:
    mesh = o3d.geometry.TriangleMesh(
        o3d.utility.Vector3dVector(V), o3d.utility.Vector3iVector(F.astype(np.int32))
    )
    # Vertices of the other sheet of a double have no face, hence no normal.
    normals = np.nan_to_num(igl.per_vertex_normals(V, F))
    # The engine takes them for linear; colours are meant as they appear on a screen.
    mesh.vertex_colors = o3d.utility.Vector3dVector(np.asarray(colours) ** _GAMMA)
    mesh.vertex_normals = o3d.utility.Vector3dVector(normals)
    return mesh


def _material(o3d: ModuleType, textured: bool = False) -> Any:
    material = o3d.visualization.rendering.MaterialRecord()
    material.shader = "defaultLit"
    material.base_roughness = 0.7
    material.base_reflectance = 0.3
    if textured:
        material.albedo_img = o3d.geometry.Image(checkerboard())
    return material


def _camera(V: Floats, direction: ArrayLike | None) -> tuple[Floats, Floats]:
    """Unit vectors from the surface to the eye, and upwards in the picture."""
    axes = np.linalg.svd(V - V.mean(axis=0), full_matrices=False)[2]
    largest = np.take_along_axis(axes, np.abs(axes).argmax(axis=1)[:, None], axis=1)
    longest, middle, least = axes * np.sign(largest)
    eye = least + 0.45 * middle + 0.2 * longest
    if direction is not None:
        eye = np.asarray(direction, dtype=np.float64)
        if eye.shape != (3,) or not np.isfinite(eye).all() or not eye.any():
            raise ValueError(f"a direction is three numbers, not all 0; got {direction}.")
    eye = eye / np.linalg.norm(eye)
    up = middle - (middle @ eye) * eye
    if np.linalg.norm(up) < 0.1:
        up = longest - (longest @ eye) * eye
    return eye, up / np.linalg.norm(up)


def _distance(V: Floats, eye: Floats, up: Floats, aspect: float) -> float:
    """Distance of the eye from the origin at which the points fill the picture."""
    slope = 0.93 * np.tan(np.radians(0.5 * _FIELD_OF_VIEW))
    sideways, upwards = np.abs(V @ np.cross(up, eye)), np.abs(V @ up)
    return float(np.max(V @ eye + np.maximum(sideways / aspect, upwards) / slope))


def _open3d(surfaceless: bool = True) -> ModuleType:
    if surfaceless:
        os.environ.setdefault("EGL_PLATFORM", "surfaceless")
    try:
        import open3d
    except (ImportError, OSError) as error:
        raise RenderError(
            f"Open3D, which draws the pictures, cannot start: {_missing(error)}"
        ) from error
    open3d.utility.set_verbosity_level(open3d.utility.VerbosityLevel.Error)
    return open3d


def _missing(error: Exception) -> str:
    """What to install, from an error of the loader."""
    library = re.search(r"(lib[\w.+-]*?)\.so[.\d]*", str(error))
    if library is None:
        return f"{error}. Install it: pip install open3d"
    package = _PACKAGES.get(library[1])
    hint = f" (on Debian and Ubuntu: apt-get install {package})" if package else ""
    return f"the system library {library[0]} is missing{hint}."


def _check_egl() -> None:
    """Raise unless EGL starts without a display: Open3D would end the whole program instead."""
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError as error:
        raise RenderError(f"cannot draw without a display: {_missing(error)}") from error
    egl.eglGetPlatformDisplay.restype = egl.eglGetDisplay.restype = ctypes.c_void_p
    for display in (egl.eglGetPlatformDisplay(_SURFACELESS, None, None), egl.eglGetDisplay(None)):
        if display and egl.eglInitialize(ctypes.c_void_p(display), None, None):
            return
    raise RenderError(
        "cannot draw without a display: EGL finds no driver. The software renderer of Mesa is one "
        "(on Debian and Ubuntu: apt-get install libegl-mesa0 libgl1-mesa-dri)."
    )


@contextmanager
def _silence() -> Iterator[None]:
    """Keep what the engine tells about itself off standard output and standard error."""
    saved = [os.dup(1), os.dup(2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        yield
    finally:
        os.dup2(saved[0], 1)
        os.dup2(saved[1], 2)
        for descriptor in (*saved, nowhere):
            os.close(descriptor)
