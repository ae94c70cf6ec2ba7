"""Surfaces of regular polygons, L-shapes and prototypes: strata, areas, period matrices."""

import math
from fractions import Fraction

import flint
import numpy as np
import pytest
from support.glued_polygons import applied, same_periods

import igl_periods as ip
from igl_periods.surfaces import (
    double_polygon,
    l_shape,
    l_shape_period_matrix,
    prototype_surface,
    regular_polygon,
    weierstrass_prototypes,
)

GOLDEN = ip.algebraic_number([-1, -1, 1], 1.6)
ROOT = ip.algebraic_number([-2, 0, 1], 1.4)


@pytest.mark.parametrize(
    ("n", "genus", "stratum"),
    [(4, 1, "H(0)"), (6, 1, "H(0), "), (8, 2, "H(2)"), (10, 2, "H(1, 1)"), (12, 3, "H(4)"),
     (14, 3, "H(2, 2)"), (16, 4, "H(6)")],
)  # fmt: skip
def test_strata_of_regular_polygons(n, genus, stratum):
    found = ip.flat_surface_report(regular_polygon(n))
    assert (found.genus, found.stratum) == (genus, stratum.rstrip(", "))
    assert found.known_by == "exact"
    # n triangles over sides of length 1.
    assert float(found.area) == pytest.approx(n / (4 * math.tan(math.pi / n)), rel=1e-14)


@pytest.mark.parametrize(
    ("n", "genus", "stratum"),
    [(3, 1, "H(0)"), (5, 2, "H(2)"), (7, 3, "H(4)"), (9, 4, "H(6)")],
)
def test_strata_of_double_polygons(n, genus, stratum):
    found = ip.flat_surface_report(double_polygon(n))
    assert (found.genus, found.stratum, found.known_by) == (genus, stratum, "exact")
    assert float(found.area) == pytest.approx(n / (2 * math.tan(math.pi / n)), rel=1e-14)


@pytest.mark.parametrize(
    ("K", "name"),
    [(regular_polygon(8), "Bolza curve"), (regular_polygon(10), "y^2 = x^5 - 1"),
     (double_polygon(5), "y^2 = x^5 - 1"), (double_polygon(7), "y^2 = x^7 - 1")],
)  # fmt: skip
def test_curves_of_regular_polygons(K, name):
    assert ip.identify(ip.enclose(K, digits=11))[0].surface.name == name


@pytest.mark.parametrize("x", [Fraction(5, 4), Fraction(3), GOLDEN])
def test_period_matrices_of_l_shapes(x):
    e = ip.enclose(l_shape(x), digits=12)
    assert ip.symplectic_isomorphisms(e, l_shape_period_matrix(x), tolerance=1e-12, limit=1)
    found = ip.flat_surface_report(l_shape(x))
    assert found.stratum == "H(2)"
    assert found.exact_area == 2 * x - 1


@pytest.mark.parametrize("digits", [15, pytest.param(50, marks=pytest.mark.slow)])
def test_the_closed_form_of_l_in_balls(digits):
    e = ip.enclose(l_shape(ROOT), digits=digits)
    assert e.digits >= digits
    gamma = ip.symplectic_isomorphisms(e, l_shape_period_matrix(ROOT), tolerance=1e-12, limit=1)[0]
    Pi = e.change_basis(gamma).matrix
    with flint.ctx.workprec(250):
        x = ROOT.ball(250)
        exact = [(2 * x * x - 2 * x + 1) / (2 * x - 1), -2 * x * (x - 1) / (2 * x - 1)]
        for i in range(2):
            for j in range(2):
                assert Pi[i, j].real.contains(0)
                assert Pi[i, j].imag.overlaps(exact[abs(i - j)])


def test_general_l_shapes():
    K = l_shape(3, 4, width="3/2", height=2)
    found = ip.flat_surface_report(K)
    assert found.exact_area == 3 * 2 + Fraction(3, 2) * 2
    assert found.stratum == "H(2)"
    squares = ip.surfaces.glued_rectangles(
        [[1.5, 2], [1.5, 2], [1.5, 2]],
        [((0, 1), (1, 3)), ((1, 1), (0, 3)), ((0, 2), (2, 0)), ((2, 2), (0, 0)), ((1, 2), (1, 0)),
         ((2, 1), (2, 3))],
    )  # fmt: skip
    assert same_periods(K, squares)
    # Reflected in the diagonal, i.e. −conj Π; L(λ) itself is symmetric.
    assert same_periods(l_shape(2), l_shape(2, 2))


