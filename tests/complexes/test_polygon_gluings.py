"""Polygons glued along their sides: which surface it is, and what is refused."""

import pickle
from fractions import Fraction

import flint
import numpy as np
import pytest
from support.glued_polygons import (
    L_PAIRS,
    applied,
    by_translations,
    cut,
    exact,
    l_vertices,
    rotated,
    same_periods,
)

import igl_periods as ip
from igl_periods.complexes import ball_of, cosine_and_sine
from igl_periods.complexes.polygon_gluings import _common_length

glue = ip.DeltaComplex.from_polygons
TORUS = [((0, 0), (0, 2)), ((0, 1), (0, 3))]
GOLDEN = ip.algebraic_number([-1, -1, 1], 1.6)


@pytest.mark.parametrize(
    "square",
    [
        [0, 1, 1 + 1j, 1j],
        [(0, 0), (1, 0), (1, 1), (0, 1)],
        np.array([[0, 0], [1, 0], [1, 1], [0, 1]]),
        ["0", "1", ("1", "1"), (0, Fraction(1))],
        [flint.acb(0), flint.acb(1), flint.acb(1, 1), flint.acb(0, 1)],
    ],
)
def test_the_square_however_it_is_written(square):
    K = glue([square], TORUS)
    assert (K.n_vertices, K.n_edges, K.n_faces, K.genus) == (1, 3, 2, 1)
    assert K.polygons.is_exact
    assert ip.enclose(K, digits=20).reduced().contains([[1j]])


def test_sides_as_vectors():
    K = glue([[1, 1j, -1, -1j]], TORUS, edges=True)
    assert K.polygons.vertices == glue([[0, 1, 1 + 1j, 1j]], TORUS).polygons.vertices
    # Computed ones add up too.
    sides = [lambda bits, k=k: flint.acb(flint.fmpq(k, 3)).exp_pi_i() for k in range(6)]
    hexagon = glue([sides], [((0, k), (0, k + 3)) for k in range(3)], edges=True)
    assert not hexagon.polygons.is_exact
    tau = ip.enclose(hexagon, digits=40).reduced()
    with flint.ctx.workprec(200):
        assert abs(tau.matrix[0, 0].real).overlaps(flint.arb("0.5"))
        assert tau.matrix[0, 0].imag.overlaps(flint.arb(3).sqrt() / 2)


def test_lengths_are_exact():
    K = glue([l_vertices(GOLDEN)], L_PAIRS)
    lengths = K.exact_lengths(700)
    assert max(float(x.rad()) for x in lengths) < 1e-200
    with flint.ctx.workprec(700):
        for h, e in enumerate(K.edge.ravel().tolist()):
            x, y = K.polygons.vector(h)
            assert (lengths[e] ** 2).overlaps(ball_of(x * x + y * y, 700))
            assert float(lengths[e].mid()) == pytest.approx(K.lengths.ravel()[h], rel=1e-15)


@pytest.mark.parametrize("name", ["omega_1", "omega_2"])
def test_the_same_surface_as_glued_squares(name):
    from igl_periods.surfaces.square_tiled import _GLUINGS

    squares = _GLUINGS[name]
    n = 1 + max(k for pair in squares for k, _ in pair)
    K = glue([[0, 1, 1 + 1j, 1j]] * n, squares)
    assert ip.enclose(K, digits=20).reduced().digits >= 20
    assert same_periods(K, ip.surfaces.square_tiled_surface(name))


def test_rectangles_in_an_asymmetric_l():
    K = glue([l_vertices(2, 3)], L_PAIRS)
    L = ip.surfaces.glued_rectangles(
        [[1, 1], [1, 1], [1, 2]],
        [((0, 1), (1, 3)), ((1, 1), (0, 3)), ((0, 2), (2, 0)), ((2, 2), (0, 0)), ((1, 2), (1, 0)),
         ((2, 1), (2, 3))],
    )  # fmt: skip
    assert same_periods(K, L)
    assert not same_periods(K, glue([l_vertices(2, 4)], L_PAIRS))


