"""Pictures of scenes: in a file, on a machine without a display, or in a window.

They are drawn by Open3D in a process of their own (:mod:`igl_periods.pictures.drawing`).  What
Open3D and its drivers do when something is missing, to abort or to wait for ever, ends in a
message then.
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Bytes, Floats
from igl_periods.errors import RenderError
from igl_periods.machine import require
from igl_periods.run_log import stage

from .scene import Scene

_LARGEST = 4096
# How long a picture may take, in seconds: many times what drivers in software were seen to take,
# at the start, for a pixel, and for a triangle: a busy machine is no reason to give up.
_START, _PIXEL, _TRIANGLE = 300.0, 1e-4, 1e-4
# What Open3D does when it is taken down again is of no interest.
_PROGRAM = """
import os, sys
from igl_periods.pictures.drawing import main
main(sys.argv[1])
os._exit(0)
"""


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
    MissingExtraError
        If Open3D is not installed.
    RenderError
        If a system library or a driver it needs is missing, or it does not come to an end.
    ValueError
        If the size is not between 1 and 4096, or the direction is 0.
    """
    (picture,) = _drawn([(scene, *seen_from(scene.V, direction))], _checked(size))
    return picture


def render_all(scenes: Iterable[Scene], size: tuple[int, int] = (1200, 900)) -> list[Bytes]:
    """Draw scenes as :func:`render` does: faster than one after the other.

    Raises
    ------
    MissingExtraError
        If Open3D is not installed.
    RenderError
        If a system library or a driver it needs is missing, or it does not come to an end.
    ValueError
        If the size is not between 1 and 4096.
    """
    return _drawn([(scene, *seen_from(scene.V)) for scene in scenes], _checked(size))


def _checked(size: tuple[int, int]) -> tuple[int, int]:
    width, height = size
    if not 1 <= min(size) <= max(size) <= _LARGEST:
        raise ValueError(
            f"a picture of {width} x {height} pixels: both must be between 1 and {_LARGEST}."
        )
    return size


def _drawn(views: list[tuple[Scene, Floats, Floats]], size: tuple[int, int]) -> list[Bytes]:
    """Pictures of scenes, each with the directions to the eye and upwards."""
    triangles = sum(len(scene.F) for scene, _, _ in views)
    pixels = len(views) * size[0] * size[1]
    seconds = _START + _PIXEL * pixels + _TRIANGLE * triangles
    with stage("drawing"), tempfile.TemporaryDirectory(prefix="igl-periods-") as folder:
        _run_open3d(Path(folder), ("draw", views, size), seconds)
        return list(np.load(Path(folder, "pictures.npy")))


def show(scene: Scene, title: str = "igl-periods") -> None:
    """Show a scene in a window, until it is closed.

    Raises
    ------
    MissingExtraError
        If Open3D is not installed.
    RenderError
        If a system library or a driver it needs is missing, or there is no display.
    """
    check_display()
    with tempfile.TemporaryDirectory(prefix="igl-periods-") as folder:
        _run_open3d(Path(folder), ("show", scene, title), None)


def check_display() -> None:
    """Raise RenderError unless there is a display to open a window on."""
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise RenderError(
            "there is no display to open a window on (DISPLAY is not set). Draw to a file instead: "
            "igl-periods render MESH -o picture.png"
        )


def with_legend(picture: Bytes, scene: Scene) -> Bytes:
    """The picture with the names of the colours of a scene at its lower edge."""
    require("a legend", "PIL")
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
    require("writing a picture", "PIL")
    from PIL import Image

    Image.fromarray(picture).save(Path(path))


def _run_open3d(folder: Path, task: tuple[Any, ...], seconds: float | None) -> None:
    """Have :func:`igl_periods.pictures.drawing.main` do something, within some time."""
    require("drawing", "open3d")
    (folder / "task").write_bytes(pickle.dumps(task))
    # What is imported there is what is imported here; it runs in an empty folder.
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))}
    if task[0] == "draw":
        environment.setdefault("EGL_PLATFORM", "surfaceless")
    try:
        ended = subprocess.run(
            [sys.executable, "-c", _PROGRAM, str(folder)],
            check=False,
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=seconds,
        )
    except subprocess.TimeoutExpired as error:
        raise RenderError(
            f"Open3D has not drawn the picture in {error.timeout:.0f} s, and was ended. Drivers "
            "that draw in software may hang: a newer Mesa is likely to help, or a smaller --size."
        ) from error
    if (folder / "error").exists():
        raise RenderError((folder / "error").read_text("utf-8"))
    if ended.returncode != 0:
        raise RenderError(_last_words(ended))


def _last_words(ended: subprocess.CompletedProcess[bytes]) -> str:
    """How a process ended that should not have, and the last that it said."""
    how = f"with exit code {ended.returncode}"
    if ended.returncode < 0:
        how = f"by {signal.Signals(-ended.returncode).name}"
    said = ended.stderr.decode(errors="replace").split("\n")
    words = [line.strip() for line in said if line.strip()][-1:] or ["nothing"]
    return f"Open3D was ended while drawing, {how}. The last that it said: {words[0]}"


def seen_from(V: Floats, direction: ArrayLike | None = None) -> tuple[Floats, Floats]:
    """Unit vectors from the surface to the eye, and upwards in the picture.

    Without a direction a surface is seen from its flattest side, one in the plane from above.
    """
    if direction is None and not np.ptp(V[:, 2]):
        return np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])
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
