"""Unfolded triangles: strata by the formula, regular polygons by Veech."""

import math

import pytest
from support.glued_polygons import same_periods

import igl_periods as ip
from igl_periods.surfaces import double_polygon, regular_polygon, triangle_unfolding

TRIANGLES = [(1, 1, 1), (1, 1, 2), (1, 3, 4), (1, 1, 3), (1, 2, 4), (2, 3, 4), (3, 4, 5),
             (1, 4, 11), (2, 2, 3)]  # fmt: skip


@pytest.mark.parametrize("angles", TRIANGLES)
def test_genus_and_cone_points(angles):
    n = sum(angles)
    found = ip.flat_surface_report(triangle_unfolding(*angles))
    assert found.genus == 1 + (n - sum(math.gcd(k, n) for k in angles)) // 2
    assert found.is_translation_surface
    assert found.known_by == "exact"
    expected = sorted(k // math.gcd(k, n) for k in angles for _ in range(math.gcd(k, n)))
    assert sorted(found.cone_angles) == expected
    # Sides are sines: the area of a triangle is half the product of its sines.
    triangle = math.prod(math.sin(k * math.pi / n) for k in angles) / 2
    assert float(found.area) == pytest.approx(2 * n * triangle, rel=1e-13)


@pytest.mark.parametrize(
    ("angles", "K"),
    [((1, 3, 4), regular_polygon(8)), ((1, 1, 2), regular_polygon(4)),
     ((1, 1, 3), double_polygon(5)), ((1, 4, 5), double_polygon(5))],
)  # fmt: skip
def test_regular_polygons(angles, K):
    assert same_periods(triangle_unfolding(*angles), K)


def test_the_order_of_angles_does_not_matter():
    one = triangle_unfolding(2, 4, 8)
    assert same_periods(one, triangle_unfolding(4, 1, 2))
    assert one.n_faces == 14


@pytest.mark.parametrize(
    ("angles", "message"),
    [
        ((0, 1, 1), "the angles 0 : 1 : 1 are not positive"),
        ((1, 1, 0.5), "c must be an integer"),
        ((1, 100, 100), r"a \+ b \+ c = 201: triangles up to 200"),
    ],
)
def test_what_is_no_triangle(angles, message):
    with pytest.raises(ip.ComplexError, match=message):
        triangle_unfolding(*angles)