@pytest.mark.parametrize("ends", [(0, 4), (1, 4), (4, 7), (0, 3)])
def test_cutting_and_turning_a_piece_changes_nothing(ends):
    whole = [exact(l_vertices(Fraction(7, 4), Fraction(5, 2)))]
    polygons, pairs = cut(whole, L_PAIRS, 0, *ends)
    assert same_periods(glue(polygons, pairs), glue(whole, L_PAIRS))
    turned = glue([polygons[0], rotated(polygons[1])], pairs)
    assert turned.polygons.is_exact
    assert same_periods(turned, glue(whole, L_PAIRS))


def test_clockwise_polygons_are_the_same_region():
    there = glue([l_vertices(2, 3)], L_PAIRS)
    # Listed backwards, side k is the old side 6 − k.
    back = l_vertices(2, 3)[::-1]
    pairs = [((0, (6 - a) % 8), (0, (6 - b) % 8)) for (_, a), (_, b) in L_PAIRS]
    assert same_periods(glue([back], pairs), there)
    mirrored = glue([[(x, -y) for x, y in l_vertices(2, 3)]], L_PAIRS)
    assert same_periods(mirrored, there)
    assert mirrored.polygons.xy[0][0].tolist() == [0.0, 0.0]


def test_the_golden_l_is_the_double_pentagon_sheared():
    # Veech's affine map: columns (1, 0) and (cos π/5, sin π/5), the golden number in their field.
    c, s = cosine_and_sine(1, 10)
    golden = 2 * c
    assert golden * golden == golden + 1
    L = applied([(1, c), (0, s)], exact(l_vertices(golden)))
    assert same_periods(glue([L], L_PAIRS), ip.surfaces.double_polygon(5))
    assert not same_periods(
        glue([l_vertices(golden)], L_PAIRS), ip.surfaces.double_polygon(5), 1e-6
    )


def test_gluings_by_translations_are_found_again():
    K = ip.surfaces.regular_polygon(10)
    pairs = by_translations(K.polygons.vertices)
    assert sorted(pairs) == sorted(K.polygons.gluing)


def test_doubles_may_be_rounded():
    angle = 2 * np.pi * np.arange(8) / 8
    octagon = np.exp(1j * angle)
    K = glue([octagon], [((0, k), (0, k + 4)) for k in range(4)])
    assert K.polygons.rounded
    assert K.exact_lengths is None
    assert K.n_vertices == 1
    assert same_periods(K, ip.surfaces.regular_polygon(8), 1e-9)
    octagon[3] *= 1 + 1e-7
    with pytest.raises(ip.ComplexError, match=r"must agree to 1e-09 \(relative\)"):
        glue([octagon], [((0, k), (0, k + 4)) for k in range(4)])


def test_a_cone_metric():
    # A triangle and its mirror image, which is listed clockwise: a sphere with three cone points.
    K = glue([[(0, 0), (3, 0), (0, 4)], [(0, 0), (-3, 0), (0, 4)]],
             [((0, 0), (1, 0)), ((0, 1), (1, 1)), ((0, 2), (1, 2))])  # fmt: skip
    assert (K.genus, K.n_vertices) == (0, 3)
    # Sides of length 5, as (5, 0) and (3, 4): rotations that no root of unity is.
    rhombus = [(0, 0), (5, 0), (8, 4), (3, 4)]
    K = glue([rhombus], [((0, 0), (0, 1)), ((0, 2), (0, 3))])
    assert (K.genus, K.n_vertices) == (0, 3)
    assert K.polygons.is_exact


def test_lengths_by_functions_are_compared_at_every_precision():
    def nearly(bits):
        return flint.arb(1) + flint.arb(2) ** -600

    K = glue([[0, 1, (1, 1), (0, 1)]], TORUS)
    almost = glue([[0, 1, (1, 1), (0, nearly)]], TORUS)
    assert len(almost.exact_lengths(300)) == 3
    assert K.polygons.rounded is False
    with pytest.raises(ip.ComplexError, match=r"glued sides have different lengths, .* 2000 bits"):
        almost.exact_lengths(2000)
    zero, one = Fraction(0), Fraction(1)
    side = ((zero, zero), (one, zero))
    assert _common_length(side, side) == 1


