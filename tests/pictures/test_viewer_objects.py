"""What a page to turn is given: the scene again, no corner moved further than can be seen."""

import io
import zlib

import msgpack
import numpy as np
from PIL import Image

import igl_periods as ip
from igl_periods.pictures.all_scenes import (
    CHECKERBOARD,
    CUT,
    CYCLES,
    scenes_of_complex,
    scenes_of_matrix,
)
from igl_periods.pictures.tubes import diagonal
from igl_periods.pictures.viewer_objects import (
    PagePoints,
    packed_colour,
    png_bytes,
    scenes_with_curves,
    snapshot,
)


def objects(scenes, points, first=CYCLES):
    return msgpack.unpackb(zlib.decompress(snapshot(scenes, points, first)))["objects"]


def array(stored):
    return np.frombuffer(stored["data"], dtype=stored["dtype"]).reshape(stored["shape"])


def test_corners_are_where_they_were(torus):
    scenes = scenes_of_matrix(torus)
    board = scenes[CHECKERBOARD]
    points = PagePoints.of(scenes.values())
    assert np.array_equal(points.vertex[points.F], board.F)
    assert np.array_equal(points.uv[points.F], board.corner_uv)
    # No corner twice, and a vertex on the cut several times.
    assert len(board.V) < len(points.vertex) < board.F.size
    surface = objects(scenes, points)[0]
    assert surface["name"] == "surface"
    V, F = array(surface["vertices"]), array(surface["indices"])
    moved = np.linalg.norm(V[F] - board.V[board.F], axis=-1)
    assert moved.max() < 1e-5 * diagonal(board.V)
    np.testing.assert_allclose(np.linalg.norm(array(surface["normals"]), axis=1), 1.0, atol=0.01)
    assert surface["texture_wrap"] == "repeat"


def test_curves_are_named_after_their_scene_and_the_first_are_visible(torus):
    scenes = scenes_of_matrix(torus)
    curves = objects(scenes, PagePoints.of(scenes.values()), CUT)[1:]
    assert [name for name, _ in scenes_with_curves(scenes)] == [CYCLES, CUT]
    assert [(part["name"], part["visible"]) for part in curves] == [
        ("curves 0", False), ("curves 1", True), ("curves 1", True),
    ]  # fmt: skip
    tubes = array(curves[0]["colors"])
    assert set(tubes.tolist()) == {packed_colour(tube.colour) for tube in scenes[CYCLES].tubes}
    assert len(tubes) == 12 * sum(len(tube.points) for tube in scenes[CYCLES].tubes)


def test_colours_and_pictures_are_packed():
    assert packed_colour((1.0, 0.5, 0.0)) == 0xFF8000
    picture = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    assert np.array_equal(np.asarray(Image.open(io.BytesIO(png_bytes(picture)))), picture)


def test_the_second_sheet_of_a_double_is_left_out():
    V, F = [[0.0, 0, 0], [3, 0, 0], [0, 3, 0], [1, 1, 0.0]], [[0, 1, 3], [1, 2, 3], [2, 0, 3]]
    K = ip.double(ip.DeltaComplex.from_mesh(V, F))
    (scene,) = scenes_of_complex(K).values()
    assert len(PagePoints.of([scene]).F) == 3