def test_prototypes_by_discriminant():
    # McMullen (2005): as many as two-cylinder cusps of the Weierstrass curve.
    assert [len(weierstrass_prototypes(D)) for D in (5, 8, 12, 13, 17)] == [1, 2, 3, 3, 6]
    for D in (5, 8, 9, 12, 13, 16, 17, 20, 21, 24):
        for a, b, c, e in weierstrass_prototypes(D):
            assert e * e + 4 * b * c == D
            assert 0 <= a < math.gcd(b, c)
            assert c + e < b
            assert math.gcd(a, b, c, e) == 1
            found = ip.flat_surface_report(prototype_surface(a, b, c, e))
            x = (e + math.sqrt(D)) / 2
            assert found.stratum == "H(2)"
            assert float(found.area) == pytest.approx(x * x + b * c, rel=1e-14)


@pytest.mark.parametrize(("D", "index"), [(5, 0), (8, 1), (13, 2), (17, 3)])
def test_prototypes_are_eigenforms_of_real_multiplication(D, index):
    # T = e on the square and its companion on the parallelogram, T dz = λ dz: the periods of dz
    # span a lattice of rank 4 that multiplication by λ keeps.
    a, b, c, e = weierstrass_prototypes(D)[index]
    periods = ip.flat_surface_report(prototype_surface(a, b, c, e)).periods
    x = (e + math.sqrt(D)) / 2
    lattice = np.array([[z.real, z.imag] for z in periods])
    # Rational coordinates of periods: 1 and λ are independent over Q.
    for z in x * lattice:
        coefficients = _integers(lattice, z, x)
        assert coefficients is not None


def _integers(lattice, z, x):
    """Small integers with Σ c_i lattice_i = z, if there are."""
    span = range(-6, 7)
    for c in np.stack(np.meshgrid(*[span] * 4, indexing="ij"), axis=-1).reshape(-1, 4)[None]:
        error = np.abs(c @ lattice - z).max(axis=1)
        if error.min() < 1e-9:
            return c[error.argmin()]
    return None


def test_the_prototype_of_discriminant_5_is_the_golden_l_stretched():
    stretched = [applied([(1, 0), (0, GOLDEN)], l_shape(GOLDEN).polygons.vertices[0])]
    K = ip.DeltaComplex.from_polygons(stretched, l_shape(GOLDEN).polygons.gluing)
    assert same_periods(K, prototype_surface(0, 1, 1, -1))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: regular_polygon(7), "n = 7: an even number of sides .* double_polygon"),
        (lambda: regular_polygon(2), "n = 2: an even number"),
        (lambda: double_polygon(8), "n = 8: an odd number of sides .* regular_polygon"),
        (lambda: double_polygon(1001), "n = 1001: an odd number of sides from 3 to 200"),
        (lambda: regular_polygon("eight"), "n must be an integer"),
        (lambda: l_shape(1), "right, width = 1, 1: an L has arms of positive length"),
        (lambda: l_shape(2, 1), "up, height = 1, 1"),
        (lambda: l_shape(2, width=-1), "right, width = 2, -1"),
        (lambda: l_shape_period_matrix(0.5), "lambda = 0.5"),
        (lambda: weierstrass_prototypes(6), "discriminant = 6: .* 0 or 1 mod 4, from 5 on"),
        (lambda: weierstrass_prototypes(4), "discriminant = 4"),
        (lambda: prototype_surface(0, 1, 1, 1), r"\(0, 1, 1, 1\) is not a prototype"),
        (lambda: prototype_surface(0, -1, 1, 1), "is not a prototype"),
        (lambda: prototype_surface(0.5, 1, 1, 1), "a must be an integer"),
    ],
)
def test_what_is_refused(make, message):
    with pytest.raises(ip.ComplexError, match=message):
        make()