def test_numbers_of_two_fields_are_computed():
    a, b = ip.algebraic_number([-2, 0, 1], 1.4), ip.algebraic_number([-3, 0, 1], 1.7)
    K = glue([[0, a, (a, b), (0, b)]], TORUS)
    assert not K.polygons.is_exact
    with flint.ctx.workprec(200):
        tau = ip.enclose(K, digits=30).reduced().matrix[0, 0]
        assert tau.imag.overlaps((flint.arb(3) / 2).sqrt())


def test_pickles_keep_the_polygons():
    K = pickle.loads(pickle.dumps(glue([l_vertices(GOLDEN)], L_PAIRS)))
    assert repr(K.polygons) == "GluedPolygons(1 polygons with 8 sides)"
    assert K.polygons.vertices[0][2] == (GOLDEN, 0)
    assert len(K.exact_lengths(100)) == K.n_edges


def test_polygons_are_given_up_when_the_surface_changes():
    K = glue([[(0, 0), (1, 0), (4, 1), (3, 1)]], TORUS)
    from scipy.sparse import csr_array

    nothing = csr_array((0, K.n_edges), dtype=np.int64)
    flipped, _ = ip.intrinsic_delaunay(K, nothing)
    assert flipped.polygons is None
    from igl_periods.complexes import edge_lengths, with_edge_lengths

    moved = with_edge_lengths(K, edge_lengths(K) * 1.001)
    assert moved.polygons is None
    assert moved.exact_lengths is None


SQUARE = [0, 1, 1 + 1j, 1j]


@pytest.mark.parametrize(
    ("polygons", "gluing", "message"),
    [
        ([], [], "there is no polygon"),
        (3, [], "polygons are lists of points"),
        ([3], [], "polygons are lists of points"),
        ([[0, 1, 1j], []], [], "polygon 1 has 0 corners"),
        ([SQUARE], [(0, 0)], r"a list of pairs \(\(polygon, side\), \(polygon, side\)\)"),
        ([SQUARE], [((0, 0), (0, 2), (0, 1))], "a list of pairs"),
        ([SQUARE], None, "a list of pairs"),
        ([SQUARE], [((0, 0), (0, 4))], r"names side 4 of polygon 0, and there is none \(4 sides\)"),
        ([SQUARE], [((0, 0), (1, 0))], "side 0 of polygon 1, and there is none .1 polygons exist"),
        ([SQUARE], [((0, 0), (0, 0))], "side 0 of polygon 0 is glued to itself. Make its midpoint"),
        ([SQUARE], [((0, 0), (0, 2)), ((0, 0), (0, 1))], "side 0 of polygon 0 is glued 2 times"),
        ([SQUARE], [((0, 0), (0, 2))], r"side 1 of polygon 0 is glued 0 times \(2 such sides\)"),
        ([[(0, 0), (2, 0), (2, 1), (0, 1)]], [((0, 0), (0, 1)), ((0, 2), (0, 3))],
         "side 0 of polygon 0 has length 2 and side 1 of polygon 0, .* 1: they must agree exactly"),
        ([[0, (1, 0), (1, Fraction(10**15 + 1, 10**15)), (0, 1)]], TORUS,
         "side 1 of polygon 0 has length 1 and side 3 .* exactly|agree exactly"),
        ([SQUARE, SQUARE], [*TORUS, ((1, 0), (1, 2)), ((1, 1), (1, 3))],
         "not glued to one surface but to 2: nothing leads from polygon 0 to polygon 1"),
        ([[0, 1 + 1j, 1, 1j]], TORUS, "polygon 0 crosses or touches itself"),
        ([[0, 1, 2, 3]], TORUS, "polygon 0 runs back along its own side"),
        ([[0, 1, (1, 2, 3)]], [], "a point of the plane has two coordinates"),
    ],
)  # fmt: skip
def test_what_is_no_surface(polygons, gluing, message):
    with pytest.raises(ip.ComplexError, match=message):
        glue(polygons, gluing)


def test_sides_that_do_not_close():
    with pytest.raises(ip.ComplexError, match=r"sides of polygon 0 add up to \(0, 1\), not to 0"):
        glue([[1, (0, 1), -1]], [], edges=True)
