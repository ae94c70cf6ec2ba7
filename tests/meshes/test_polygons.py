"""Polygons divided into triangles: concave ones, straight corners, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.meshes.polygons import triangulated

CASES = Path(__file__).parent / "cases"
ROTATION = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
ROTATION *= np.linalg.det(ROTATION)

L_OF_EIGHT = [(3, -1), (1, -1), (-1, -1), (-1, 1), (-1, 3), (-3, 3), (-3, -3), (3, -3)]
OUTLINES = {
    "L with straight corners": L_OF_EIGHT,
    "dart": [(2, -1), (0, 2), (-2, -1), (0, 0)],
    "square with a straight first corner": [(1, 0), (2, 0), (2, 2), (0, 2), (0, 0)],
    "square with a straight second corner": [(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)],
    "all sides halved": [(0, 0), (1, 0), (2, 0), (1, 1), (0, 2), (0, 1)],
    "convex after halves": [(0, 0), (0.1, 0), (0.4, 0), (1, 0), (1, 1), (0.3, 1), (0, 1)],
    "comb": [(9, -1), (9, 5), (8, 0), (7, 5), (6, 0), (5, 5), (4, 0), (3, 5), (2, 0), (2, -1)],
    "spiral": [(0, 0), (5, 0), (5, 5), (0, 5), (0, 2), (3, 2), (3, 3), (1, 3), (1, 4), (4, 4),
               (4, 1), (0, 1)],
    "eight that touches": [(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)],
    "hole with a slit": [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1),
                         (1, 1)],
}  # fmt: skip


def lifted(outline, scale=1.0):
    """The outline in a plane of space; equal corners are one vertex."""
    points, corners = np.unique(np.array(outline, float), axis=0, return_inverse=True)
    V = np.column_stack([points, np.zeros(len(points))]) @ ROTATION.T
    return scale * (V + 0.3), corners.ravel(), ROTATION[:, 2]


def shoelace(outline) -> float:
    x, y = np.array(outline, float).T
    return 0.5 * float(x @ np.roll(y, -1) - np.roll(x, -1) @ y)


def doubled_areas(V, F):
    return np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])


def boundary(F):
    """Sides of triangles whose reverse is not a side."""
    sides = [(int(a), int(b)) for f in F for a, b in zip(f, np.roll(f, -1))]
    for side in list(sides):
        if side[::-1] in sides and side in sides:
            sides.remove(side)
            sides.remove(side[::-1])
    return sorted(sides)


@pytest.mark.parametrize("scale", [1.0, 1e-150, 1e150])
@pytest.mark.parametrize("first", range(0, 12, 3))
@pytest.mark.parametrize("name", OUTLINES)
def test_triangles_fill_the_outline_and_nothing_else(name, first, scale):
    outline = np.roll(OUTLINES[name], -first, axis=0)
    V, corners, normal = lifted(outline, scale)
    result = triangulated(V, corners, np.array([len(corners)]))
    areas = doubled_areas(V / scale, result.F) @ normal / 2
    # All on the same side, none flat, their sum the area of the outline.
    assert areas.min() > 1e-3
    np.testing.assert_allclose(areas.sum(), shoelace(outline), rtol=1e-12)
    # Triangles whose boundary is the outline: every side is a side of one triangle.
    assert len(result.F) == len(corners) - 2 * (1 + (name == "eight that touches"))
    outer = [(int(a), int(b)) for a, b in zip(corners, np.roll(corners, -1))]
    assert boundary(result.F) == sorted(s for s in outer if s[::-1] not in outer)
    assert result.not_planar == 0
    assert result.fanned + result.clipped == 1


def test_convex_polygons_keep_their_fans():
    rng = np.random.default_rng(1)
    angle = np.sort(rng.random((50, 7)), axis=1) * 2 * np.pi
    V = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1).reshape(-1, 3) @ ROTATION.T
    corners = np.arange(len(V))
    result = triangulated(V, corners, np.full(50, 7))
    expected = [[7 * f, 7 * f + i, 7 * f + i + 1] for f in range(50) for i in range(1, 6)]
    assert result.F.tolist() == expected
    assert (result.fanned, result.clipped, result.not_planar) == (50, 0, 0)


def test_a_dart_is_cut_at_its_reflex_corner_wherever_it_begins():
    dart = np.array(OUTLINES["dart"], float)
    for first in range(4):
        V, corners, _ = lifted(np.roll(dart, -first, axis=0))
        F = triangulated(V, corners, np.array([4])).F
        reflex = int(np.flatnonzero(np.abs(V - V[corners[(3 - first) % 4]]).max(axis=1) == 0)[0])
        assert (F == reflex).any(axis=1).all()


@pytest.mark.parametrize("single", [False, True])
def test_straight_corners_that_are_rounded_make_no_slivers(single):
    rng = np.random.default_rng(4)
    for _ in range(40):
        k = int(rng.integers(3, 6))
        angle = 2 * np.pi * np.arange(k) / k
        C = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        sides = [np.r_[0, np.sort(rng.uniform(0.1, 0.9, rng.integers(0, 4)))] for _ in range(k)]
        outline = np.vstack(
            [C[i] + s[:, None] * (C[(i + 1) % k] - C[i]) for i, s in enumerate(sides)]
        )
        if single:
            outline = outline[np.r_[True, np.linalg.norm(np.diff(outline, axis=0), axis=1) > 0.02]]
        V, corners, normal = lifted(outline)
        if single:
            V = V.astype(np.float32).astype(float)
        F = triangulated(V, corners, np.array([len(corners)])).F
        a, b, c = (np.linalg.norm(V[F[:, i]] - V[F[:, i - 1]], axis=1) for i in range(3))
        heights = (
            doubled_areas(V, F) @ normal / np.sort(np.stack([a, b, c]), axis=0)[:2].prod(axis=0)
        )
        assert heights.min() > 1e-3


def test_the_square_frame_of_two_ells_has_a_period_matrix_with_its_symmetry():
    V, F, report = ip.load_mesh(CASES / "frame_of_ells.obj")
    assert (report.faces, report.polygons_clipped, report.polygons_fanned) == (14, 3, 11)
    assert "14 polygons divided into triangles, 3 of them concave" in str(report)
    np.testing.assert_allclose(
        np.linalg.norm(doubled_areas(V, F), axis=1).sum() / 2, 96, rtol=1e-14
    )
    pm = ip.period_matrix(V, F, tolerance=1e-7)
    tau = pm.reduced().matrix[0, 0]
    assert abs(tau - 2.0030019j) < 2e-7


CROSSING = {
    "bow tie": [(0, 0), (2, 2), (2, 0), (0, 2)],
    "pentagram": [(np.cos(4 * np.pi * k / 5), np.sin(4 * np.pi * k / 5)) for k in range(5)],
    "uneven bow tie": [(0, 0), (3, 0), (0, 1), (3, 1)],
    "eight through a common corner": [(0, 0), (1, 1), (2, 2), (2, 0), (1, 1), (0, 2)],
    "twice around": [(0, 0), (1, 0), (0, 1), (0, 0), (1, 0), (0, 1)],
}


@pytest.mark.parametrize("name", CROSSING)
def test_outlines_that_cross_themselves_are_refused_with_face_and_place(name):
    square = [(9, 9), (10, 9), (10, 10), (9, 10)]
    V, corners, _ = lifted(square + CROSSING[name])
    with pytest.raises(
        ip.MeshError, match=r"face 1 \(counted from 0, .* crosses itself .* at \(.*\)"
    ):
        triangulated(V, corners, np.array([4, len(corners) - 4]))


def test_polygons_that_are_not_planar_are_counted():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.3], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1.0]])
    result = triangulated(V, np.array([0, 1, 2, 3, 4, 5, 6]), np.array([4, 3]))
    assert result.F.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6]]
    assert result.not_planar == 1
    # Of heights ± 0.075 along the normal, over a radius of about 0.7.
    assert 0.05 < result.unevenness < 0.15
    V[2, 2] = 1e-8
    assert triangulated(V, np.array([0, 1, 2, 3]), np.array([4])).not_planar == 0


def test_a_polygon_that_passes_itself_in_space_gets_the_least_area():
    # Sides pass at distance 1: two sheets joined by a third one, less than any other triangles.
    V = np.array([[0, 0, 0], [2, 2, 0], [2, 0, 1], [0, 2, 1.0]])
    result = triangulated(V, np.arange(4), np.array([4]))
    other = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0, 1, 3], [1, 2, 3]])
    area = [np.linalg.norm(doubled_areas(V, F), axis=1).sum() for F in (result.F, *other)]
    assert area[0] <= min(area[1:]) + 1e-12
    assert result.not_planar == 1


def test_neighbours_with_three_common_corners_share_no_diagonal():
    # Both sides of a pentagon: five fans to choose from, and no edge has four triangles.
    angle = 2 * np.pi * np.arange(5) / 5
    V = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    F = triangulated(V, np.array([0, 1, 2, 3, 4, 0, 4, 3, 2, 1]), np.array([5, 5])).F
    assert ip.DeltaComplex.from_mesh(V, F).genus == 0


def test_repeated_corners_are_left_out_and_counted():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    result = triangulated(V, np.array([0, 1, 2, 2, 0, 2, 3, 0, 0]), np.array([4, 5]))
    assert result.F.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert result.repeated_corners == 3
    # Of what has two corners nothing can be made: it stays, and counts as collapsed later.
    kept = triangulated(V, np.array([0, 0, 1, 1]), np.array([4]))
    assert (len(kept.F), kept.repeated_corners) == (2, 0)


def test_polygons_that_run_back_along_their_sides_leave_nothing():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.0]])
    with pytest.raises(ip.MeshError, match="no polygon has an area"):
        triangulated(V, np.array([0, 1, 2, 1]), np.array([4]))


@pytest.mark.parametrize("form", ["obj", "off", "ply"])
def test_all_formats_divide_alike(tmp_path, form):
    V, F, _ = ip.load_mesh(CASES / "frame_of_ells.obj")
    lines = (CASES / "frame_of_ells.obj").read_text().split("\n")
    vertices = [line[2:] for line in lines if line.startswith("v")]
    faces = [[int(i) - 1 for i in line.split()[1:]] for line in lines if line.startswith("f")]
    rows = [f"{len(face)} {' '.join(map(str, face))}" for face in faces]
    heads = {
        "obj": "",
        "off": f"OFF\n{len(vertices)} {len(faces)} 0",
        "ply": f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\nproperty double x\n"
        f"property double y\nproperty double z\nelement face {len(faces)}\n"
        "property list uchar int vertex_index\nend_header",
    }
    path = tmp_path / f"frame.{form}"
    path.write_text("\n".join([heads[form], *vertices, *rows]) if heads[form] else "\n".join(lines))
    V1, F1, report = ip.load_mesh(path)
    np.testing.assert_array_equal(V1, V)
    np.testing.assert_array_equal(F1, F)
    assert report.polygons_clipped == 3


def test_a_polygon_of_thousands_of_corners_is_divided():
    angle = np.sort(np.random.default_rng(0).random(4000)) * 2 * np.pi
    radius = 1 + 0.3 * np.sin(40 * angle)
    outline = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    V, corners, normal = lifted(outline)
    F = triangulated(V, corners, np.array([4000])).F
    areas = doubled_areas(V, F) @ normal / 2
    assert areas.min() > 0
    np.testing.assert_allclose(areas.sum(), shoelace(outline), rtol=1e-10)
