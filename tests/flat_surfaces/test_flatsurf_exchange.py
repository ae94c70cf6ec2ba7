"""Surfaces with the methods of sage-flatsurf, read and written."""

from fractions import Fraction

import pytest
from support.glued_polygons import same_periods
from support.sage_numbers import SageField, SageRational, SageSurface

import igl_periods as ip
from igl_periods.complexes import FieldElement


def rational(points):
    return [(SageRational(x), SageRational(y)) for x, y in points]


def mcmullen_l(x):
    """``translation_surfaces.mcmullen_L(1, 1, x, x)``: three rectangles with labels."""
    one, zero = SageRational(1), SageRational(0)
    return SageSurface(
        {
            "corner": rational([(0, 0), (1, 0), (1, 1), (0, 1)]),
            "right": [(zero, zero), (x, zero), (x, one), (zero, one)],
            "up": [(zero, zero), (one, zero), (one, x), (zero, x)],
        },
        [(("corner", 1), ("right", 3)), (("right", 1), ("corner", 3)),
         (("corner", 2), ("up", 0)), (("up", 2), ("corner", 0)),
         (("right", 0), ("right", 2)), (("up", 1), ("up", 3))],
    )  # fmt: skip


def test_the_golden_l_keeps_its_field():
    field = SageField([-1, -1, 1], 1.618033988749895)
    # The arms are a − 1 long.
    K = ip.from_flatsurf(mcmullen_l(field([-1, 1])))
    golden = ip.algebraic_number([-1, -1, 1], 1.6)
    found = ip.flat_surface_report(K)
    assert (found.stratum, found.known_by) == ("H(2)", "exact")
    assert found.exact_area == 2 * golden - 1
    assert isinstance(K.polygons.vertices[1][1][0], FieldElement)
    assert same_periods(K, ip.surfaces.l_shape(golden))


def test_numbers_that_floats_cannot_tell_apart():
    tiny = Fraction(1, 10**30)
    K = ip.from_flatsurf(mcmullen_l(SageRational(1 + tiny)))
    assert ip.flat_surface_report(K).exact_area == 3 + 2 * tiny


def test_folded_sides_get_their_midpoints():
    # Every side of a triangle glued to itself: the sphere with four points of angle π.
    triangle = SageSurface(
        {0: rational([(0, 0), (3, 0), (1, 2)])}, [((0, k), (0, k)) for k in range(3)]
    )
    K = ip.from_flatsurf(triangle)
    found = ip.flat_surface_report(K)
    assert (found.genus, found.stratum) == (0, "Q(-1, -1, -1, -1)")
    assert found.exact_area == 3


def test_there_and_back():
    for K in (ip.surfaces.regular_polygon(8), ip.surfaces.l_shape("3/2", 4)):
        data = ip.to_flatsurf_dict(K)
        if data["field"] is None:
            number = lambda c: SageRational(Fraction(c[0]))  # noqa: E731
        else:
            field = SageField(data["field"]["polynomial"], float(data["field"]["near"]))
            number = lambda c: field(c)  # noqa: B023, E731
        S = SageSurface(
            {p: [(number(x), number(y)) for x, y in v] for p, v in data["polygons"].items()},
            data["gluings"],
        )
        L = ip.from_flatsurf(S)
        assert L.polygons.vertices == K.polygons.vertices
        assert L.polygons.gluing == K.polygons.gluing
        assert (L.twin == K.twin).all()


def test_plain_data_of_a_square():
    K = ip.DeltaComplex.from_polygons(
        [[0, (1, 0), (1, 1), (0, 1)]], [((0, 0), (0, 2)), ((0, 1), (0, 3))]
    )
    assert ip.to_flatsurf_dict(K) == {
        "field": None,
        "polygons": {0: [[["0"], ["0"]], [["1"], ["0"]], [["1"], ["1"]], [["0"], ["1"]]]},
        "gluings": [((0, 0), (0, 2)), ((0, 1), (0, 3))],
    }
    octagon = ip.to_flatsurf_dict(ip.surfaces.regular_polygon(8))
    assert octagon["field"]["polynomial"] == [-2, 0, 1]
    assert octagon["field"]["near"].startswith("1.41421356237309504880168872")


class Endless(SageSurface):
    def labels(self):
        return iter(range(10**9))


def test_what_is_no_closed_surface():
    square = rational([(0, 0), (1, 0), (1, 1), (0, 1)])
    with pytest.raises(ip.ComplexError, match="has the method labels, and list has none"):
        ip.from_flatsurf([])
    with pytest.raises(ip.ComplexError, match="side 1 of the polygon 'a' is glued to nothing"):
        ip.from_flatsurf(SageSurface({"a": square}, [(("a", 0), ("a", 2))]))
    with pytest.raises(ip.ComplexError, match="more than 100000 polygons"):
        ip.from_flatsurf(Endless({}, []))
    with pytest.raises(ip.ComplexError, match="not glued from polygons with exact coordinates"):
        ip.to_flatsurf_dict(ip.surfaces.origami("(1,2)", "(1,3)", 2))
    # A similarity that is not an isometry.
    larger = rational([(0, 0), (2, 0), (2, 2), (0, 2)])
    pairs = [(("a", k), ("b", (k + 2) % 4)) for k in range(4)]
    with pytest.raises(ip.ComplexError, match=r"has length 1 and .* 2: they must agree exactly"):
        ip.from_flatsurf(SageSurface({"a": square, "b": larger}, pairs))
