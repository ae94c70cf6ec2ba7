"""What flat surfaces are: Gauss–Bonnet, strata, dz as an eigenvector of Π."""

from fractions import Fraction

import flint
import numpy as np
import pytest
from scipy.sparse import csr_array
from support.glued_polygons import L_PAIRS, exact, l_vertices, rotated

import igl_periods as ip
from igl_periods.complexes import along_sides

surfaces = ip.surfaces
GOLDEN = ip.algebraic_number([-1, -1, 1], 1.6)
TRANSLATION = [
    surfaces.regular_polygon(8),
    surfaces.regular_polygon(10),
    surfaces.double_polygon(7),
    surfaces.l_shape(GOLDEN, 3),
    surfaces.triangle_unfolding(1, 2, 4),
    surfaces.origami("(1,2,3)", "(1,4)"),
    surfaces.prototype_surface(1, 2, 2, -1),
]
OTHERS = [
    (surfaces.square_tiled_surface("omega_3"), 2, "Q(1, 1, 1, 1)"),
    (surfaces.square_tiled_surface("omega_2"), 2, "Q(2, 2)"),
    (surfaces.regular_map_surface("klein"), 6, "Ω^6(1^24)"),
    (surfaces.regular_map_surface("bolza"), 3, "Ω^3(1, 1, 1, 1, 1, 1)"),
    (surfaces.pillowcase_cover("(1,2,3)", "(1,2,3)", "(1,2,3)"), 2, "Q(1, 1, 1, -1, -1, -1)"),
]


@pytest.mark.parametrize("K", [*TRANSLATION, *(K for K, _, _ in OTHERS)])
def test_the_orders_of_zeros_add_up(K):
    found = ip.flat_surface_report(K)
    assert sum(found.orders) == found.holonomy * (2 * found.genus - 2)
    assert sum(found.cone_angles) == 2 * found.genus - 2 + K.n_vertices
    assert len(found.orders) + found.marked_points == K.n_vertices


@pytest.mark.parametrize(("K", "order", "stratum"), OTHERS)
def test_holonomy_groups_of_squares_and_triangles(K, order, stratum):
    found = ip.flat_surface_report(K)
    assert (found.holonomy, found.stratum) == (order, stratum)
    assert found.known_by == ("balls" if K.polygons is None else "exact")
    assert (found.form is None) == (order != 1)
    assert found.is_half_translation_surface == (order <= 2)


@pytest.mark.parametrize("K", TRANSLATION)
def test_dz_is_closed_and_holomorphic(K):
    found = ip.flat_surface_report(K)
    assert found.is_translation_surface
    values = along_sides(K, found.form)
    assert np.abs(values.sum(axis=1)).max() < 1e-13
    assert np.allclose(np.abs(values), K.lengths, rtol=1e-13)
    # B = Π A, in balls.
    e = ip.enclose(K, digits=10)
    g = found.genus
    with flint.ctx.workprec(300):
        balls = flint.acb_mat([[z] for z in found.period_balls[:g]])
        for product, z in zip((e.matrix * balls).entries(), found.period_balls[g:]):
            assert (product - z).contains(0)
            assert float(abs(product - z).upper()) < 1e-8
    A, B = found.periods[:g], found.periods[g:]
    # Riemann's bilinear relation: the area is the imaginary part of conj(A) · B.
    assert np.vdot(A, B).imag == pytest.approx(float(found.area), rel=1e-12)


@pytest.mark.parametrize("K", TRANSLATION[:4])
def test_the_class_of_dz_is_that_of_its_periods(K):
    found = ip.flat_surface_report(K)
    basis = ip.cohomology_basis(K)
    class_of_periods = csr_array(basis).T @ found.periods
    # What is left is exact: its values around all canonical cycles vanish.
    rest = found.form - class_of_periods
    for walk in ip.homology_basis(K):
        signs = K.sign.ravel()[walk]
        assert abs((signs * rest[K.edge.ravel()[walk]]).sum()) < 1e-12
    with flint.ctx.workprec(300):
        for ball, z in zip(found.period_balls, found.periods):
            assert abs(complex(ball.mid()) - z) < 1e-13
            assert float(ball.real.rad()) < 1e-100


