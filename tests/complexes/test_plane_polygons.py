"""Polygons: which side is inside, crossings, triangles."""

from fractions import Fraction

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes.plane_polygons import PlanePolygon


def polygon(*corners):
    return PlanePolygon("polygon 3", [(Fraction(x), Fraction(y)) for x, y in corners])


def comb(n):
    """A concave polygon with n teeth and straight corners on its back."""
    back = [(2 * k, 0) for k in range(n + 1)]
    teeth = [(x, 3 - 2 * (x % 2)) for x in range(2 * n, -1, -1)]
    return polygon(*back, *teeth)


def spiral(turns):
    rng = np.random.default_rng(4)
    t = np.linspace(0, 2 * np.pi * turns, 16 * turns)
    out = np.stack([(1 + t) * np.cos(t), (1 + t) * np.sin(t)], axis=1)
    back = 0.6 * out[::-1] + rng.normal(size=out.shape) * 1e-3
    points = np.concatenate([out, back[:-1]])
    return polygon(*((Fraction(x), Fraction(y)) for x, y in points.tolist()))


@pytest.mark.parametrize("shape", [comb(1), comb(6), spiral(2), polygon((0, 0), (1, 0), (0, 1))])
def test_triangles_are_positive_and_fill_the_polygon(shape):
    shape.check_simple()
    assert shape.doubled_area() > 0
    F = shape.triangles()
    d = len(shape.corners)
    assert len(F) == d - 2
    assert {corner for t in F for corner in t} == set(range(d))
    areas = [PlanePolygon("", [shape.corners[c] for c in t]).doubled_area() for t in F]
    assert min(areas) > 0
    assert sum(areas) == shape.doubled_area()
    # Every side once; every diagonal in both directions.
    sides = [(t[k], t[(k + 1) % 3]) for t in F for k in range(3)]
    assert len(set(sides)) == len(sides)
    assert {s for s in sides if s[::-1] not in sides} == {(k, (k + 1) % d) for k in range(d)}


def test_marked_points_on_a_side_are_corners_of_triangles():
    # Cut off at the wrong corner first, nothing but a segment would be left.
    shape = polygon((0, 0), (1, 0), (2, 0), (3, 0), (0, 5))
    F = shape.triangles()
    assert len(F) == 3
    assert all(PlanePolygon("", [shape.corners[c] for c in t]).doubled_area() > 0 for t in F)


@pytest.mark.parametrize("far", [10**9, 10**30])
def test_polygons_far_from_the_origin(far):
    for shape in (comb(4), spiral(2)):
        moved = polygon(*((x + far, y - far) for x, y in shape.corners))
        moved.check_simple()
        assert moved.triangles() == shape.triangles()


def test_what_double_precision_cannot_decide():
    tiny = Fraction(1, 10**40)
    assert polygon((0, 0), (1, tiny), (2, 0), (1, 1)).orientation(0, 1, 2) == -1
    assert polygon((0, 0), (1, -tiny), (2, 0), (1, 1)).orientation(0, 1, 2) == 1
    assert polygon((0, 0), (1, 0), (2, 0), (1, 1)).orientation(0, 1, 2) == 0
    # Almost touching is not touching.
    polygon((0, 0), (2, 0), (2, 2), (1, tiny), (0, 2)).check_simple()
    with pytest.raises(ip.ComplexError, match="crosses or touches itself"):
        polygon((0, 0), (2, 0), (2, 2), (1, 0), (0, 2)).check_simple()


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ([(0, 0), (1, 0)], "polygon 3 has 2 corners"),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], "side 1 of polygon 3 has no length: corners 1 and 2"),
        ([(0, 0), (2, 0), (1, 0), (0, 1)], r"runs back along its own side at corner 1, \(2, 0\)"),
        ([(0, 0), (1, 0), (2, 0)], "runs back along its own side"),
        ([(0, 0), (1, 1), (1, 0), (0, 1)],
         r"crosses or touches itself: side 0 from \(0, 0\) to \(1, 1\) meets side 2"),
        ([(0, 0), (4, 0), (4, 2), (2, 0), (0, 2)], "touches itself: side 0 .* meets side 2"),
        ([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)], "touches itself"),
        ([(k, 0) for k in range(2000)] + [(0, 1)], "has 2001 corners; up to 2000"),
    ],
)  # fmt: skip
def test_polygons_that_bound_nothing(corners, message):
    with pytest.raises(ip.ComplexError, match=message):
        polygon(*corners).check_simple()


def test_corners_that_are_not_known_well_enough():
    import flint

    wide = flint.arb(0, 1)
    shape = PlanePolygon(
        "polygon 0", [(wide, wide), (wide + 1, wide), (wide, wide + 1), (wide, wide)]
    )
    with pytest.raises(ip.ComplexError, match="cannot be divided into triangles"):
        shape.triangles()