def test_turned_pieces_are_still_a_translation_surface():
    from support.glued_polygons import cut

    polygons, pairs = cut([exact(l_vertices(Fraction(7, 4)))], L_PAIRS, 0, 0, 4)
    turned = [polygons[0], rotated(polygons[1])]
    found = ip.flat_surface_report(ip.DeltaComplex.from_polygons(turned, pairs))
    assert (found.stratum, found.known_by) == ("H(2)", "exact")
    assert found.exact_area == Fraction(5, 2)


def test_dz_does_not_depend_on_how_coordinates_are_known():
    polygon = l_vertices(GOLDEN, 3)
    exactly = ip.flat_surface_report(ip.DeltaComplex.from_polygons([polygon], L_PAIRS))

    def golden(bits):
        return (1 + flint.arb(5).sqrt()) / 2

    doubles = [(float(x), float(y)) for x, y in polygon]
    for other, known_by in ((l_vertices(golden, 3), "balls"), (doubles, "floats")):
        if known_by == "floats":
            # Turned by an angle, so that lengths of glued sides are rounded differently.
            other = [z * np.exp(0.3j) for z in (complex(x, y) for x, y in other)]
        K = ip.DeltaComplex.from_polygons([other], L_PAIRS)
        found = ip.flat_surface_report(K)
        turn = np.exp(0.3j) if known_by == "floats" else 1
        assert found.known_by == known_by
        assert np.allclose(found.periods, turn * exactly.periods, rtol=1e-12, atol=1e-12)


def test_half_translation_surfaces_of_polygons():
    # A rectangle folded up: the pillowcase, and a genus 2 surface in Q(4) has dz² only.
    pillow = ip.DeltaComplex.from_polygons(
        [[(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)]],
        [((0, 0), (0, 1)), ((0, 3), (0, 4)), ((0, 2), (0, 5))],
    )
    found = ip.flat_surface_report(pillow)
    assert (found.genus, found.stratum, found.known_by) == (0, "Q(-1, -1, -1, -1)", "exact")
    assert found.exact_area == 2
    assert found.periods is None


def test_cone_metrics():
    # A rhombus of sides 5 folded along a diagonal: rotations by twice arctan 4/3 and so on.
    K = ip.DeltaComplex.from_polygons(
        [[(0, 0), (5, 0), (8, 4), (3, 4)]], [((0, 0), (0, 1)), ((0, 2), (0, 3))]
    )
    found = ip.flat_surface_report(K)
    assert (found.holonomy, found.orders, found.stratum) == (None, None, "")
    assert found.known_by == "exact"
    assert not found.is_half_translation_surface
    assert sum(found.cone_angles) == pytest.approx(-2 + K.n_vertices)
    assert "cone metric" in repr(found)
    # A mesh: nothing is rational.
    mesh = ip.flat_surface_report(*ip.surfaces.torus_of_revolution(3, 1, 6, 5))
    assert (mesh.genus, mesh.holonomy, mesh.known_by) == (1, None, "floats")


def test_rounded_coordinates():
    points = np.exp(2j * np.pi * np.arange(10) / 10)
    K = ip.DeltaComplex.from_polygons([points], [((0, k), (0, k + 5)) for k in range(5)])
    found = ip.flat_surface_report(K)
    assert (found.stratum, found.known_by) == ("H(1, 1)", "floats")
    assert found.cone_angles == (2, 2)
    assert found.exact_area is None


def test_marked_points_are_counted():
    found = ip.flat_surface_report(surfaces.triangle_unfolding(1, 3, 4))
    assert (found.orders, found.marked_points) == ((2,), 5)
    assert "H(2), and 5 marked points" in repr(found)
    torus = ip.flat_surface_report(surfaces.regular_polygon(6))
    assert "H(0), and 1 marked point\n" in repr(torus)


def test_reports_show_what_they_know():
    text = repr(ip.flat_surface_report(surfaces.regular_polygon(8)))
    assert text.splitlines() == [
        "FlatSurfaceReport",
        "  surface      translation surface",
        "  stratum      H(2)",
        "  genus        2",
        "  holonomy     order 1, decided exactly",
        "  cone angles  3 times 2π",
        "  area         2 + 2 √2 ≈ 4.828427124746",
        text.splitlines()[-1],
    ]
    assert "periods" in text
    html = ip.flat_surface_report(surfaces.regular_polygon(8))._repr_html_()
    assert "translation surface" in html


def test_surfaces_with_a_boundary_are_refused():
    with pytest.raises(ip.ComplexError, match="boundary"):
        ip.flat_surface_report(ip.DeltaComplex.from_lengths([[1, 1, 1]], [[0, 1, 2]]))
